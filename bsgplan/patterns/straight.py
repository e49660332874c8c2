"""Straight patterns over a length: the best quality and the widths that have it, for many patterns at once.

A strip reaches mean ratio Q for widths in one interval (`width.width_intervals`), and the intervals of a
pattern's strips add: it reaches Q over a length where sum lo(Q) <= length <= sum hi(Q). Both close in on each
other as Q grows, so the best Q is where the length meets one of them, or the worst strip's own best. That
meeting is found between two bounds, by false position with the Illinois rule, in t of Q = best / cosh(t): the
widths have a square root at the best Q and none in t, and far from it their logarithms are linear in t.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

import numpy as np

from ..arrays import Bools, Floats, Ints
from .pattern import Counts
from .width import best_widths, form_quality, strip_forms, width_intervals

ROUNDS = 60
"""Rounds of false position at most: ten reach rounding, halving alone would take this many."""

SLACK = 1e-9
"""Share by which sums of widths, and qualities, may miss what they must reach: rounding of sums."""

CLOSE = 1e-13
"""Share by which widths may miss the length: rounding of sums of a hundred."""


def qualities_over(sequences: Sequence[Counts], length: float | None, *, is_closed: bool = False) -> Floats:
    """Return the mean ratio of each sequence over a length, in heights, None for its best, (n_sequences,).

    >>> qualities_over([(7, 4, 2, 1), (7, 4, 1)], None).round(3).tolist()
    [0.756, 0.5]
    """
    forms, start = _strips(sequences, is_closed=is_closed)
    if length is None:
        return np.minimum.reduceat(best_widths(forms)[1], start)
    return best_qualities(forms, start, np.full(len(sequences), length))


def reaches(
    sequences: Sequence[Counts], length: float | None, q: Floats, *, is_closed: bool = False
) -> Bools:
    """Return whether each sequence reaches a mean ratio of its own over a length, (n_sequences,).

    Within SLACK: cheaper than `qualities_over` for what falls short.

    >>> reaches([(7, 4, 2, 1), (7, 4, 1)], None, np.array([0.7, 0.7])).tolist()
    [True, False]
    """
    forms, start = _strips(sequences, is_closed=is_closed)
    n_layers = np.diff(start, append=len(forms))
    is_possible = np.asarray(np.minimum.reduceat(best_widths(forms)[1], start) >= q * (1 - SLACK))
    if length is None:
        return is_possible
    narrow, wide = _spans(forms, start, n_layers, q * (1 - SLACK))
    return is_possible & (narrow <= length) & (wide >= length)


def straight_widths(sequences: Sequence[Counts], lengths: Floats, *, is_closed: bool = False) -> Floats:
    """Return the widths of the strips that maximise q_min of each sequence over its length, at height 1.

    One row a sequence, (n_sequences, n_layers): all have as many layers.

    >>> straight_widths([(4, 2, 1)], np.array([0.75])).round(3).tolist()
    [[0.25, 0.5]]
    """
    forms, start = _strips(sequences, is_closed=is_closed)
    n_layers = len(sequences[0]) - 1
    reached = best_qualities(forms, start, lengths)
    low, high = width_intervals(forms, np.repeat(reached, n_layers)[:, None])
    # at the peak of a strip, but for rounding: nothing beats its own best width
    is_found = np.isfinite(low)
    low, high = (np.where(is_found, width, best_widths(forms)[0]) for width in (low, high))
    low, high = low.reshape(-1, n_layers), high.reshape(-1, n_layers)
    slack = (high - low).sum(axis=1)
    missing = lengths - low.sum(axis=1)
    share = np.clip(np.divide(missing, slack, out=np.full(len(low), 0.5), where=slack > 0), 0, 1)
    widths = low + share[:, None] * (high - low)
    return np.asarray(widths * (lengths / widths.sum(axis=1))[:, None])


def best_qualities(forms: Floats, start: Ints, lengths: Floats) -> Floats:
    """Return the best smallest mean ratio of each pattern over its length, (n_patterns,).

    forms holds `strip_form` of all strips, (n_strips, 2, 2), start where the strips of each pattern begin.
    """
    n_layers = np.diff(start, append=len(forms))
    widths, qualities = best_widths(forms)
    best = np.minimum.reduceat(qualities, start)
    stretch = lengths / np.add.reduceat(widths, start)
    stretched = form_quality(forms, widths * np.repeat(stretch, n_layers))
    reached = np.minimum(np.minimum.reduceat(stretched, start), best)
    narrow, wide = _spans(forms, start, n_layers, best)
    is_short, is_long = narrow > lengths, wide < lengths
    found = np.where(is_short | is_long, reached, best)
    open_ones = np.flatnonzero((is_short | is_long) & (reached < best))
    if len(open_ones):
        among = np.repeat(is_short | is_long, n_layers) & np.repeat(reached < best, n_layers)
        found[open_ones] = _meeting(
            forms[among],
            n_layers[open_ones],
            lengths[open_ones],
            best[open_ones],
            reached[open_ones],
            is_short[open_ones],
        )
    return found


def _meeting(
    forms: Floats, n_layers: Ints, lengths: Floats, best: Floats, reached: Floats, is_short: Bools
) -> Floats:
    """Return the quality between reached and best at which the widths just make the length, (n_patterns,)."""
    start = np.concatenate([[0], np.cumsum(n_layers)[:-1]])

    def excess(t: Floats) -> Floats:
        narrow, wide = _spans(forms, start, n_layers, best / np.cosh(t))
        return np.where(is_short, np.log(narrow / lengths), np.log(lengths / wide))

    inside, outside = np.arccosh(best / reached), np.zeros(len(best))
    low, high = excess(inside), excess(outside)  # at most 0, above 0
    t, here = inside, low
    for _ in range(ROUNDS):
        is_found = (np.abs(here) <= CLOSE) | (high - low <= CLOSE) | (inside - outside <= CLOSE)
        if is_found.all():
            break
        step = np.divide(high, high - low, out=np.zeros(len(best)), where=~is_found)
        t = np.where(is_found, t, outside + step * (inside - outside))
        was_in, here = here <= 0, excess(t)
        is_in = here <= 0
        # Illinois: the bound that stays a second time counts half
        low = np.where(is_in, here, np.where(was_in, low, low / 2))
        high = np.where(is_in, np.where(was_in, high / 2, high), here)
        inside, outside = np.where(is_in, t, inside), np.where(is_in, outside, t)
    return np.asarray(best / np.cosh(t))


def _spans(forms: Floats, start: Ints, n_layers: Ints, q: Floats) -> tuple[Floats, Floats]:
    """Return the sums of the smallest and of the largest widths that reach q, two of (n_patterns,).

    Beyond the best quality of a strip they are those at its peak: rounding does not empty an interval.
    """
    b, c = forms[..., 0], forms[..., 1]
    each = np.repeat(q, n_layers)[:, None]
    high = (2 * np.sqrt(3) * b + np.sqrt(np.maximum(12 * b**2 - 8 * each**2 * c, 0))) / (4 * each)
    low = c / (2 * high)
    return np.add.reduceat(low.max(axis=1), start), np.add.reduceat(high.min(axis=1), start)


def side_by_side(sequences: Sequence[Counts]) -> tuple[Ints, Ints]:
    """Return the counts of all sequences, flat, and where each sequence begins, (n_sequences,)."""
    sizes = np.array([len(counts) for counts in sequences], dtype=np.int64)
    flat = np.fromiter(chain.from_iterable(sequences), dtype=np.int64, count=int(sizes.sum()))
    return flat, np.cumsum(sizes) - sizes


def _strips(sequences: Sequence[Counts], *, is_closed: bool) -> tuple[Floats, Ints]:
    """Return the forms of all strips, (n_strips, 2, 2), and where each sequence begins, (n_sequences,)."""
    flat, start = side_by_side(sequences)
    is_strip = np.ones(len(flat), dtype=bool)
    is_strip[start[1:] - 1] = is_strip[-1] = False  # the last count of a sequence begins none
    first, second = flat[is_strip], flat[np.flatnonzero(is_strip) + 1]
    return strip_forms(first, second, is_closed=is_closed), start - np.arange(len(start))
