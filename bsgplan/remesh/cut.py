"""The noun Cut: the part of a mesh that is to be replaced, as a domain whose boundary is frozen.

Invariants: every side between the part and the rest, every side on the mesh's own boundary and every fixed
edge inside is frozen with both its ends, so that whatever is made of the part fits where it was.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Bools, Floats, Ints, sums_by
from ..blocks.domain import Domain, domain_of, unfolded
from ..blocks.kinds import FROZEN, FROZEN_SIDE
from ..blocks.placed import PlacedMesh, place
from ..mesh import Mesh
from ..mesh.quality import angles


@dataclass(frozen=True, eq=False)
class Cut:
    """A part of a mesh."""

    mesh: Mesh
    """The whole mesh."""
    is_inside: Bools
    """Triangles of the part, (n_triangles,)."""
    domain: Domain
    """The part as a domain, in coordinates of its own."""
    start: PlacedMesh
    """The part's own triangulation on that domain, what may not change frozen."""
    point: Ints
    """Point of the whole mesh that each point of the domain is, (n_domain_points,)."""
    triangle: Ints
    """Triangle of the whole mesh that each triangle of the domain is, (n_domain_triangles,)."""

    @property
    def is_frozen(self) -> Bools:
        """Points of the domain that stay, (n_domain_points,)."""
        return np.asarray(self.start.kinds == FROZEN)


def cut(
    mesh: Mesh, is_inside: Bools, *, fixed_edges: Bools | None = None, fixed_points: Ints | None = None
) -> Cut:
    """Return a part of a planar mesh, frozen where it meets the rest and at the mesh's boundary.

    fixed_edges marks edges of the mesh that stay, (n_edges,); fixed_points lists points that do. The goal of
    a frozen vertex is what makes it regular in the whole mesh. Raises InvalidMesh for a surface in space.
    """
    triangles = mesh.triangles[is_inside]
    used, local = np.unique(triangles, return_inverse=True)
    part = Mesh(mesh.points[used], local.reshape(-1, 3))
    interfaces = None
    if fixed_edges is not None:
        interfaces = np.zeros(len(part.topology.edges), dtype=bool)
        interfaces[part.topology.cell_edges] = fixed_edges[mesh.topology.cell_edges[is_inside]]
    kept = None if fixed_points is None else np.flatnonzero(np.isin(used, fixed_points))
    domain = domain_of(part, interfaces=interfaces, kept=kept)
    point = used[domain.source]
    own = np.flatnonzero(is_inside)[unfolded(part)]
    return Cut(mesh, is_inside, domain, _frozen(mesh, domain, point), point, own)


def fitting_valence(mesh: Mesh) -> Floats:
    """Return the edges that make each vertex regular, (n_points,): 6 inside, by its angle on the boundary."""
    angle = sums_by(mesh.triangles, angles(mesh.corner_edge_lengths), mesh.n_points)
    fitting = np.maximum(1.0, np.rint(angle / (np.pi / 3)))
    n_fans = mesh.topology.valence - mesh.topology.n_cells_at  # a boundary vertex has one edge more a fan
    return np.where(mesh.topology.is_boundary, fitting + n_fans, 6.0)


def _frozen(mesh: Mesh, domain: Domain, point: Ints) -> PlacedMesh:
    start = place(domain, domain.is_kept, np.zeros(domain.n_points))
    is_fixed = (domain.curve_of_point >= 0) | domain.lines.is_junction | domain.is_kept
    elsewhere = mesh.topology.valence[point] - start.topology.valence
    return replace(
        start,
        codes=np.where(start.codes >= 0, FROZEN_SIDE, start.codes),
        kinds=np.where(is_fixed, FROZEN, start.kinds),
        curves=np.where(is_fixed, -1, start.curves),
        goals=np.where(is_fixed, fitting_valence(mesh)[point] - elsewhere, 6.0),
    )
