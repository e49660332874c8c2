"""The mesh: points and triangles, checked once, everything else derived on first access."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

from ..arrays import Floats, Ints, frozen_floats, frozen_ints
from . import quality
from .check import check_mesh
from .irregularity import Irregularity, mesh_irregularity, vertex_irregularity
from .topology import Topology, topology


@dataclass(frozen=True, eq=False)
class Mesh:
    """A conforming triangle mesh of a planar domain or of a surface.

    Raises InvalidMesh when an index is out of range, a point is unused or not finite, a triangle is
    degenerate or (in the plane) clockwise, or an edge lies in more than two triangles.
    `check.clean` makes one from raw arrays.
    """

    points: Floats
    """Vertex coordinates, (n_points, 2) or (n_points, 3), in the length unit of the file."""
    triangles: Ints
    """Corner indices, (n_triangles, 3), counter-clockwise."""
    areas: Floats = field(init=False, repr=False)
    """Area of each triangle, (n_triangles,), length**2."""
    corner_edge_lengths: Floats = field(init=False, repr=False)
    """Length of the edge opposite each corner, (n_triangles, 3), length."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen_floats(self.points))
        object.__setattr__(self, "triangles", frozen_ints(self.triangles))
        areas, opposite = check_mesh(self.points, self.triangles)
        object.__setattr__(self, "areas", areas)
        object.__setattr__(self, "corner_edge_lengths", opposite)
        _ = self.topology  # refuses non-manifold edges

    @property
    def n_points(self) -> int:
        """Number of vertices."""
        return len(self.points)

    @property
    def n_triangles(self) -> int:
        """Number of triangles."""
        return len(self.triangles)

    @property
    def is_planar(self) -> bool:
        """True where points have two coordinates."""
        return self.points.shape[1] == 2

    @cached_property
    def topology(self) -> Topology:
        """Edges, components, fans and boundary loops."""
        return topology(self.triangles, self.n_points)

    @cached_property
    def area(self) -> float:
        """Area of the whole mesh, length**2."""
        return float(self.areas.sum())

    @cached_property
    def edge_lengths(self) -> Floats:
        """Length of each edge of the topology, (n_edges,), length."""
        start, end = self.topology.edges.T
        return quality.lengths(self.points.take(end, axis=0) - self.points.take(start, axis=0))

    @cached_property
    def qualities(self) -> Floats:
        """Mean ratio of each triangle, (n_triangles,)."""
        return quality.mean_ratio(self.areas, self.corner_edge_lengths)

    @cached_property
    def centroids(self) -> Floats:
        """Centroid of each triangle, (n_triangles, 2 or 3), length."""
        a, b, c = (self.points.take(corner, axis=0) for corner in self.triangles.T)
        return (a + b + c) / 3

    @cached_property
    def vertex_irregularity(self) -> Ints:
        """Valence minus optimal valence, (n_points,)."""
        return vertex_irregularity(self.topology)

    @cached_property
    def irregularity(self) -> Irregularity:
        """Positive and negative mesh irregularity, checked against the Euler characteristic."""
        return mesh_irregularity(self.topology)

    @property
    def bounds(self) -> tuple[float, ...]:
        """Smallest and largest coordinate of each axis: x0, x1, y0, y1 (, z0, z1), length."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        return tuple(float(v) for pair in zip(low, high, strict=True) for v in pair)

    def __repr__(self) -> str:
        where = "plane" if self.is_planar else "space"
        return f"Mesh({self.n_triangles} triangles, {self.n_points} points in the {where})"
