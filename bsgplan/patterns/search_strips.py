"""What both searches stand on: the strips between two counts, and the Pareto front of sequences."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..arrays import Floats, Ints
from .pattern import Counts
from .straight import side_by_side
from .width import best_widths, strip_forms, width_intervals


@dataclass(frozen=True, eq=False)
class Known:
    """A sequence with its blocks, positive irregularity and mean ratio."""

    counts: Counts
    n_blocks: int
    positive: int
    quality: float


def known(sequences: Sequence[Counts], qualities: Iterable[float]) -> list[Known]:
    """Return sequences with their numbers.

    >>> [(k.n_blocks, k.positive) for k in known([(7, 4, 1), (7, 1)], [0.5, 0.2])]
    [(16, 3), (8, 6)]
    """
    numbers = costs(sequences).tolist()
    each = zip(sequences, numbers, qualities, strict=True)
    return [Known(counts, blocks, positive, float(q)) for counts, (blocks, positive), q in each]


def costs(sequences: Sequence[Counts]) -> Ints:
    """Return the blocks and the positive irregularity of each sequence, Eq. 15 and 20, (n_sequences, 2)."""
    flat, start = side_by_side(sequences)
    if not len(start):
        return np.zeros((0, 2), dtype=np.int64)
    end = np.append(start[1:], len(flat)) - 1
    before, after = np.roll(flat, 1), np.roll(flat, -1)
    before[start], after[end] = flat[start], flat[end]
    rises = np.maximum(before - 2 * flat + after, 0)
    blocks = 2 * np.add.reduceat(flat, start) - flat[start] - flat[end]
    return np.column_stack([blocks, np.add.reduceat(rises, start)])


def front(pool: Iterable[Known], *, resolution: float = 0.0) -> list[Known]:
    """Return those that no other one matches in blocks, iota+ and quality, best quality first.

    A quality less than resolution better counts as equal.
    """
    ordered = sorted(pool, key=lambda k: (k.n_blocks, k.positive, -k.quality, k.counts))
    reached = np.full(max((k.positive for k in ordered), default=0) + 1, -np.inf)  # so far, by iota+
    kept: list[Known] = []
    for k in ordered:
        if reached[k.positive] < k.quality - resolution:
            kept.append(k)
            np.maximum(reached[k.positive :], k.quality, out=reached[k.positive :])
    return sorted(kept, key=lambda k: (-k.quality, k.n_blocks, k.positive))


@dataclass(frozen=True, eq=False)
class Strips:
    """All strips from a count to itself or a lower one, between a fine and a coarse count."""

    fine: int
    coarse: int
    first: Ints
    """Count on the finer side of each strip, (n_strips,)."""
    second: Ints
    forms: Floats
    """`strip_form` of each strip, (n_strips, 2, 2)."""
    caps: Floats
    """Best mean ratio of each strip at any width, (n_strips,)."""
    best_widths: Floats
    """Width at which each strip is best, in heights, (n_strips,)."""
    is_closed: bool = False

    def intervals(self, q: float) -> tuple[Floats, Floats]:
        """Return the smallest and the largest width that reach q, two of (fine + 1, fine + 1), in heights.

        (inf, -inf) where no width does.
        """
        low, high = np.full((2, self.fine + 1, self.fine + 1), np.inf)
        high *= -1
        low[self.first, self.second], high[self.first, self.second] = width_intervals(self.forms, q)
        return low, high


@lru_cache(maxsize=128)
def strips_between(fine: int, coarse: int, *, is_closed: bool = False) -> Strips:
    """Return the strips that a non-increasing sequence from fine to coarse may use.

    >>> len(strips_between(7, 1).caps)
    28
    """
    first, second = np.array([(m, n) for m in range(coarse, fine + 1) for n in range(coarse, m + 1)]).T
    forms = strip_forms(first, second, is_closed=is_closed)
    widths, caps = best_widths(forms)
    return Strips(fine, coarse, first, second, forms, caps, widths, is_closed)
