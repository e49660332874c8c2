"""The noun Alike: patterns with as many layers, each in a shape of its own, side by side.

The same work for each is done for all at once: positions, lengths and qualities have one row a pattern.
Invariants: all are open or all are closed; a row of positions runs from 0 to the length of its shape.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from ..arrays import Floats, Ints
from .frustum import mean_ratios
from .pattern import Pattern
from .shape import Shape
from .strip import critical_turns, strip_table

APART = 2.0
"""Shapes of length 1 are looked up this far apart: no position of one comes near the next."""


@dataclass(frozen=True, eq=False)
class Alike:
    """Patterns with as many layers in their shapes."""

    counts: Ints
    """Elements of each front, (n, n_fronts)."""
    lengths: Floats
    """Distance of the fine end from the coarse end, (n,), length."""
    knots: Floats
    """Stations of all shapes, their distances, lengths of fronts, and keys to look them up, (3, n_knots)."""
    first_knot: Ints
    """Where the stations of each shape begin, and their number, (n + 1,)."""
    table: Floats
    """`strip_table` of all strips, (4, n_triangles)."""
    strip: Ints
    """Strip of each triangle, counted over all patterns, (n_triangles,)."""
    critical: Ints
    """Pattern, layer and side of the base, 0 or 1, of each critical triangle, (3, n_critical)."""
    shares: Floats
    """Base of each critical triangle, as a share of its front, (n_critical,)."""
    turns: Floats
    """Turn of its apex against the midpoint of the base, (n_critical,)."""
    is_closed: bool
    """True where fronts are rings."""

    def __len__(self) -> int:
        return len(self.counts)

    @property
    def n_layers(self) -> int:
        """Number of strips of each pattern."""
        return self.counts.shape[1] - 1

    def front_lengths(self, positions: Floats, rows: Ints) -> Floats:
        """Return the length of a front at each position, (len(rows), ...), length; one row a pattern."""
        across = (-1,) + (1,) * (positions.ndim - 1)
        keys = positions / self.lengths[rows].reshape(across) + (APART * rows).reshape(across)
        low, high = self.first_knot[rows].reshape(across), self.first_knot[rows + 1].reshape(across) - 2
        before = np.clip(np.searchsorted(self.knots[2], keys.ravel()).reshape(keys.shape) - 1, low, high)
        (x, y), (x1, y1) = self.knots[:2, before], self.knots[:2, before + 1]
        return np.asarray((y1 - y) / (x1 - x) * (positions - x) + y)

    def qualities(self, positions: Floats) -> Floats:
        """Return the smallest mean ratio of each pattern with its fronts at these positions, (n,)."""
        lengths = self.front_lengths(positions, np.arange(len(self)))
        first, second, width = (
            values.ravel()[self.strip] for values in (lengths[:, :-1], lengths[:, 1:], np.diff(positions))
        )
        each = mean_ratios(self.table, first, second, width, is_closed=self.is_closed)
        start = np.searchsorted(self.strip, self.n_layers * np.arange(len(self)))
        return np.asarray(np.minimum.reduceat(each, start))


def alike(patterns: Sequence[Pattern], shapes: Sequence[Shape]) -> Alike:
    """Return patterns with as many layers, all open or all closed, in their shapes, side by side.

    >>> both = alike([Pattern.parse("2:1"), Pattern.parse("3:2")], [Shape.rectangle(0.5)] * 2)
    >>> both.qualities(np.array([[0.0, 0.5], [0.0, 0.5]])).round(3)
    array([0.866, 0.799])
    """
    is_closed = patterns[0].is_closed
    strips = list(chain.from_iterable(pattern.strips for pattern in patterns))
    tables = [strip_table(*pair, is_closed=is_closed) for pair in strips]
    turns = np.array([critical_turns(*pair, is_closed=is_closed) for pair in strips])
    is_needed = turns[:, :, :1] < turns  # of two that are equal, one
    is_needed[:, :, 0] = True
    strip, side, which = np.nonzero(is_needed)
    counts = np.array([pattern.counts for pattern in patterns])
    n_layers = patterns[0].n_layers
    stations = [_stations(shape) for shape in shapes]
    n_knots = [len(x) for x, _ in stations]
    lengths = np.array([shape.length for shape in shapes])
    x, y = (np.concatenate(part) for part in zip(*stations, strict=True))
    row = np.repeat(np.arange(len(patterns)), n_knots)
    return Alike(
        counts,
        lengths,
        np.stack([x, y, x / lengths[row] + APART * row]),
        np.concatenate([[0], np.cumsum(n_knots)]),
        np.concatenate(tables, axis=1),
        np.repeat(np.arange(len(strips)), [table.shape[1] for table in tables]),
        np.stack([strip // n_layers, strip % n_layers, side]),
        1 / np.array(strips)[strip, side],
        turns[strip, side, which],
        is_closed,
    )


def _stations(shape: Shape) -> tuple[Floats, Floats]:
    """Return the stations of a shape and the lengths of fronts there: the mean one where it is straight."""
    if shape.is_straight:
        return np.array([0.0, shape.length]), np.full(2, shape.height)
    return shape.positions, shape.lengths
