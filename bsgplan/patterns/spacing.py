"""The noun Spacing: where the fronts of a pattern stand in a region, and the smallest mean ratio that gives.

Invariants: the first front is at 0, the last at the region's length, positions increase; the best spacing
is never worse than the uniform one or the paper's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, frozen_floats
from ..errors import InvalidOption
from .frustum import pattern_qualities
from .pattern import Pattern
from .placement import place
from .shape import Shape
from .width import best_width, form_quality, strip_form, width_intervals

FIXED_POINT_ROUNDS = 20
"""Rounds at most of widths from front lengths from widths; a straight region needs two."""


@dataclass(frozen=True, eq=False)
class Spacing:
    """Positions of a pattern's fronts in a region, and their worst block."""

    positions: Floats
    """Distance of each front from the fine end, (n_fronts,), length."""
    q_min: float
    """Smallest mean ratio of the blocks; below 0 where a block is inside out."""
    is_straight: bool
    """True where the region counts as a rectangle, so the best spacing is exact."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "positions", frozen_floats(self.positions))

    @property
    def widths(self) -> Floats:
        """Distance between consecutive fronts, (n_layers,), length."""
        return np.diff(self.positions)


def best_spacing(pattern: Pattern, shape: Shape) -> Spacing:
    """Return the front positions with the largest smallest mean ratio.

    Exact in a straight region, where widths that reach a quality are intervals in closed form;
    by `placement.place` elsewhere.

    >>> spacing = best_spacing(Pattern.parse("7:4:2:1"), Shape.rectangle(0.7))
    >>> round(spacing.q_min, 3)
    0.736
    """
    _check_kind(pattern, shape)
    if shape.is_straight:
        widths = shape.height * straight_widths(pattern, shape.length / shape.height)
        return spacing_at(pattern, shape, _positions(widths, shape.length))
    straight = straight_widths(pattern, shape.length / shape.height)
    starts = [
        uniform_spacing(pattern, shape),
        paper_spacing(pattern, shape),
        _proportional(pattern, shape, np.add),
        spacing_at(pattern, shape, _positions(straight, shape.length)),
    ]
    start = max(starts, key=lambda spacing: spacing.q_min)
    placed = spacing_at(pattern, shape, place(pattern, shape, start.positions))
    return max(start, placed, key=lambda spacing: spacing.q_min)


def paper_spacing(pattern: Pattern, shape: Shape) -> Spacing:
    """Return front positions whose widths are proportional to the coarser front's edge.

    So are the fronts of [Zint & Grosso], Figures 6 and 7.

    >>> paper_spacing(Pattern.parse("4:2:1"), Shape.rectangle(3.0)).positions.tolist()
    [0.0, 1.0, 3.0]
    """
    _check_kind(pattern, shape)
    return _proportional(pattern, shape, np.maximum)


def uniform_spacing(pattern: Pattern, shape: Shape) -> Spacing:
    """Return front positions at equal distances."""
    _check_kind(pattern, shape)
    return spacing_at(pattern, shape, np.linspace(0, shape.length, pattern.n_fronts))


def spacing_at(pattern: Pattern, shape: Shape, positions: Floats) -> Spacing:
    """Return the spacing with fronts at these positions, (n_fronts,), length."""
    return Spacing(positions, float(pattern_qualities(pattern, shape, positions).min()), shape.is_straight)


def straight_widths(pattern: Pattern, length: float) -> Floats:
    """Return the widths of the strips that maximise q_min over a length, at height 1, (n_layers,).

    Bisection on Q: a quality can be reached where the length lies between the sums of the smallest and of
    the largest widths that reach it.

    >>> straight_widths(Pattern.parse("4:2:1"), 0.75).round(3).tolist()
    [0.25, 0.5]
    """
    closed, strips = pattern.is_closed, pattern.strips
    forms = np.stack([strip_form(m, n, is_closed=closed) for m, n in strips])
    widths, qualities = np.array([best_width(m, n, is_closed=closed) for m, n in strips]).T
    reached = float(form_quality(forms, widths * (length / widths.sum())).min())
    missed = float(qualities.min())
    if _is_reached(forms, missed, length):
        reached = missed
    while reached < (q := (reached + missed) / 2) < missed:
        reached, missed = (q, missed) if _is_reached(forms, q, length) else (reached, q)
    low, high = width_intervals(forms, reached)
    if not np.isfinite(low).all():  # at the peak of a strip, but for rounding: nothing beats this
        return np.asarray(widths * (length / widths.sum()))
    slack = high.sum() - low.sum()
    share = np.clip((length - low.sum()) / slack, 0, 1) if slack > 0 else 0.5
    widths = low + share * (high - low)
    return np.asarray(widths * (length / widths.sum()))


def _is_reached(forms: Floats, q: float, length: float) -> bool:
    low, high = width_intervals(forms, q)
    return bool(low.sum() <= length <= high.sum())


def _proportional(pattern: Pattern, shape: Shape, combine: np.ufunc) -> Spacing:
    counts = np.array(pattern.counts)
    positions = np.linspace(0, shape.length, pattern.n_fronts)
    for _ in range(FIXED_POINT_ROUNDS):
        edges = shape.front_lengths(positions) / counts
        last, positions = positions, _positions(combine(edges[:-1], edges[1:]), shape.length)
        if np.abs(positions - last).max() < 1e-9 * shape.length:
            break
    return spacing_at(pattern, shape, positions)


def _positions(widths: Floats, length: float) -> Floats:
    ends = np.cumsum(widths)
    return np.concatenate([[0.0], ends[:-1] * (length / ends[-1]), [length]])


def _check_kind(pattern: Pattern, shape: Shape) -> None:
    if pattern.is_closed != shape.is_closed:
        kind = ("open", "closed")
        raise InvalidOption(
            f"pattern {pattern} is {kind[pattern.is_closed]} but the shape is {kind[shape.is_closed]}; "
            "make both open or both closed"
        )
