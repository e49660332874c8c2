"""The noun Spacing: where the fronts of a pattern stand in a region, and the smallest mean ratio that gives.

Invariants: the first front is at 0, the last at the region's length, positions increase; the best spacing
is never worse than the uniform one or the paper's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, frozen_floats
from ..errors import InvalidOption
from .alike import Alike, alike
from .frustum import pattern_qualities
from .pattern import Pattern
from .placement import place
from .shape import Shape
from .straight import straight_widths

FIXED_POINT_ROUNDS = 20
"""Rounds at most of widths from front lengths from widths; a straight region needs two."""

MOST_STRIPS = 1024
"""Strips placed at once, which take some 10 MB."""


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
    return best_spacings([pattern], [shape])[0]


def best_spacings(patterns: Sequence[Pattern], shapes: Sequence[Shape]) -> list[Spacing]:
    """Return the best spacing of each pattern in its shape, see `best_spacing`; many cost less than each.

    >>> patterns = [Pattern.parse(text) for text in ("7:4:2:1", "7:4:1")]
    >>> [round(s.q_min, 3) for s in best_spacings(patterns, [Shape.rectangle(0.7)] * 2)]
    [0.736, 0.5]
    """
    groups: dict[tuple[int, bool, bool], list[int]] = {}
    for k, (pattern, shape) in enumerate(zip(patterns, shapes, strict=True)):
        _check_kind(pattern, shape)
        groups.setdefault((pattern.n_layers, shape.is_closed, shape.is_straight), []).append(k)
    found: dict[int, Spacing] = {}
    for (n_layers, _, is_straight), group in groups.items():
        at_once = max(1, MOST_STRIPS // n_layers)
        for part in (group[k : k + at_once] for k in range(0, len(group), at_once)):
            these = alike([patterns[k] for k in part], [shapes[k] for k in part])
            heights = np.array([shapes[k].height for k in part])
            positions = _positions_in_rectangles(these, heights)
            if not is_straight:
                positions = _best_positions(these, positions)
            each = zip(part, positions, these.qualities(positions).tolist(), strict=True)
            found.update({k: Spacing(row, q, is_straight) for k, row, q in each})
    return [found[k] for k in range(len(patterns))]


def paper_spacing(pattern: Pattern, shape: Shape) -> Spacing:
    """Return front positions whose widths are proportional to the coarser front's edge.

    So are the fronts of [Zint & Grosso], Figures 6 and 7.

    >>> paper_spacing(Pattern.parse("4:2:1"), Shape.rectangle(3.0)).positions.tolist()
    [0.0, 1.0, 3.0]
    """
    _check_kind(pattern, shape)
    return spacing_at(pattern, shape, _proportional(alike([pattern], [shape]), np.maximum)[0])


def uniform_spacing(pattern: Pattern, shape: Shape) -> Spacing:
    """Return front positions at equal distances."""
    _check_kind(pattern, shape)
    return spacing_at(pattern, shape, _uniform(alike([pattern], [shape]))[0])


def spacing_at(pattern: Pattern, shape: Shape, positions: Floats) -> Spacing:
    """Return the spacing with fronts at these positions, (n_fronts,), length."""
    return Spacing(positions, float(pattern_qualities(pattern, shape, positions).min()), shape.is_straight)


def _best_positions(patterns: Alike, straight: Floats) -> Floats:
    """Return the positions placed from the best of four starts, or that start, (n, n_fronts), length."""
    trials = [_uniform(patterns), *(_proportional(patterns, edge) for edge in (np.maximum, np.add)), straight]
    start = _best_of(patterns, trials)
    return _best_of(patterns, [start, place(patterns, start)])


def _best_of(patterns: Alike, trials: list[Floats]) -> Floats:
    """Return of each pattern the positions with the largest smallest mean ratio, (n, n_fronts), length."""
    best = np.argmax([patterns.qualities(positions) for positions in trials], axis=0)
    return np.stack(trials)[best, np.arange(len(patterns))]


def _positions_in_rectangles(patterns: Alike, heights: Floats) -> Floats:
    """Return the best positions in rectangles as long as the shapes, (n, n_fronts), length."""
    sequences = [tuple(row) for row in patterns.counts.tolist()]
    widths = straight_widths(sequences, patterns.lengths / heights, is_closed=patterns.is_closed)
    return _positions(heights[:, None] * widths, patterns.lengths)


def _uniform(patterns: Alike) -> Floats:
    shares = np.linspace(0, 1, patterns.n_layers + 1)
    return np.asarray(patterns.lengths[:, None] * shares)


def _proportional(patterns: Alike, combine: np.ufunc) -> Floats:
    """Return positions of widths proportional to the edges of both their fronts, combined, (n, n_fronts)."""
    rows = np.arange(len(patterns))
    positions = _uniform(patterns)
    for _ in range(FIXED_POINT_ROUNDS):
        edges = patterns.front_lengths(positions[rows], rows) / patterns.counts[rows]
        last, length = positions[rows], patterns.lengths[rows]
        positions[rows] = _positions(combine(edges[:, :-1], edges[:, 1:]), length)
        rows = rows[np.abs(positions[rows] - last).max(axis=1) >= 1e-9 * length]
        if not len(rows):
            break
    return positions


def _positions(widths: Floats, lengths: Floats) -> Floats:
    """Return the positions of fronts these widths apart, stretched to the lengths, (n, n_fronts)."""
    ends = np.cumsum(widths, axis=1)
    inner = ends[:, :-1] * (lengths / ends[:, -1])[:, None]
    return np.concatenate([np.zeros((len(widths), 1)), inner, lengths[:, None]], axis=1)


def _check_kind(pattern: Pattern, shape: Shape) -> None:
    if pattern.is_closed != shape.is_closed:
        kind = ("open", "closed")
        raise InvalidOption(
            f"pattern {pattern} is {kind[pattern.is_closed]} but the shape is {kind[shape.is_closed]}; "
            "make both open or both closed"
        )
