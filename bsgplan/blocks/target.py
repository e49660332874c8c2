"""The noun Target: the wanted block edge at every point of the domain, and what kept it under s h."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache

import numpy as np

from ..arrays import Bools, Floats, frozen_floats, sums_by
from ..mesh.operators import corner_means
from ..sizing import SizeField
from ..sizing.diffusion import Diffusion, gently
from ..sizing.field import covering
from .corners import find_corners
from .domain import Domain
from .limits import boundary_limit, channel_limit

SLOPES = (0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.5, 2.0)
"""Bounds on the gradient of the block edge on smooth domains."""

COST = 1.03
"""On smooth domains the bound is loosened until it costs at most this factor in blocks."""

RAGGED_SLOPE = 1.0
"""The bound on ragged coasts."""

STEEP = 1.0
"""Where a bound of this costs more than COST, no blocks can follow the size: they see it smoothed, unless the
coast is ragged, where other limits cost more."""

SPREAD = 5 / 144
"""Square of the length over which densities are smoothed gently there, in wanted edges a.

Sizes are looked up at the vertices of blocks, and each stands for its hexagon, of variance 5 a^2 / 72 along
any line; diffusion over l spreads a point by 2 l^2. Gently, so that long waves and the wall are spared."""

LEAST_DENSITY = 0.25
"""Smoothing leaves at least this share of the density that was: so sharp a bend could make it negative."""

RAGGEDNESS = 0.04
"""A domain is ragged where more than this share of its boundary cannot carry RAGGED_EDGE of s h."""

RAGGED_EDGE = 0.7
"""Share of the wanted edge under which a boundary point counts as ragged."""

FLOORS = (0.25, 0.35, 0.5)
"""Shares of the wanted edge under which no limit goes: the first whose cost is borne, else the last."""

BOUNDARY_COST = 1.5
"""The floor rises until the boundary costs at most this factor in blocks."""

STRETCH = 1.5
"""Across channels narrower than the floor the edge is this times what fits: the floor is for bays and capes,
which a block cuts off, but a block across a channel is as thin as that. Of that area it is STRETCH^2 times as
long as it is wide, and its mean ratio still .74."""

SMALL, SMALL_FLOOR = 8, 0.08
"""A component that wants fewer blocks than this has a floor of its own: slivers off the coast are cheap."""

PASSES = 2
"""Corners and limits are found so many times, each with the windows of the edges found before."""


@dataclass(frozen=True, eq=False)
class Target:
    """Wanted edge lengths of blocks at the points of a domain, in the length unit of the input."""

    side: int
    """Triangles along one side of a block: s."""
    length: Floats = field(repr=False)
    """Wanted block edge, (n_points,), length: at most s h as blocks see it."""
    is_corner: Bools = field(repr=False)
    """Points of the domain where a block must have a corner, (n_points,)."""
    turning: Floats = field(repr=False)
    """How much the curve turns left at each point, over the window, (n_points,), radians."""
    gradient_limit: float
    """The bound on |grad length| that was applied."""
    raggedness: float
    """Share of the boundary's length that cannot carry RAGGED_EDGE of s h."""
    blocks: dict[str, float]
    """Blocks wanted by s h alone ("resolution"), with its gradient limited ("gradient"), and with what
    the boundary carries as well ("boundary")."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "length", frozen_floats(self.length))


def target_of(domain: Domain, size: SizeField, side: int, *, gradient_limit: float | None = None) -> Target:
    """Return the wanted block edges: side times the size field, limited in gradient and at the boundary.

    gradient_limit None takes RAGGED_SLOPE where the domain is ragged, else the tightest of SLOPES that costs
    at most COST in blocks; sizes too steep for any block are smoothed first.
    """
    h = size.h[domain.source] / domain.scale
    wanted = side * h
    plain, is_small = n_blocks(domain, wanted), _is_small(domain, wanted)
    across = channel_limit(domain, wanted)
    n_limited = cache(lambda slope: n_blocks(domain, _own_limited(domain, size, side, slope)))
    smooth = gradient_limit or _slope(plain, n_limited)
    if gradient_limit is None and smooth > STEEP:
        least = np.full(domain.n_points, FLOORS[0])
        *_, rough = _limited(domain, wanted, h, least, across, STEEP, STEEP)
        if rough <= RAGGEDNESS:
            wanted = seen = _seen(domain, wanted)
            across = channel_limit(domain, wanted)
            n_limited = cache(lambda slope: n_blocks(domain, limited(domain, seen, slope)))
            smooth = _slope(plain, n_limited)
    for floor in FLOORS:
        least = np.where(is_small, SMALL_FLOOR, max(floor, 1 / side))  # no edge shorter than the input's
        length, slope, rough = _limited(
            domain, wanted, h, least, across, smooth, gradient_limit or RAGGED_SLOPE
        )
        if n_blocks(domain, length) <= BOUNDARY_COST * plain:
            break
    is_corner, turning = find_corners(domain, length)
    blocks = {
        "resolution": plain,
        "gradient": n_limited(slope),
        "boundary": n_blocks(domain, length),
    }
    return Target(side, length * domain.scale, is_corner, turning, slope, rough, blocks)


def _limited(
    domain: Domain, wanted: Floats, h: Floats, least: Floats, across: Floats, smooth: float, ragged: float
) -> tuple[Floats, float, float]:
    """Return the limited block edge, the bound on its gradient (smooth or ragged), and the raggedness."""
    length = wanted
    for _ in range(PASSES):
        is_corner, _turning = find_corners(domain, length)
        share = np.minimum(boundary_limit(domain, wanted, h, is_corner), across) / wanted
        rough = _raggedness(domain, np.maximum(share, least))
        slope = ragged if rough > RAGGEDNESS else smooth
        length = np.minimum(wanted * np.clip(share, least, 1.0), STRETCH * across)
        length = limited(domain, length, slope)
    return length, slope, rough


def limited(domain: Domain, length: Floats, slope: float) -> Floats:
    """Return the largest edge lengths below those given whose gradient nowhere exceeds slope, (n_points,).

    Both in the domain's unit; see `Links`.
    """
    return domain.links.limited(length * domain.scale, slope) / domain.scale


def _own_limited(domain: Domain, size: SizeField, side: int, slope: float) -> Floats:
    """Return side times the size field limited in gradient, (n_points,), in the domain's unit."""
    if domain.mesh is size.mesh:  # a plan asks for the same
        return size.limited(side, slope, domain.links) / domain.scale
    return limited(domain, side * size.h[domain.source] / domain.scale, slope)


def _seen(domain: Domain, length: Floats) -> Floats:
    """Return the block edges that blocks see: those of the density, 1 / length^2, smoothed over a block."""
    mean = np.exp(corner_means(domain.mesh.triangles, np.log(length)))
    density = length**-2
    seen = Diffusion.over(domain.mesh, domain.scale * mean).filtered(density, gently, float(np.sqrt(SPREAD)))
    return np.asarray(np.maximum(seen, LEAST_DENSITY * density) ** -0.5)


def n_blocks(domain: Domain, length: Floats) -> float:
    """Return the number of equilateral blocks of that edge length, in the domain's unit, that cover it."""
    return float(covering(domain.mesh, length * domain.scale).sum())


def _is_small(domain: Domain, wanted: Floats) -> Bools:
    """Return the points of components that want fewer than SMALL blocks, (n_points,)."""
    component = domain.mesh.topology.component
    total = sums_by(component, covering(domain.mesh, wanted * domain.scale), int(component.max()) + 1)
    result = np.zeros(domain.n_points, dtype=bool)
    result[domain.mesh.triangles] = (total < SMALL)[component][:, None]
    return result


def _slope(plain: float, n_limited: Callable[[float], float]) -> float:
    """Return the first of SLOPES that costs at most COST in blocks, the last if none does.

    plain is the number of blocks without a limit, n_limited that with the gradient limited to a slope.
    """
    for slope in SLOPES[:-1]:
        if n_limited(slope) <= COST * plain:
            return slope
    return SLOPES[-1]


def _raggedness(domain: Domain, share: Floats) -> float:
    """Return the share of the boundary's length whose ends carry less than RAGGED_EDGE of the wanted edge."""
    a, b = domain.outline.T
    steps = np.linalg.norm(domain.points[b] - domain.points[a], axis=1)
    is_ragged = np.minimum(share[a], share[b]) < RAGGED_EDGE
    return float(steps[is_ragged].sum() / steps.sum())
