"""The noun Domain: where a layout lives. The input's triangulation, pinches split, and its curves.

Curves are what no block may cross: the boundary loops, cut where they meet an interface, and the interfaces
inside. Coordinates are shifted and scaled so that the domain is about 1 across. Invariants: every boundary
side lies on exactly one curve, the domain on its left; a curve runs from junction to junction or is closed.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Bools, Floats, Ints, sums_by
from ..errors import InvalidMesh
from ..mesh import Mesh
from ..mesh.quality import angles
from ..mesh.topology import topology
from ..sizing.limits import Links
from .curves import Curves, find_curves


@dataclass(frozen=True, eq=False)
class Domain:
    """A triangulated domain of the plane with its curves, in coordinates of its own."""

    mesh: Mesh
    """The triangulation in the coordinates of the input, one point a fan, so that no boundary touches itself:
    the input itself where nothing was split or left out."""
    side_codes: Ints
    """Curve of the side opposite each corner, (n_triangles, 3): 2 c along it, 2 c + 1 against, -1 none."""
    lines: Curves
    """The curves as sequences of points."""
    source: Ints
    """Point of the mesh that each point is, (n_points,)."""
    is_kept: Bools
    """Points that a layout must have as a vertex, (n_points,), junctions aside."""
    origin: Floats
    """Coordinates of the mesh are origin + scale * points, (2,), length."""
    scale: float
    """Length of one unit of `points`."""

    @property
    def n_points(self) -> int:
        """Number of points."""
        return self.mesh.n_points

    @cached_property
    def points(self) -> Floats:
        """Coordinates, (n_points, 2), about 1 across."""
        return (self.mesh.points - self.origin) / self.scale

    @cached_property
    def triangles(self) -> Ints:
        """Three corners, counter-clockwise, and the neighbours opposite them (-1 none), (n_triangles, 6)."""
        return np.column_stack([self.mesh.triangles, np.roll(self.mesh.topology.across, -1, axis=1)])

    @cached_property
    def links(self) -> Links:
        """The links of the triangulation, over which edge lengths are limited."""
        return Links.of(self.mesh)

    @cached_property
    def areas(self) -> Floats:
        """Area of each triangle, (n_triangles,), in the domain's own unit squared."""
        return self.mesh.areas / self.scale**2

    @cached_property
    def boundary_angle(self) -> Floats:
        """Sum of the triangles' angles at each point, (n_points,), radians."""
        return sums_by(self.mesh.triangles, angles(self.mesh.corner_edge_lengths), self.n_points)

    @cached_property
    def curves(self) -> Ints:
        """First and one past the last row of `curve_points`, 1 if closed, 1 if inside, (n_curves, 4)."""
        lines = self.lines
        return np.column_stack([lines.first[:-1], lines.first[1:], lines.is_closed, lines.is_inside])

    @property
    def curve_nodes(self) -> Ints:
        """Point of the domain at each row of the curves; closed curves repeat their first, (k,)."""
        return self.lines.nodes

    @cached_property
    def curve_points(self) -> Floats:
        """Coordinates and arc length along the curve at each row, (k, 3)."""
        xy = self.points[self.lines.nodes]
        step = np.zeros(len(xy))
        step[1:] = np.linalg.norm(xy[1:] - xy[:-1], axis=1)
        step[self.lines.first[:-1]] = 0.0
        total = np.cumsum(step)
        start = np.repeat(total[self.lines.first[:-1]], np.diff(self.lines.first))
        return np.column_stack([xy, total - start])

    @cached_property
    def curve_triangles(self) -> Ints:
        """A triangle of the domain at each row of the curves, (k,)."""
        at = np.empty(self.n_points, dtype=np.int64)
        at[self.mesh.triangles.ravel()] = np.repeat(np.arange(self.mesh.n_triangles), 3)
        return at[self.lines.nodes]

    @cached_property
    def curve_lengths(self) -> Floats:
        """Length of each curve, (n_curves,)."""
        return self.curve_points[self.lines.first[1:] - 1, 2]

    @cached_property
    def curve_of_point(self) -> Ints:
        """Curve that each point lies on, (n_points,); -1 inside, one of several at a junction."""
        result = np.full(self.n_points, -1, dtype=np.int64)
        result[self.lines.nodes] = np.repeat(np.arange(len(self.curve_lengths)), np.diff(self.lines.first))
        return result

    @cached_property
    def arc_of_point(self) -> Floats:
        """Arc length of each point on its curve, (n_points,); 0 where there is none."""
        result = np.zeros(self.n_points)
        rows = np.arange(len(self.lines.nodes))[::-1]  # so that the first row of a closed curve wins
        result[self.lines.nodes[rows]] = self.curve_points[rows, 2]
        return result

    @property
    def is_boundary(self) -> Bools:
        """Points on the boundary of the domain, (n_points,)."""
        return self.mesh.topology.is_boundary

    @property
    def outline(self) -> Ints:
        """Boundary edges from point to point, the domain on their left, (n_boundary_edges, 2)."""
        return self.mesh.topology.outline

    def to_mesh(self, points: Floats) -> Floats:
        """Return coordinates of the mesh of points in the domain's own, (n, 2), length."""
        return self.origin + self.scale * points


def domain_of(mesh: Mesh, *, interfaces: Bools | None = None, kept: Ints | None = None) -> Domain:
    """Return the domain of a planar mesh.

    interfaces marks interior edges of `mesh.topology` that no block may cross, (n_edges,); kept lists
    points that must stay. Raises InvalidMesh for a surface in space and for triangles folded over others.
    """
    if not mesh.is_planar:
        raise InvalidMesh(
            "the mesh is a surface in space, blocks are laid out in the plane; "
            "project it (--lonlat for degrees)"
        )
    carrier, source, cells = _split(mesh)
    low, high = np.array([[axis.min(), axis.max()] for axis in mesh.points.T]).T
    is_line = carrier.topology.is_boundary_edge.copy()
    if interfaces is not None:
        is_line[carrier.topology.cell_edges] |= interfaces[mesh.topology.cell_edges[cells]]
    lines, codes = find_curves(carrier.topology, is_line)
    is_kept = np.zeros(len(source), dtype=bool)
    if kept is not None:
        is_kept[np.isin(source, kept)] = True
    return Domain(carrier, codes, lines, source, is_kept, (low + high) / 2, float((high - low).max()))


def _split(mesh: Mesh) -> tuple[Mesh, Ints, Ints]:
    """Return a mesh with pinches split and folds left out, and where its points and triangles are from.

    The mesh itself where it has neither.
    """
    cells = unfolded(mesh)
    if len(cells) == mesh.n_triangles and not mesh.topology.n_pinches:
        return mesh, np.arange(mesh.n_points), cells
    triangles = mesh.triangles[cells]
    fan = topology(triangles, mesh.n_points).corner_fan
    source = np.empty(int(fan.max()) + 1, dtype=np.int64)
    source[fan] = triangles
    return Mesh(mesh.points[source], fan), source, cells


def unfolded(mesh: Mesh) -> Ints:
    """Return the triangles of a mesh without those at its boundary that are folded over their neighbours.

    A sliver whose tip lies beyond the boundary, by rounding or by projection, lies on top of the triangles
    beside it: both run along their common edge the same way. Raises InvalidMesh where it is no sliver of
    the boundary.
    """
    if not mesh.topology.runs_alike.any():
        return np.arange(mesh.n_triangles)
    edge, is_inner = mesh.topology.cell_edges, ~mesh.topology.is_boundary_edge
    is_clash = np.zeros(len(is_inner), dtype=bool)
    is_clash[is_inner] = mesh.topology.runs_alike
    n_inner, n_clashes = is_inner[edge].sum(axis=1), is_clash[edge].sum(axis=1)
    is_folded = (n_clashes > 0) & (n_clashes == n_inner) & (n_inner < 3)
    beside = mesh.topology.edge_cells[is_clash]
    is_left = ~is_folded[beside].any(axis=1)
    if is_left.any() or is_folded.all():
        first, second = beside[np.argmax(is_left)]
        raise InvalidMesh(
            f"triangles {first} and {second} lie on the same side of their common edge: the mesh is folded; "
            "mend it there"
        )
    return np.flatnonzero(~is_folded)
