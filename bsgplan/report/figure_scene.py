"""The noun Scene: everything of a plan that its figure draws, computed once for all panels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array, diags_array
from scipy.sparse.linalg import LinearOperator, cg

from ..arrays import Floats, Ints
from ..mesh.operators import stiffness, vertex_areas
from ..planning import Plan
from ..regions.contours import front_levels, front_lines, vertex_charges
from ..regions.region import UNIFORM
from ..sizing.charge import NOISE
from ..sizing.diffusion import SLIVER
from ..sizing.field import EQUILATERAL
from ..sizing.smoothing import SOLVER_TOLERANCE
from .figure_labels import colour_indices, neighbour_pairs
from .figure_view import GlobeMap, View, view_of

N_COLOURS = 8
"""Colours of transition regions; two greys for uniform zones and white for outside follow."""

LEAST_REACH = 2.0
"""The charge is averaged over as many local sizes at least: less shows the triangles."""

WINDOW_SIZES = 5
"""Width in local sizes of a region whose charge has the stated noise."""


@dataclass(frozen=True, eq=False)
class Scene:
    """What a figure of a plan draws."""

    plan: Plan
    """The plan."""
    view: View
    """Where its mesh is drawn."""
    h: Floats
    """Size at each point, (n_points,), in the unit of the view."""
    colour: Ints
    """Colour of each region, (n_regions,), below N_COLOURS + 2."""
    fronts: Floats
    """Block fronts inside regions, (n, 2, 2), plot coordinates; the first and the last are borders."""
    borders: Floats
    """Borders of regions inside the domain, (n, 2, 2), plot coordinates."""
    outline: Floats
    """Boundary of what is seen, (n, 2, 2), plot coordinates."""
    charge_density: Floats
    """Smoothed charge in each block's area, (n_points,), in units of iota."""
    charge_noise: float
    """What of that is noise."""


def scene_of(plan: Plan, projection: GlobeMap | None) -> Scene:
    """Return the scene of a plan."""
    size, mesh = plan.regions.size, plan.regions.size.mesh
    view = view_of(mesh, projection)
    is_shown = np.zeros(mesh.n_triangles, dtype=bool)
    is_shown[view.shown] = True
    first, second = mesh.topology.edge_cells.T
    is_rim = second < 0
    label = plan.regions.label
    is_border = ~is_rim & (label[first] != label[second])
    n_shown = is_shown[first].astype(int) + (~is_rim & is_shown[second])
    ends = view.placed[mesh.topology.edges]
    density, noise = charge_density(plan)
    return Scene(
        plan=plan,
        view=view,
        h=size.h / (view.scale * view.size_factor),
        colour=_colours(plan),
        fronts=view.place(_fronts(plan, view.shown)),
        borders=ends[is_border & (n_shown == 2)],
        outline=ends[n_shown == 1],
        charge_density=density,
        charge_noise=noise,
    )


def charge_density(plan: Plan) -> tuple[Floats, float]:
    """Return the irregularity charge in the area of a block at each point, (n_points,), and its noise floor.

    Averaged over half the edge of a block, in the metric of the size: (M + reach^2 K) u = charge with M
    weighted by h^-2, so the charge is kept. A window five sizes wide has the noise of `sizing.charge`; the
    average is over 4 pi reach^2 sizes squared, and noise grows with the root of the area.
    """
    size, mesh = plan.regions.size, plan.regions.size.mesh
    side = float(np.sqrt(plan.tris_per_block))
    reach = max(side / 2, LEAST_REACH)
    mass = vertex_areas(mesh) / size.h**2
    matrix = stiffness(mesh, reach**2 * np.minimum(mesh.qualities / SLIVER, 1.0)) + diags_array(mass)
    charges, diagonal = vertex_charges(plan.regions), matrix.diagonal()
    inverse = LinearOperator(matrix.shape, matvec=lambda v: v / diagonal, dtype=np.float64)
    density, _ = cg(csr_array(matrix), charges, rtol=SOLVER_TOLERANCE, maxiter=500, M=inverse)
    block, window = EQUILATERAL * side**2, 4 * np.pi * reach**2
    return np.asarray(block * density), float(NOISE * block / np.sqrt(window * WINDOW_SIZES**2))


def _colours(plan: Plan) -> Ints:
    regions = plan.regions
    pairs = neighbour_pairs(regions.size.mesh, regions.label)
    is_zone = np.array([region.kind == UNIFORM for region in regions])
    order = [int(k) for k in np.argsort([-region.n_triangles for region in regions], kind="stable")]
    same_kind = is_zone[pairs[:, 0]] == is_zone[pairs[:, 1]] if len(pairs) else np.empty(0, dtype=bool)
    own = pairs[same_kind]
    bright, grey = colour_indices(own, order, N_COLOURS), colour_indices(own, order, 2)
    return np.where(is_zone, N_COLOURS + grey, bright)


def _fronts(plan: Plan, shown: Ints) -> Floats:
    levels = {
        k: front_levels(part.region.profile, part.chosen.pattern.n_fronts)[1:-1]
        for k, part in enumerate(plan.region_plans)
        if part.chosen is not None
    }
    return front_lines(plan.regions, levels, shown)[0]
