"""Sequences worth trying without a search: arithmetic and geometric ones, and neighbours of good ones."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise

import numpy as np

from .pattern import Counts
from .search_strips import Known, costs, front, known
from .straight import qualities_over, reaches

MOST_STRIPS = 30_000
"""Strips of all neighbours measured in one round: about a tenth of a second of CPU."""
ROUNDS = 3
"""Rounds of neighbours at most."""
MOST_LAYERS = 256
"""Layers of the longest regular sequence."""


def regular_sequences(fine: int, coarse: int, length: float | None) -> list[Counts]:
    """Return the arithmetic, the geometric and the halving sequence for every number of layers, distinct.

    From one layer to one more than elements are lost, or twice the layers of equilateral elements where the
    length, in heights, is given. The paper's sequences are among them, 7:5:3:1, 40:39:..:10 and 128:64:..:1.

    >>> {(7, 4, 1), (7, 5, 3, 1)} <= set(regular_sequences(7, 1, None))
    True
    """
    most = max(1, fine - coarse)
    if length is not None:
        most = max(most, 2 * int(np.ceil(length * (fine + coarse) / 3**0.5)))
    return list(_regular(fine, coarse, min(most, MOST_LAYERS)))


@lru_cache(maxsize=256)
def _regular(fine: int, coarse: int, most: int) -> tuple[Counts, ...]:
    found: dict[Counts, None] = {}
    for n in range(1, most + 1):
        for wanted in (np.linspace(fine, coarse, n + 1), np.geomspace(fine, coarse, n + 1)):
            found[tuple(int(c) for c in np.rint(wanted))] = None
    halving = [fine]
    while halving[-1] >= 2 * coarse and halving[-1] > 1:
        halving.append((halving[-1] + 1) // 2)
    if fine > coarse:
        found[tuple(halving if halving[-1] == coarse else [*halving, coarse])] = None
    return tuple(found)


def improved(
    pool: list[Known], length: float | None, *, least_quality: float, is_closed: bool = False
) -> list[Known]:
    """Return the front of a pool and of its neighbours, of their neighbours, and so on, a few rounds.

    Neighbours have one inner front more, one less, or one of one element more or less. Shortest sequences
    first where all would take too long.
    """
    best = front(pool)
    seen: set[Counts] = set()
    tried = {k.counts for k in best}
    for _ in range(ROUNDS):
        trials: dict[Counts, None] = {}
        n_strips = 0
        for k in sorted(best, key=lambda k: (len(k.counts), k.counts)):
            if k.counts in seen or n_strips > MOST_STRIPS:
                continue
            seen.add(k.counts)
            around = _neighbours(k.counts)
            n_strips += sum(len(c) - 1 for c in around)
            trials.update(dict.fromkeys(c for c in around if c not in tried))
        if not trials:
            break
        tried.update(trials)
        better = _better(list(trials), best, length, least_quality, is_closed=is_closed)
        best = front([*best, *better])
    return best


def _better(
    trials: list[Counts], best: list[Known], length: float | None, least_quality: float, *, is_closed: bool
) -> list[Known]:
    """Return the trials that reach the least quality, and more than any of the best that costs no more."""
    held = np.array([(k.n_blocks, k.positive) for k in best]).reshape(-1, 2)
    is_held = (held <= costs(trials)[:, None]).all(axis=2)
    wanted = np.where(is_held, [k.quality for k in best], 0.0).max(axis=1, initial=least_quality)
    is_new = reaches(trials, length, wanted, is_closed=is_closed)
    left = [c for c, new in zip(trials, is_new, strict=True) if new]
    if not left:
        return []
    qualities = qualities_over(left, length, is_closed=is_closed)
    return [k for k in known(left, qualities) if k.quality >= least_quality]


def _neighbours(counts: Counts) -> list[Counts]:
    found = []
    for k, (first, second) in enumerate(pairwise(counts), 1):
        middles = {(first + second) // 2, (first + second + 1) // 2, first, second, 2 * second}
        found += [(*counts[:k], m, *counts[k:]) for m in middles if second <= m <= first]
    for k in range(1, len(counts) - 1):
        found.append(counts[:k] + counts[k + 1 :])
        for moved in (counts[k] - 1, counts[k] + 1):
            if counts[k + 1] <= moved <= counts[k - 1]:
                found.append((*counts[:k], moved, *counts[k + 1 :]))
    return found
