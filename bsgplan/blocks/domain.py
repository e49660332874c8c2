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
from ..mesh.quality import angles, corner_edge_lengths
from ..mesh.topology import topology
from .curves import Curves, find_curves


@dataclass(frozen=True, eq=False)
class Domain:
    """A triangulated domain of the plane with its curves, in coordinates of its own."""

    points: Floats
    """Coordinates, (n_points, 2), about 1 across; one point a fan, so that no boundary touches itself."""
    triangles: Ints
    """Three corners, counter-clockwise, and the neighbours opposite them (-1 none), (n_triangles, 6)."""
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
        return len(self.points)

    @cached_property
    def mesh(self) -> Mesh:
        """The triangulation as a mesh, in the domain's own coordinates."""
        return Mesh(self.points, self.triangles[:, :3])

    @cached_property
    def areas(self) -> Floats:
        """Area of each triangle, (n_triangles,), in the domain's own unit squared."""
        a, b, c = self.points[self.triangles[:, :3]].swapaxes(0, 1)
        u, v = b - a, c - a
        return np.asarray(0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]))

    @cached_property
    def boundary_angle(self) -> Floats:
        """Sum of the triangles' angles at each point, (n_points,), radians."""
        corners = self.triangles[:, :3]
        return sums_by(corners, angles(corner_edge_lengths(self.points, corners)), self.n_points)

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
        at[self.triangles[:, :3].ravel()] = np.repeat(np.arange(len(self.triangles)), 3)
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

    @cached_property
    def is_boundary(self) -> Bools:
        """Points on the boundary of the domain, (n_points,)."""
        result = np.zeros(self.n_points, dtype=bool)
        triangle, side = np.nonzero(self.triangles[:, 3:] < 0)
        for step in (1, 2):
            result[self.triangles[triangle, (side + step) % 3]] = True
        return result

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
    cells = unfolded(mesh)
    is_whole = len(cells) == mesh.n_triangles
    fan = (mesh.topology if is_whole else topology(mesh.triangles[cells], mesh.n_points)).corner_fan
    source = np.empty(int(fan.max()) + 1, dtype=np.int64)
    source[fan] = mesh.triangles[cells]
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    origin, scale = (low + high) / 2, float((high - low).max())
    points = (mesh.points[source] - origin) / scale
    split = topology(fan, len(source))
    across = np.where(
        split.edge_cells[split.cell_edges][..., 0] == np.arange(len(fan))[:, None],
        split.edge_cells[split.cell_edges][..., 1],
        split.edge_cells[split.cell_edges][..., 0],
    )
    opposite = [1, 2, 0]  # the side opposite corner i runs from corner i + 1 to corner i + 2
    is_line = split.is_boundary_edge.copy()
    if interfaces is not None:
        is_line[split.cell_edges] |= interfaces[mesh.topology.cell_edges[cells]]
    side_edges = split.cell_edges[:, opposite]
    lines, codes = find_curves(fan, side_edges, split.edges, is_line, split.is_boundary_edge)
    is_kept = np.zeros(len(source), dtype=bool)
    if kept is not None:
        is_kept[np.isin(source, kept)] = True
    return Domain(
        points, np.column_stack([fan, across[:, opposite]]), codes, lines, source, is_kept, origin, scale
    )


def unfolded(mesh: Mesh) -> Ints:
    """Return the triangles of a mesh without those at its boundary that are folded over their neighbours.

    A sliver whose tip lies beyond the boundary, by rounding or by projection, lies on top of the triangles
    beside it: both run along their common edge the same way. Raises InvalidMesh where it is no sliver of
    the boundary.
    """
    start = mesh.triangles
    is_forward = start < np.roll(start, -1, axis=1)
    edge = mesh.topology.cell_edges
    n_forward = np.bincount(edge[is_forward], minlength=len(mesh.topology.edges))
    is_inner = ~mesh.topology.is_boundary_edge
    is_clash = is_inner & (n_forward != 1)
    if not is_clash.any():
        return np.arange(mesh.n_triangles)
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
