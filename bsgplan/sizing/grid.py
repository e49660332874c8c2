"""The noun GridBackground: sizes at the crossings of a grid of lines, their logarithms linear between."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats, Ints, frozen_floats
from ..errors import InvalidSize
from .background import ROUNDING, check_covered, check_positive

FULL_TURN = 360.0
"""Degrees of longitude around the globe."""


@dataclass(frozen=True, eq=False)
class GridBackground:
    """Sizes on a rectangular grid; raises InvalidSize unless both axes ascend or descend and shapes agree."""

    x: Floats
    """First coordinate of the columns, (n_x,), length or degrees of longitude."""
    y: Floats
    """Second coordinate of the rows, (n_y,), length or degrees of latitude."""
    sizes: Floats
    """Edge length at each crossing, (n_y, n_x), length; only those that are used need be positive."""

    def __post_init__(self) -> None:
        sizes = np.asarray(self.sizes, dtype=np.float64)
        if sizes.shape != (len(self.y), len(self.x)) or min(sizes.shape) < 2:
            raise InvalidSize(
                f"a grid of {len(self.x)} columns and {len(self.y)} rows has sizes {sizes.shape}; "
                "give one a crossing, two or more each way"
            )
        for name, axis in (("x", 1), ("y", 0)):
            lines = np.asarray(getattr(self, name), dtype=np.float64)
            if lines[0] > lines[-1]:
                lines, sizes = lines[::-1], np.flip(sizes, axis)
            if not (np.isfinite(lines).all() and (np.diff(lines) > 0).all()):
                raise InvalidSize(f"the {name} coordinates of the grid do not ascend; sort them")
            object.__setattr__(self, name, frozen_floats(lines))
        object.__setattr__(self, "sizes", frozen_floats(sizes))

    def at(self, points: Floats) -> Floats:
        """Return the size at points of the plane, (n_points,), length; raises InvalidSize where not covered.

        >>> grid = GridBackground(np.array([0.0, 2.0]), np.array([0.0, 1.0]), np.array([[1.0, 4], [1, 4]]))
        >>> grid.at(np.array([[1.0, 0.5]]))
        array([2.])
        """
        if points.shape[1] != 2:
            raise InvalidSize("the sizes lie in the plane, the mesh in space; give sizes on the surface")
        column, right, is_in = _between(self.x, points[:, 0])
        row, up, is_in_too = _between(self.y, points[:, 1])
        check_covered(points, is_in & is_in_too)
        total = np.zeros(len(points))
        with np.errstate(divide="ignore", invalid="ignore"):
            for i, j, weight in (
                (row, column, (1 - up) * (1 - right)),
                (row, column + 1, (1 - up) * right),
                (row + 1, column, up * (1 - right)),
                (row + 1, column + 1, up * right),
            ):
                sizes = self.sizes[i, j]
                total += np.where(weight > 0, weight * np.log(np.where(sizes > 0, sizes, np.nan)), 0.0)
        result = np.exp(total)
        check_positive(points, result)
        return np.asarray(result)


def around_the_globe(grid: GridBackground) -> GridBackground:
    """Return a grid in degrees with its first column again a full turn on, where one step closes the turn."""
    gap = grid.x[0] + FULL_TURN - grid.x[-1]
    if not 0 < gap <= 1.5 * np.diff(grid.x).max():
        return grid
    return GridBackground(
        np.append(grid.x, grid.x[0] + FULL_TURN), grid.y, np.column_stack([grid.sizes, grid.sizes[:, 0]])
    )


def _between(lines: Floats, values: Floats) -> tuple[Ints, Floats, Bools]:
    """Return the line before each value, the share of the way to the next, and if the value is inside."""
    slack = ROUNDING * (lines[-1] - lines[0])
    is_in = (values >= lines[0] - slack) & (values <= lines[-1] + slack)
    before = np.clip(np.searchsorted(lines, values, side="right") - 1, 0, len(lines) - 2)
    share = (values - lines[before]) / (lines[before + 1] - lines[before])
    return before, np.clip(share, 0.0, 1.0), is_in
