"""The noun PlacedMesh: triangles whose vertices know their place on the curves of a domain."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..mesh.topology import Topology, topology
from .domain import Domain
from .kinds import CORNER, HALF_EDGE, INTERIOR, JUNCTION, SLIDING


@dataclass(frozen=True, eq=False)
class PlacedMesh:
    """A conforming mesh inside a domain, in the domain's own coordinates."""

    points: Floats
    """Coordinates, (n_points, 2)."""
    triangles: Ints
    """Corners, counter-clockwise, (n_triangles, 3)."""
    codes: Ints
    """Curve of the side opposite each corner, (n_triangles, 3): 2 c along it, 2 c + 1 against, -1 none,
    FROZEN_SIDE."""
    kinds: Ints
    """INTERIOR, SLIDING, CORNER, JUNCTION or FROZEN, (n_points,)."""
    curves: Ints
    """Curve of each vertex, (n_points,); -1 inside and at junctions."""
    arcs: Floats
    """Arc length on that curve, (n_points,)."""
    goals: Floats
    """Edges wanted at each vertex, (n_points,): 6 inside, 4 on the boundary, 1 + angle / 60 degrees."""
    hints: Ints
    """A triangle of the domain near each vertex, (n_points,)."""

    @cached_property
    def topology(self) -> Topology:
        """Edges, components and boundary loops."""
        return topology(self.triangles, len(self.points))

    @cached_property
    def neighbours(self) -> Ints:
        """Neighbour opposite each corner, -1 none, (n_triangles, 3)."""
        cells = self.topology.edge_cells[self.topology.cell_edges]
        own = np.arange(len(self.triangles))[:, None]
        return np.asarray(np.where(cells[..., 0] == own, cells[..., 1], cells[..., 0])[:, [1, 2, 0]])

    @cached_property
    def is_irregular(self) -> Bools:
        """Vertices whose valence is off the goal, at fixed ones by more than half an edge, (n_points,)."""
        off = np.abs(self.topology.valence - self.goals)
        return np.asarray(off > np.where(self.kinds >= CORNER, HALF_EDGE, 0.0))


def place(domain: Domain, is_corner: Bools, turning: Floats) -> PlacedMesh:
    """Return the domain's own triangulation as a mesh on it, with the given corners fixed."""
    curve = domain.curve_of_point
    is_junction = domain.lines.is_junction
    kinds = np.where(curve >= 0, SLIDING, INTERIOR)
    kinds[is_corner | (domain.is_kept & (curve < 0))] = CORNER
    kinds[is_junction] = JUNCTION
    goals = np.where(domain.is_boundary, 4.0, 6.0)
    at_corner = is_corner & domain.is_boundary
    goals[at_corner] = 1.0 + np.maximum(np.pi - turning[at_corner], 0.0) / (np.pi / 3)
    at_junction = is_junction & domain.is_boundary
    goals[at_junction] = 1.0 + domain.boundary_angle[at_junction] / (np.pi / 3)
    hints = np.empty(domain.n_points, dtype=np.int64)
    hints[domain.triangles[:, :3].ravel()] = np.repeat(np.arange(len(domain.triangles)), 3)
    return PlacedMesh(
        points=domain.points,
        triangles=domain.triangles[:, :3],
        codes=domain.side_codes,
        kinds=kinds,
        curves=np.where(is_junction, -1, curve),
        arcs=domain.arc_of_point,
        goals=goals,
        hints=hints,
    )


def grown(mesh: PlacedMesh, is_chosen: Bools, n_rings: int) -> Bools:
    """Return the chosen triangles, (n_triangles,), and those within so many rings of them."""
    for _ in range(n_rings):
        is_near = np.zeros(len(mesh.points), dtype=bool)
        is_near[mesh.triangles[is_chosen]] = True
        is_chosen = np.asarray(is_near[mesh.triangles].any(axis=1))
    return is_chosen
