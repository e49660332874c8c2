"""The noun Target: the wanted block edge at every point of the domain, and what kept it under s h."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..arrays import Bools, Floats, frozen_floats
from ..sizing import SizeField
from ..sizing.field import EQUILATERAL
from .corners import find_corners
from .domain import Domain


@dataclass(frozen=True, eq=False)
class Target:
    """Wanted edge lengths of blocks at the points of a domain, in the length unit of the input."""

    side: int
    """Triangles along one side of a block: s."""
    length: Floats = field(repr=False)
    """Wanted block edge, (n_points,), length: at most s h."""
    is_corner: Bools = field(repr=False)
    """Points of the domain where a block must have a corner, (n_points,)."""
    turning: Floats = field(repr=False)
    """How much the curve turns left at each point, over the window, (n_points,), radians."""
    gradient_limit: float
    """The bound on |grad length| that was applied."""
    blocks: dict[str, float]
    """Blocks wanted by s h alone ("resolution"), and after each limit in turn: "gradient", "boundary"."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "length", frozen_floats(self.length))


def target_of(domain: Domain, size: SizeField, side: int, *, gradient_limit: float | None = None) -> Target:
    """Return the wanted block edges: side times the size field."""
    length = side * size.h[domain.source]
    is_corner, turning = find_corners(domain, length / domain.scale)
    return Target(side, length, is_corner, turning, np.inf, {"resolution": n_blocks(domain, length)})


def n_blocks(domain: Domain, length: Floats) -> float:
    """Return the number of equilateral blocks of that edge length that cover the domain."""
    mean = np.exp(np.log(length / domain.scale)[domain.triangles[:, :3]].mean(axis=1))
    return float((domain.areas / (EQUILATERAL * mean**2)).sum())
