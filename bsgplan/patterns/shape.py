"""The noun Shape: how long the fronts of a region are, from its fine end to its coarse end.

Produced by hand or from a region's profile; consumed by the spacing and the realisation of patterns.
Invariants: positions start at 0 and increase, lengths are positive, everything is finite.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, frozen_floats
from ..errors import InvalidOption

STRAIGHT_RATIO = 1.1
"""An open region whose longest front is under this multiple of its shortest counts as a rectangle: the
fronts of measured regions wobble by that much, and no front is then 5 % off the mean length or much more."""


@dataclass(frozen=True, eq=False)
class Shape:
    """The length of a region's front at each distance from its fine end."""

    positions: Floats
    """Distances from the fine end, (n,), increasing from 0, length."""
    lengths: Floats
    """Length of the front at that distance, (n,), length."""
    is_closed: bool = False
    """True where fronts are closed curves around an annulus."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "positions", frozen_floats(self.positions))
        object.__setattr__(self, "lengths", frozen_floats(self.lengths))
        _check(self.positions, self.lengths)

    @classmethod
    def rectangle(cls, length: float, height: float = 1.0) -> Shape:
        """Return the shape of a rectangle: fronts as long as its height, its ends at distance length.

        >>> Shape.rectangle(2.0).length
        2.0
        """
        return cls(np.array([0.0, length]), np.array([height, height]))

    @property
    def length(self) -> float:
        """Distance from the fine to the coarse end, length."""
        return float(self.positions[-1])

    @property
    def height(self) -> float:
        """Mean length of the fronts over the distance, length.

        >>> Shape(np.array([0.0, 1.0]), np.array([1.0, 3.0])).height
        2.0
        """
        share = np.diff(self.positions) / self.length
        return float((share * (self.lengths[1:] + self.lengths[:-1]) / 2).sum())

    @property
    def is_straight(self) -> bool:
        """True where the fronts are open and about equally long: a rectangle of the mean length."""
        return not self.is_closed and bool(self.lengths.max() < STRAIGHT_RATIO * self.lengths.min())

    def front_lengths(self, positions: Floats) -> Floats:
        """Return the length of a front at each position, (...), length; the mean one where straight."""
        if self.is_straight:
            return np.full(np.shape(positions), self.height)
        return np.interp(positions, self.positions, self.lengths)


def _check(positions: Floats, lengths: Floats) -> None:
    if positions.ndim != 1 or positions.shape != lengths.shape or positions.size < 2:
        raise InvalidOption(
            f"shape has positions {positions.shape} and lengths {lengths.shape}; give as many, at least 2"
        )
    if not (np.isfinite(positions).all() and positions[0] == 0 and (np.diff(positions) > 0).all()):
        raise InvalidOption(
            f"positions of shape, {positions}, do not increase from 0; sort them and subtract the first"
        )
    if not (np.isfinite(lengths).all() and (lengths > 0).all()):
        raise InvalidOption(
            f"shape has a front of length {lengths.min()}; end the region before its front vanishes"
        )
