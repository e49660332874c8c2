"""The fans of a vertex: its cells that hang together by edges. A vertex of several is a pinch."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Ints
from .components import connected_labels

if TYPE_CHECKING:
    from .topology import Topology


def corner_fans(topology: Topology) -> Ints:
    """Return the edge-connected fan of each corner of each cell, (n_cells, n_corners), numbered from 0."""
    n_corners, vertex = topology.cells.shape[1], topology.cells.ravel()
    is_used = topology.n_cells_at > 0
    fan = (np.cumsum(is_used) - 1)[vertex]
    across = topology.sides_across
    corners = np.flatnonzero((_n_cells_in_a_fan(topology, across) != topology.n_cells_at)[vertex])
    if len(corners):  # of pinches
        number = np.full(len(vertex), -1)
        number[corners] = np.arange(len(corners))
        links = np.column_stack([np.repeat(corners, 2), _turned(topology.cells, corners, across).ravel()])
        own = connected_labels(number[links[links[:, 1] >= 0]], len(corners))
        first = np.unique(own, return_index=True)[1]  # a corner of each fan ..
        is_other = np.ones(len(first), dtype=bool)
        is_other[np.unique(vertex[corners[first]], return_index=True)[1]] = False  # .. and of a vertex
        further = np.count_nonzero(is_used) - 1 + np.cumsum(is_other)
        fan[corners] = np.where(is_other, further, fan[corners[first]])[own]
    return fan.reshape(-1, n_corners)


def _n_cells_in_a_fan(topology: Topology, across: Ints) -> Ints:
    """Return the cells in one fan of each vertex, (n_points,); 0 where there is none or sides run alike.

    across is the other side of each side. Turns around all vertices at once, from the first corner of an
    open fan, from any of a closed one.
    """
    cells, vertex = topology.cells, topology.cells.ravel()
    after = np.roll(np.arange(cells.size).reshape(cells.shape), -1, axis=1).ravel()
    ahead = np.where(across >= 0, after[across], -1)
    start = np.full(topology.n_points, -1)
    start[vertex] = np.arange(len(vertex))
    open_ends = after[across < 0]
    start[vertex[open_ends]] = open_ends
    start[topology.edges[topology.inner_edges[topology.runs_alike]]] = -1
    result = np.zeros(topology.n_points, dtype=np.int64)
    turning = np.flatnonzero(start >= 0)
    first = corner = start[turning]
    while len(turning):
        result[turning] += 1
        corner = ahead[corner]
        goes_on = np.flatnonzero((corner >= 0) & (corner != first))
        turning, first, corner = turning.take(goes_on), first.take(goes_on), corner.take(goes_on)
    return result


def _turned(cells: Ints, corner: Ints, across: Ints) -> Ints:
    """Return the corners of the same vertex across the two sides at each corner, (n, 2); -1 for none."""
    n_corners, vertex = cells.shape[1], cells.ravel()
    result = np.empty((len(corner), 2), dtype=np.int64)
    before = corner + np.where(corner % n_corners == 0, n_corners - 1, -1)
    for k, side in enumerate((corner, before)):
        other = across[side]
        is_start = vertex[other] == vertex[corner]  # else the vertex is the end of the side
        there = np.where(is_start, other, next_corner(other, n_corners))
        result[:, k] = np.where(other >= 0, there, -1)
    return result


def next_corner(corner: Ints, n_corners: int) -> Ints:
    """Return the corner after each in its cell, (n,); corner i of cell c is n_corners c + i.

    >>> next_corner(np.array([0, 1, 2, 3]), 3).tolist()
    [1, 2, 0, 4]
    """
    is_last = corner - n_corners * (corner // n_corners) == n_corners - 1
    return corner + np.where(is_last, 1 - n_corners, 1)
