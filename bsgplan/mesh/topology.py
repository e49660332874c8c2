"""Who is beside whom: edges, fans, components and boundary loops of triangles or quads.

Produces a `Topology` from cells alone (no coordinates). Invariants: every edge is stored once with its
smaller vertex first, edges are sorted, and each lies in one cell (boundary) or two (interior).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Bools, Ints, grouped
from ..errors import InvalidMesh

Small: TypeAlias = NDArray[np.int32 | np.int64]


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
    edge_cells: Ints
    """The one or two cells of each edge, (n_edges, 2); -1 where there is no second."""

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

    @cached_property
    def neighbours(self) -> Ints:
        """Pairs of cells that share an edge, (n_interior_edges, 2)."""
        return self.edge_cells[np.flatnonzero(~self.is_boundary_edge)]

    @cached_property
    def across(self) -> Ints:
        """Cell across each edge of each cell, (n_cells, n_corners); -1 where there is none."""
        first, second = self.edge_cells.T
        own = np.arange(len(self.cells))
        columns = [np.where(first[e] == own, second[e], first[e]) for e in self.cell_edges.T]
        return np.column_stack(columns)

    @cached_property
    def cells_around(self) -> tuple[Ints, Ints]:
        """The cells at each vertex, one after the other, and where those of each begin, (n_points + 1,)."""
        order, start = grouped(self.cells, self.n_points)
        return order // self.cells.shape[1], start

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
        n_corners = self.cells.shape[1]
        inner = np.flatnonzero(~self.is_boundary_edge)
        sides = np.full((len(self.edges), 2), -1, dtype=np.int64)
        flat = self.cell_edges.ravel()
        cell = np.repeat(np.arange(len(self.cells)), n_corners)
        is_first = self.edge_cells[flat, 0] == cell
        sides[flat[is_first], 0] = np.flatnonzero(is_first)
        sides[flat[~is_first], 1] = np.flatnonzero(~is_first)
        first, second = sides[inner].T
        first_next, second_next = _next_corner(first, n_corners), _next_corner(second, n_corners)
        vertex = self.cells.ravel()
        is_same = vertex[first] == vertex[second]  # neighbours that run along the edge the same way
        links = np.concatenate(
            [
                np.column_stack([first, np.where(is_same, second, second_next)]),
                np.column_stack([first_next, np.where(is_same, second_next, second)]),
            ]
        )
        return connected_labels(links, vertex.size).reshape(self.cells.shape)

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
        n_corners = self.cells.shape[1]
        position = np.flatnonzero(self.is_boundary_edge[self.cell_edges.ravel()])
        order = np.argsort(self.cell_edges.ravel()[position], kind="stable")
        position = position[order]
        fan = self.corner_fan.ravel()
        return np.column_stack([fan[position], fan[_next_corner(position, n_corners)]])

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
    n_corners = cells.shape[1]
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
    cell_of_rank = order // n_corners
    edge_cells = np.full((len(edges), 2), -1, dtype=np.int64)
    edge_cells[:, 0] = cell_of_rank[first]
    is_inner = count == 2
    edge_cells[is_inner, 1] = cell_of_rank[first[is_inner] + 1]
    return Topology(cells, n_points, edges, cell_edges.reshape(cells.shape), edge_cells)


def _by_ends(cells: Ints, n_points: int) -> tuple[Small, Small, Small]:
    """Return the sides of all cells by their smaller end, then their larger, then the cell, and these ends.

    (n_cells * n_corners,) each; short integers where the mesh allows.
    """
    small = np.int32 if max(cells.size, n_points) < np.iinfo(np.int32).max else np.int64
    start = cells.astype(small)
    end = np.roll(start, -1, axis=1)
    low, high = np.minimum(start, end).ravel(), np.maximum(start, end).ravel()
    del start, end
    order = _sorted_places(high, n_points)
    order = order[_sorted_places(low[order], n_points)]
    return order, low[order], high[order]


def _sorted_places(values: Small, n: int) -> Small:
    """Return the stable order of integers 0 .. n - 1; linear in time."""
    place = np.arange(len(values), dtype=values.dtype)
    ones = np.ones(len(values), dtype=np.int8)
    return np.asarray(coo_array((ones, (values, place)), shape=(n, len(values))).tocsr().indices)


def connected_labels(links: Ints, n_nodes: int) -> Ints:
    """Return the component of each node of a graph, (n_nodes,), from 0, numbered by their first nodes."""
    graph = coo_array(
        (np.ones(len(links), dtype=np.int8), (links[:, 0], links[:, 1])), shape=(n_nodes, n_nodes)
    )
    return connected_components(graph, directed=False)[1].astype(np.int64)


def _non_manifold(edges: Ints, count: Ints) -> str:
    bad = np.flatnonzero(count > 2)
    named = ", ".join(
        f"({a}, {b}) in {n} cells" for (a, b), n in zip(edges[bad[:3]], count[bad[:3]], strict=True)
    )
    return f"{len(bad)} non-manifold edges, the first between points {named}; an edge has two cells at most"


def _next_corner(corner: Ints, n_corners: int) -> Ints:
    return corner - corner % n_corners + (corner % n_corners + 1) % n_corners
