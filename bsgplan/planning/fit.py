"""Integers for a measured profile: the sequences of front counts that a region may be built with.

For a number of strips K the profile asks for the real counts t_k = f(T_k) / s on K + 1 fronts. A sequence of
integers near them is found by dynamic programming over pairs of neighbouring fronts, which minimises

    sum ((ln f_k - ln t_k) / TOLERANCE)^2 + price * sum |f_(k-1) - 2 f_k + f_(k+1)| + steep strips,

the middle sum being Eq. 16 of [Zint & Grosso] with the ends of Eq. 17 and 18. A low price follows the size
field, a high one saves irregular vertices; beside these stand the arithmetic and the geometric sequence.

A second source looks at quality and knows of the profile only its ends and its length: the Pareto front of
`patterns.shortlist` over blocks, irregularity and quality, of which those near the profile are of use.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import ceil, floor, log

import numpy as np

from ..arrays import Floats, Ints
from ..patterns import shortlist
from ..patterns.search import EXACT
from ..regions import Profile

TOLERANCE = 0.15
"""Misfit of a count in log size that costs as much as one irregular vertex at price 1."""

WINDOW = 0.12
"""Share of a wanted count by which the integers tried may differ from it; at least 1, at most 8."""

PRICES = (0.0, 0.3, 2.0)
"""Prices of an irregular vertex that are tried."""

STEEP = 100.0
"""Cost per unit of ratio beyond 2 of a strip: 3:1 caps q_min at .5, so it is taken where nothing else is."""

LEAST_SEARCHED = 0.55
"""Mean ratio of a straight pattern under which the search leaves it out: steep strips, 3:1 has .50."""

LONGEST_SEARCHED = 2.5
"""Heights of a region beyond which it is not searched: its layers are near to uniform, and are many."""


def sequences(profile: Profile, side: float, *, least: int = 1) -> list[tuple[int, ...]]:
    """Return distinct sequences of front counts for a profile, fine end first.

    side is s, the elements along a block edge; least is the smallest count allowed (3 on rings). Strips
    come in the numbers just under and over layers / s, one less, and one more where there are few.
    """
    ideal = profile.layers / side
    under = floor(ideal)
    n_strips = {max(1, n) for n in (under - 1, under, under + 1)} | ({under + 2} if ideal < 3 else set())
    fine, coarse = _ends(profile, side, least)
    found: dict[tuple[int, ...], None] = {}
    for n in sorted(n_strips):
        wanted = block_counts(profile, side, n)
        same_blocks = wanted * np.clip(ideal / n, 0.7, 1.4)
        found[_whole(np.linspace(fine, coarse, n + 1), least)] = None
        found[_whole(np.geomspace(fine, coarse, n + 1), least)] = None
        targets = [wanted, same_blocks, _followable(same_blocks)]
        for k, target in enumerate(targets):
            if not any(np.array_equal(target, other) for other in targets[:k]):
                found.update(dict.fromkeys(_best_sequences(np.maximum(target, least), least)))
    if ideal < 4:
        found[fine, coarse] = None
    return list(found)


def followed(profile: Profile, fine: int, coarse: int, *, least: int = 1) -> list[tuple[int, ...]]:
    """Return sequences of front counts for a profile whose ends are given: a rim imposes them, s is 1.

    One for each price of irregular vertices, on the strips just under and over the layers.
    """
    n_strips = sorted({max(1, floor(profile.layers)), max(1, ceil(profile.layers))})
    found: dict[tuple[int, ...], None] = {}
    for n in n_strips:
        wanted = np.maximum(block_counts(profile, 1.0, n), least)
        found.update(dict.fromkeys(_best_sequences(wanted, least, ends=(fine, coarse))))
    return list(found)


def searched(profile: Profile, side: float, *, is_closed: bool) -> dict[tuple[int, ...], float]:
    """Return the best sequences from end to end over the length, and their straight mean ratio.

    Those with about layers / s strips, one less to two more, as `sequences` has them. None for regions with
    more than EXACT blocks on a front or longer than LONGEST_SEARCHED: the search would take its time there.
    """
    least = 3 if is_closed else 1
    fine, coarse = _ends(profile, side, least)
    length = float(profile.positions[-1] / profile.lengths.mean())
    if max(fine, coarse) > EXACT or length > LONGEST_SEARCHED:
        return {}
    ideal = profile.layers / side
    found = shortlist(fine, coarse, length=length, least_quality=LEAST_SEARCHED, is_closed=is_closed)
    return {f.pattern.counts: f.q_min for f in found if -1 <= f.pattern.n_layers - floor(ideal) <= 2}


def arithmetic(profile: Profile, side: float, *, least: int = 1) -> list[tuple[int, ...]]:
    """Return the paper's own patterns for a profile: arithmetic, on the strips just under and over the ideal.

    So 28 to 4 elements on 9.5 layers at s = 4 give 7:4:1 and 7:5:3:1 ([Zint & Grosso], Fig. 10).
    """
    ideal = profile.layers / side
    fine, coarse = _ends(profile, side, least)
    strips = sorted({max(1, floor(ideal)), max(1, ceil(ideal))})
    return [_whole(np.linspace(fine, coarse, n + 1), least) for n in strips]


def block_counts(profile: Profile, side: float, n_strips: int) -> Floats:
    """Return the real counts t_k that a profile asks for on n_strips + 1 fronts, (n_strips + 1,)."""
    depths = np.linspace(0.0, profile.layers, n_strips + 1)
    return profile.counts_at(depths) / side


def misfit(counts: tuple[int, ...], profile: Profile, side: float) -> float:
    """Return the rms of ln(block edge / wanted edge), 0 for a pattern that follows the size field.

    Edges along the fronts have ln(t_k / f_k), edges across all strips ln(layers / (s K)); fronts weigh the
    same, for the two at the ends must meet their neighbours, and across weighs as much as along.
    """
    return misfits([counts], profile, side)[counts]


def misfits(
    sequences: Iterable[tuple[int, ...]], profile: Profile, side: float
) -> dict[tuple[int, ...], float]:
    """Return the `misfit` of each of many sequences."""
    alike: dict[int, list[tuple[int, ...]]] = {}
    for counts in sequences:
        alike.setdefault(len(counts) - 1, []).append(counts)
    found: dict[tuple[int, ...], float] = {}
    for n_strips, group in alike.items():
        wanted = block_counts(profile, side, n_strips)
        along = (np.log(wanted / np.array(group)) ** 2).mean(axis=1)
        across = log(profile.layers / (side * n_strips)) ** 2
        found.update(zip(group, np.sqrt((along + across) / 2).tolist(), strict=True))
    return found


def _ends(profile: Profile, side: float, least: int) -> tuple[int, int]:
    """Return the whole counts that a profile asks for on its fine and its coarse front."""
    fine, coarse = block_counts(profile, side, 1).tolist()
    return max(least, round(fine)), max(least, round(coarse))


def _followable(wanted: Floats) -> Floats:
    """Return counts near wanted that at most double or halve from front to front, (n_fronts,).

    The geometric mean of the largest such sequence below wanted and the smallest above, in its block count.
    """
    apart = np.log(2) * np.abs(np.subtract.outer(np.arange(len(wanted)), np.arange(len(wanted))))
    logs = np.log(wanted)
    middle = np.exp(((logs[None, :] + apart).min(axis=1) + (logs[None, :] - apart).max(axis=1)) / 2)
    return middle * _n_blocks(wanted) / _n_blocks(middle)


def _n_blocks(counts: Floats) -> float:
    return float(counts.sum() + counts[1:-1].sum())


def _whole(wanted: Floats, least: int) -> tuple[int, ...]:
    return tuple(int(n) for n in np.maximum(least, np.rint(wanted)))


def _best_sequences(
    wanted: Floats, least: int, *, prices: Sequence[float] = PRICES, ends: tuple[int, int] | None = None
) -> list[tuple[int, ...]]:
    """Return the cheapest sequence near wanted at each price, by dynamic programming over pairs of fronts."""
    choices = [_choices(t, least) for t in wanted.tolist()]
    if ends is not None:
        choices[0], choices[-1] = (np.array([end]) for end in ends)
    fits = [(np.log(c / t) / TOLERANCE) ** 2 for c, t in zip(choices, wanted, strict=True)]
    first, second = choices[0], choices[1]
    price = np.array(prices)[:, None, None]
    cost = fits[0][:, None] + fits[1][None, :] + _strip_cost(first, second)
    cost = cost + price * np.abs(second[None, :] - first[:, None])
    came_from: list[Ints] = []
    for k in range(2, len(choices)):
        a, b, c = choices[k - 2], choices[k - 1], choices[k]
        bend = np.abs(a[:, None, None] - 2 * b[None, :, None] + c[None, None, :])
        total = cost[:, :, :, None] + price[..., None] * bend
        came_from.append(total.argmin(axis=1))
        cost = total.min(axis=1) + fits[k][None, :] + _strip_cost(b, c)
    cost = cost + price * np.abs(choices[-2][:, None] - choices[-1][None, :])
    i, j = np.unravel_index(cost.reshape(len(cost), -1).argmin(axis=1), cost.shape[1:])
    path, every = [j, i], np.arange(len(cost))
    for back in reversed(came_from):
        path.append(back[every, path[-1], path[-2]])
    counts = [choice[at] for choice, at in zip(choices, reversed(path), strict=True)]
    return [tuple(row) for row in np.stack(counts, axis=1).tolist()]


def _choices(wanted: float, least: int) -> Ints:
    reach = min(max(ceil(WINDOW * wanted), 1), 8)
    return np.arange(max(least, floor(wanted) - reach), max(least, ceil(wanted) + reach) + 1)


def _strip_cost(first: Ints, second: Ints) -> Floats:
    a, b = np.maximum(first[:, None], second[None, :]), np.minimum(first[:, None], second[None, :])
    return STEEP * np.maximum(a / b - 2.0, 0.0)
