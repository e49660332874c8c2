"""What both searches stand on: the strips between two counts, and the Pareto front of sequences.

The quality of a sequence over a length, in heights, is that of `spacing.straight_widths`: a bisection on Q
over the intervals of `width.width_intervals`, here for many sequences at once.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..arrays import Floats, Ints
from .width import form_quality, width_intervals

SLACK = 1e-9
"""Share by which sums of widths may miss the length: rounding of sums."""
HALVINGS = 40
"""Bisections on Q: to rounding."""

Counts = tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Known:
    """A sequence with its blocks, positive irregularity and mean ratio."""

    counts: Counts
    n_blocks: int
    positive: int
    quality: float


def known(counts: Counts, quality: float) -> Known:
    """Return a sequence with its numbers, Eq. 15 and 20.

    >>> k = known((7, 4, 1), 0.5)
    >>> k.n_blocks, k.positive
    (16, 3)
    """
    drops = np.diff((counts[0], *counts, counts[-1]))
    n_blocks = 2 * sum(counts) - counts[0] - counts[-1]
    return Known(counts, n_blocks, int(np.abs(np.diff(drops)).sum()) // 2, quality)


def front(pool: Iterable[Known], *, resolution: float = 0.0) -> list[Known]:
    """Return those that no other one matches in blocks, iota+ and quality, best quality first.

    A quality less than resolution better counts as equal.
    """
    kept: list[Known] = []
    for k in sorted(pool, key=lambda k: (k.n_blocks, k.positive, -k.quality, k.counts)):
        if not any(o.positive <= k.positive and o.quality >= k.quality - resolution for o in kept):
            kept.append(k)
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


@lru_cache(maxsize=32)
def strips_between(fine: int, coarse: int, *, is_closed: bool = False) -> Strips:
    """Return the strips that a non-increasing sequence from fine to coarse may use.

    >>> len(strips_between(7, 1).caps)
    28
    """
    first, second = np.array([(m, n) for m in range(coarse, fine + 1) for n in range(coarse, m + 1)]).T
    forms = strip_forms(first, second, is_closed=is_closed)
    widths, caps = best_widths(forms)
    return Strips(fine, coarse, first, second, forms, caps, widths, is_closed)


def strip_forms(first: Ints, second: Ints, *, is_closed: bool = False) -> Floats:
    """Return `strip_form` of strips between these counts, (..., 2, 2), in closed form.

    The midpoints of the edges of one front, in units of 1 / (2 lcm), meet every odd residue between two
    vertices of the other where both reduced counts are odd, every even or every odd one under the half
    otherwise: the largest offset from the nearest vertex is half an edge of the other front where both are
    odd and the strip is open, 1 / (2 lcm) less elsewhere.

    >>> strip_forms(np.array(1), np.array(1)).tolist()
    [[1.0, 2.0], [1.0, 2.0]]
    """
    shared, least = np.gcd(first, second), np.lcm(first, second)
    is_tied = ((first // shared) % 2 == 1) & ((second // shared) % 2 == 1) & (not is_closed)
    less = np.where(is_tied, 0.0, 0.5 / least)
    base = 1 / np.stack([first, second], axis=-1)
    offset = base[..., ::-1] / 2 - less[..., None]
    return np.stack([base, 1.5 * base**2 + 2 * offset**2], axis=-1)


def best_widths(forms: Floats) -> tuple[Floats, Floats]:
    """Return `best_width` of strips of these forms, (n, 2, 2): widths and mean ratios, two of (n,)."""
    (b, c), (d, e) = forms.transpose(1, 2, 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        square = (d * c - b * e) / (2 * (b - d))
    trials = np.sqrt(np.stack([c / 2, e / 2, np.where(square > 0, square, c / 2)]))  # (3, n)
    qualities = np.stack([form_quality(forms, trial) for trial in trials])
    pick = qualities.argmax(axis=0), np.arange(len(forms))
    return trials[pick], qualities[pick]


def qualities_over(sequences: Sequence[Counts], length: float | None, *, is_closed: bool = False) -> Floats:
    """Return the mean ratio of each sequence over a length, in heights, None for its best, (n_sequences,).

    >>> qualities_over([(7, 4, 2, 1), (7, 4, 1)], None).round(3).tolist()
    [0.756, 0.5]
    """
    n_layers = np.array([len(c) - 1 for c in sequences])
    flat = (
        np.concatenate([np.array(c[:-1]) for c in sequences]),
        np.concatenate([np.array(c[1:]) for c in sequences]),
    )
    start = np.concatenate([[0], np.cumsum(n_layers)[:-1]])
    forms = strip_forms(*flat, is_closed=is_closed)
    caps = np.minimum.reduceat(best_widths(forms)[1], start)
    if length is None:
        return caps
    low, high = np.zeros(len(sequences)), caps
    for _ in range(HALVINGS):
        q = (low + high) / 2 if _ else high
        narrow, wide = width_intervals(forms, np.repeat(q, n_layers)[:, None])
        is_reached = (np.add.reduceat(narrow, start) <= length) & (np.add.reduceat(wide, start) >= length)
        low, high = np.where(is_reached, q, low), np.where(is_reached, high, q)
    return low
