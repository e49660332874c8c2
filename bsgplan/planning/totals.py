"""How many blocks the whole domain needs, by each of the drivers that can set the number.

Resolution (triangles over triangles per block), the slope of the size field, curvature (the charge), and
the boundary: each is computed on its own, so the user sees which one binds.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..mesh import Mesh
from ..mesh.operators import corner_means
from ..regions import Regions
from ..sizing import SizeField
from ..sizing.counts import capped_triangles, gradient_limited_blocks

GRADIENT_LIMIT = 0.6
"""Default bound on |grad H| of the block size H: across a block its size may change by 60 % of its edge."""

CAPS = (4, 2)
"""Ratios R of the upper-limit counts: h' = min(h, R times the smallest h of the region)."""

PAPER_BLOCK = 64
"""Triangles per block of the paper's upper-limit example ([Zint & Grosso], Sec. 4)."""

PAPER_GROWTH = 1.75
"""The paper refines a quarter of the triangles uniformly: 3/4 + 4/4 of the count."""

SIZE_SPREAD = 0.5
"""ln tau: largest over smallest size wanted inside one block is e^0.5 = 1.65."""


@dataclass(frozen=True)
class UpperLimit:
    """Blocks when elements may be smaller than the size field: h' = min(h, R times the region's least h)."""

    ratio: float
    """R."""
    tris_per_block: int
    """Triangles per block."""
    triangles: float
    """Triangles of the refined mesh."""
    blocks: float
    """Triangles over triangles per block."""


@dataclass(frozen=True)
class Drivers:
    """Block counts of the whole domain that do not depend on patterns."""

    blocks_by_count: float
    """Triangles over triangles per block, Eq. 24."""
    blocks_gradient_limited: float
    """Integral of 1 / block area with the block size limited in gradient."""
    blocks_upper_limit: tuple[UpperLimit, ...]
    """The size field as an upper limit only, for R = 4 and 2 at the given block size and at 64."""
    paper_upper_limit: UpperLimit
    """The paper's own estimate: 1.75 times the triangles at 64 a block."""
    blocks_boundary_limited: float | None
    """The same with the block size also limited by what the boundary carries; None where it is not known."""
    blocks_gradient_bound: float
    """sqrt(3) * integral |grad log h|^2 dA / (ln tau)^2: straight blocks of one size inside."""
    blocks_boundary: int
    """Fewest triangles of any layout: every boundary loop has three edges at least, 3 b - 2 chi."""
    charge: float
    """Irregularity budget of the interior, in units of iota."""
    boundary_charge: float
    """What the boundary carries: -6 chi less the interior."""


def drivers(
    regions: Regions,
    *,
    tris_per_block: int = 16,
    gradient_limit: float = GRADIENT_LIMIT,
    boundary_limited: float | None = None,
) -> Drivers:
    """Return the block counts of the regions' part of the domain, driver by driver.

    boundary_limited is the count of the whole domain that its boundary allows, from who knows the boundary.
    """
    size, topology = regions.size, regions.size.mesh.topology
    inside = regions.label >= 0
    weight = float(size.triangle_weights[inside].sum())
    side = float(np.sqrt(tris_per_block))
    least_h = np.array([region.h_min for region in regions])
    cap = least_h[np.where(inside, regions.label, 0)]
    refined = {ratio: capped_triangles(size, ratio * cap, inside) for ratio in CAPS}
    sizes = sorted({tris_per_block, PAPER_BLOCK})
    chi = topology.euler_characteristic + topology.n_pinches
    return Drivers(
        blocks_by_count=weight / tris_per_block,
        blocks_gradient_limited=gradient_limited_blocks(size, side, gradient_limit, inside),
        blocks_boundary_limited=boundary_limited,
        blocks_upper_limit=tuple(
            UpperLimit(ratio, n, refined[ratio], refined[ratio] / n) for ratio in CAPS for n in sizes
        ),
        paper_upper_limit=UpperLimit(
            4, PAPER_BLOCK, PAPER_GROWTH * weight, PAPER_GROWTH * weight / PAPER_BLOCK
        ),
        blocks_gradient_bound=float(np.sqrt(3) * _slope_energy(regions)[inside].sum() / SIZE_SPREAD**2),
        blocks_boundary=boundary_floor(size.mesh),
        charge=regions.charge,
        boundary_charge=-6.0 * chi - regions.charge,
    )


def boundary_floor(mesh: Mesh) -> int:
    """Return the fewest triangles of any layout of a mesh's domain: 3 b - 2 chi, b boundary loops."""
    topology = mesh.topology
    chi = topology.euler_characteristic + topology.n_pinches
    return max(3 * topology.n_boundary_loops - 2 * chi, 1)


def least_blocks(size: SizeField, tris_per_block: int, gradient_limit: float) -> int:
    """Return the blocks needed whatever the patterns are: by the size gradient and by the boundary."""
    everywhere = np.ones(size.mesh.n_triangles, dtype=bool)
    limited = gradient_limited_blocks(size, float(np.sqrt(tris_per_block)), gradient_limit, everywhere)
    return max(round(limited), boundary_floor(size.mesh))


def _slope_energy(regions: Regions) -> Floats:
    """Return the integral of |grad log h|^2 over each triangle, (n_triangles,)."""
    size, mesh = regions.size, regions.size.mesh
    squares = sum(corner_means(mesh.triangles, component) ** 2 for component in size.slope.T)
    return np.asarray(squares * mesh.areas)
