"""The noun Cut: the part of a mesh that is to be replaced, as a domain whose boundary is frozen.

Invariants: every side between the part and the rest, every side on the mesh's own boundary and every fixed
edge inside is frozen with both its ends, so that whatever is made of the part fits where it was.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Bools, Floats, Ints, sums_by
from ..blocks.corners import SHARP
from ..blocks.domain import Domain, domain_of, unfolded
from ..blocks.kinds import FROZEN, FROZEN_SIDE
from ..blocks.placed import PlacedMesh, place
from ..mesh import Mesh
from ..mesh.edges import edge_numbers
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
    mesh: Mesh,
    is_inside: Bools,
    *,
    fixed_edges: Bools | None = None,
    fixed_points: Ints | None = None,
    free_edges: Bools | None = None,
) -> Cut:
    """Return a part of a planar mesh, frozen where it meets the rest and at the mesh's boundary.

    fixed_edges marks edges of the mesh that stay, (n_edges,); fixed_points lists points that do. The goal of
    a frozen vertex is what makes it regular in the whole mesh. free_edges marks boundary edges whose points
    slide along the boundary, come and go, (n_edges,), but where it turns by more than SHARP. Raises
    InvalidMesh for a surface in space.
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
    return Cut(mesh, is_inside, domain, _frozen(mesh, domain, point, free_edges), point, own)


def fitting_valence(mesh: Mesh) -> Floats:
    """Return the edges that make each vertex regular, (n_points,): 6 inside, by its angle on the boundary."""
    angle = sums_by(mesh.triangles, angles(mesh.corner_edge_lengths), mesh.n_points)
    fitting = np.maximum(1.0, np.rint(angle / (np.pi / 3)))
    n_fans = mesh.topology.valence - mesh.topology.n_cells_at  # a boundary vertex has one edge more a fan
    return np.where(mesh.topology.is_boundary, fitting + n_fans, 6.0)


def _frozen(mesh: Mesh, domain: Domain, point: Ints, free_edges: Bools | None) -> PlacedMesh:
    start = place(domain, domain.is_kept, np.zeros(domain.n_points))
    is_fixed = (domain.curve_of_point >= 0) | domain.lines.is_junction | domain.is_kept
    is_free = np.zeros_like(start.codes, dtype=bool)
    if free_edges is not None:
        is_free, slides = _free(mesh, domain, point, start, free_edges)
        is_fixed &= ~slides
    elsewhere = mesh.topology.valence[point] - start.topology.valence
    return replace(
        start,
        codes=np.where((start.codes >= 0) & ~is_free, FROZEN_SIDE, start.codes),
        kinds=np.where(is_fixed, FROZEN, start.kinds),
        curves=np.where(is_fixed, -1, start.curves),
        goals=np.where(is_fixed, fitting_valence(mesh)[point] - elsewhere, start.goals),
    )


def _free(
    mesh: Mesh, domain: Domain, point: Ints, start: PlacedMesh, free_edges: Bools
) -> tuple[Bools, Bools]:
    """Return the sides that may be split and the points that may slide, (n_triangles, 3) and (n_points,)."""
    corners = domain.triangles[:, :3]
    ends = np.stack([np.roll(corners, -1, axis=1), np.roll(corners, -2, axis=1)], axis=-1)
    edge = edge_numbers(mesh, point[ends].reshape(-1, 2)).reshape(corners.shape)
    is_junction = domain.lines.is_junction
    is_line = start.codes >= 0
    is_free = is_line & (edge >= 0) & free_edges[edge] & mesh.topology.is_boundary_edge[edge]
    is_free &= ~is_junction[ends].any(axis=2)
    n_free, n_lines = (
        np.bincount(ends[sides].ravel(), minlength=domain.n_points) for sides in (is_free, is_line)
    )
    is_corner = np.abs(np.pi - domain.boundary_angle) > SHARP
    return is_free, (n_free == 2) & (n_lines == 2) & ~is_corner & ~is_junction & ~domain.is_kept
