"""Who is beside whom: edges, fans, components and boundary loops of triangles or quads.

Produces a `Topology` from cells alone (no coordinates). Invariants: every edge is stored once with its
smaller vertex first, edges are sorted, and each lies in one cell (boundary) or two (interior).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Bools, Ints, Wholes, by_row, joined, short_type
from ..errors import InvalidMesh
from .components import connected_labels
from .fans import corner_fans, next_corner


@dataclass(frozen=True, eq=False)
class Topology:
    """Edges of a mesh of cells with three or four corners, and what follows from them."""

    cells: Ints
    """Corner indices, (n_cells, 3) or (n_cells, 4)."""
    n_points: int
    """Number of vertices; every index in cells is smaller."""
    edges: Ints
    """End points of each edge, (n_edges, 2), smaller index first, sorted."""
    cell_edges: Ints
    """Edge from corner i to corner i + 1 of each cell, (n_cells, n_corners)."""
    edge_sides: Ints
    """The one or two sides of cells along each edge, (n_edges, 2): side i of cell c, from its corner i to
    i + 1, is n_corners c + i; -1 where there is no second."""

    @cached_property
    def edge_cells(self) -> Ints:
        """The one or two cells of each edge, (n_edges, 2); -1 where there is no second."""
        return self.edge_sides // self.cells.shape[1]

    @cached_property
    def is_boundary_edge(self) -> Bools:
        """Edges with one cell only, (n_edges,)."""
        return self.edge_cells[:, 1] < 0

    @cached_property
    def valence(self) -> Ints:
        """Number of edges at each vertex, (n_points,)."""
        return np.bincount(self.edges.ravel(), minlength=self.n_points)

    @cached_property
    def n_cells_at(self) -> Ints:
        """Number of cells at each vertex, (n_points,)."""
        return np.bincount(self.cells.ravel(), minlength=self.n_points)

    @cached_property
    def is_boundary(self) -> Bools:
        """Vertices on a boundary edge, (n_points,)."""
        mask = np.zeros(self.n_points, dtype=bool)
        mask[self.edges[self.is_boundary_edge]] = True
        return mask

    @property
    def inner_edges(self) -> Ints:
        """Edges with two cells, (n_interior_edges,)."""
        return np.flatnonzero(~self.is_boundary_edge)

    @property
    def inner_sides(self) -> Ints:
        """Both sides along each interior edge, (n_interior_edges, 2)."""
        return self.edge_sides.take(self.inner_edges, axis=0)

    @property
    def outer_sides(self) -> Ints:
        """The side along each boundary edge, (n_boundary_edges,)."""
        return self.edge_sides[self.is_boundary_edge, 0]

    @property
    def outline(self) -> Ints:
        """Boundary edges from vertex to vertex as their cells run, (n_boundary_edges, 2)."""
        start = self.outer_sides
        return self.cells.ravel()[np.column_stack([start, next_corner(start, self.cells.shape[1])])]

    @cached_property
    def neighbours(self) -> Ints:
        """Pairs of cells that share an edge, (n_interior_edges, 2)."""
        return self.edge_cells.take(self.inner_edges, axis=0)

    @cached_property
    def runs_alike(self) -> Bools:
        """Interior edges whose two cells run along them the same way, (n_interior_edges,).

        In a mesh of the plane, all counter-clockwise, both lie on one side of it: the mesh is folded there.
        """
        first, second = self.cells.ravel()[self.inner_sides].T
        return np.asarray(first == second)

    @cached_property
    def tips(self) -> Ints:
        """The vertices opposite each interior edge, in both of its triangles, (n_interior_edges, 2)."""
        return np.roll(self.cells, 1, axis=1).ravel()[self.inner_sides]  # of the corner before the side

    @cached_property
    def across(self) -> Ints:
        """Cell across each edge of each cell, (n_cells, n_corners); -1 where there is none."""
        return self._across(self.neighbours).reshape(self.cells.shape)

    @property
    def sides_across(self) -> Ints:
        """The other side along each side of each cell, (n_cells * n_corners,); -1 at the boundary."""
        return self._across(self.inner_sides)

    def _across(self, pairs: Ints) -> Ints:
        """Return what lies on the other side of each side, (n_cells * n_corners,); -1 at the boundary.

        pairs are those of the two sides of each interior edge, (n_interior_edges, 2).
        """
        result = np.full(self.cells.size, -1, dtype=np.int64)
        result[self.inner_sides] = pairs[:, ::-1]
        return result

    @cached_property
    def links(self) -> tuple[Wholes, Wholes, Wholes]:
        """The vertices linked to each by an edge, these edges, and where those of each begin."""
        low, high = self.edges.T
        edges: Wholes = np.tile(np.arange(len(low), dtype=short_type(self.edges.size)), 2)
        rows, columns = joined([high, low], self.n_points), joined([low, high], self.n_points)
        return by_row(rows, columns, edges, self.n_points)

    @cached_property
    def cells_around(self) -> tuple[Wholes, Wholes]:
        """The cells at each vertex, one after the other, and where those of each begin, (n_points + 1,)."""
        cells = np.repeat(np.arange(len(self.cells)), self.cells.shape[1])
        nothing = np.empty(len(cells), dtype=np.int8)
        around, _, start = by_row(self.cells.ravel(), cells, nothing, self.n_points)
        return around, start

    @cached_property
    def component(self) -> Ints:
        """Edge-connected component of each cell, (n_cells,), numbered from 0."""
        return connected_labels(self.neighbours, len(self.cells))

    @cached_property
    def n_components(self) -> int:
        """Number of edge-connected components."""
        return int(self.component.max()) + 1 if len(self.cells) else 0

    @cached_property
    def corner_fan(self) -> Ints:
        """Edge-connected fan of each corner of each cell, (n_cells, n_corners), numbered from 0.

        Splitting each vertex into its fans removes every pinch.
        """
        return corner_fans(self)

    @cached_property
    def n_pinches(self) -> int:
        """Sum over vertices of (edge-connected fans - 1)."""
        used = np.count_nonzero(self.n_cells_at)
        return int(self.corner_fan.max()) + 1 - int(used) if len(self.cells) else 0

    @cached_property
    def euler_characteristic(self) -> int:
        """V - E + F of the mesh as read, pinches not split."""
        return int(np.count_nonzero(self.n_cells_at)) - len(self.edges) + len(self.cells)

    @cached_property
    def edge_loop(self) -> Ints:
        """Boundary loop of each boundary edge after splitting the pinches, (n_boundary_edges,)."""
        fans = self.boundary_fans
        loop = connected_labels(fans, int(self.corner_fan.max()) + 1) if len(fans) else np.empty(0, np.int64)
        if not len(fans):
            return loop
        return np.unique(loop[fans[:, 0]], return_inverse=True)[1].astype(np.int64)

    @cached_property
    def boundary_fans(self) -> Ints:
        """The fans at both ends of each boundary edge, (n_boundary_edges, 2)."""
        start, fan = self.outer_sides, self.corner_fan.ravel()
        return fan[np.column_stack([start, next_corner(start, self.cells.shape[1])])]

    @cached_property
    def n_boundary_loops(self) -> int:
        """Number of closed boundary curves after splitting the pinches."""
        return int(self.edge_loop.max()) + 1 if self.edge_loop.size else 0


def topology(cells: Ints, n_points: int) -> Topology:
    """Return the edges of cells, (n_cells, 3 or 4).

    Raises InvalidMesh when an edge lies in more than two cells, naming the first few.

    >>> topology(np.array([[0, 1, 2], [1, 3, 2]]), 4).edges.tolist()
    [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]
    """
    order, low, high = _by_ends(cells, n_points)
    is_new = np.ones(len(order), dtype=bool)
    is_new[1:] = (low[1:] != low[:-1]) | (high[1:] != high[:-1])
    first = np.flatnonzero(is_new)
    count = np.diff(first, append=len(order))
    edges = np.empty((len(first), 2), dtype=np.int64)
    edges[:, 0], edges[:, 1] = low[first], high[first]
    del low, high  # of large meshes every array counts here
    if len(count) and count.max() > 2:
        raise InvalidMesh(_non_manifold(edges, count))
    cell_edges = np.empty(len(order), dtype=np.int64)
    cell_edges[order] = np.cumsum(is_new, dtype=order.dtype) - 1
    edge_sides = np.empty((len(edges), 2), dtype=np.int64)
    edge_sides[:, 0] = order[first]
    edge_sides[:, 1] = np.where(count == 2, order[np.minimum(first + 1, len(order) - 1)], -1)
    return Topology(cells, n_points, edges, cell_edges.reshape(cells.shape), edge_sides)


def _by_ends(cells: Ints, n_points: int) -> tuple[Wholes, Wholes, Wholes]:
    """Return the sides of all cells by their smaller end, then their larger, then the cell, and these ends.

    (n_cells * n_corners,) each; short integers where the mesh allows.
    """
    start = cells.astype(short_type(max(cells.size, n_points)))
    end = np.roll(start, -1, axis=1)
    low, high = np.minimum(start, end).ravel(), np.maximum(start, end).ravel()
    del start, end
    order = _sorted_places(high, n_points)
    order = order[_sorted_places(low[order], n_points)]
    return order, low[order], high[order]


def _sorted_places(values: Wholes, n: int) -> Wholes:
    """Return the stable order of integers 0 .. n - 1; linear in time."""
    place = np.arange(len(values), dtype=values.dtype)
    return by_row(values, place, np.empty(len(values), dtype=np.int8), n)[0]


def _non_manifold(edges: Ints, count: Ints) -> str:
    bad = np.flatnonzero(count > 2)
    named = ", ".join(
        f"({a}, {b}) in {n} cells" for (a, b), n in zip(edges[bad[:3]], count[bad[:3]], strict=True)
    )
    return f"{len(bad)} non-manifold edges, the first between points {named}; an edge has two cells at most"
