"""The curves of a domain as sequences of points: boundary loops and interfaces, cut at their junctions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Ints
from ..mesh.topology import Topology
from .chains import chain


@dataclass(frozen=True, eq=False)
class Curves:
    """Sequences of points, one after the other."""

    nodes: Ints
    """Points of all curves, (k,); a closed curve repeats its first point at its end."""
    first: Ints
    """Row of the first node of each curve and one past the last of all, (n_curves + 1,)."""
    is_closed: Bools
    """Curves without an end, (n_curves,)."""
    is_inside: Bools
    """Interfaces, (n_curves,); the others are boundary and have the domain on their left."""
    is_junction: Bools
    """Points where curves end or meet, (n_points,)."""


def find_curves(topology: Topology, is_line: Bools) -> tuple[Curves, Ints]:
    """Return the curves of the marked edges, and the code of the side opposite each corner, (n_triangles, 3).

    is_line is one value an edge, true at the boundary. A code is 2 c on a side along curve c, 2 c + 1 against
    it, -1 on no curve. A junction is a point with other than two marked edges.
    """
    corners, marked = topology.cells.ravel(), np.flatnonzero(is_line)
    sides, ends = topology.edge_sides[marked], topology.edges[marked]
    is_boundary = sides[:, 1] < 0
    ends[is_boundary] = topology.outline
    is_junction = ~np.isin(np.bincount(ends.ravel(), minlength=topology.n_points), (0, 2))
    nodes, walked, along, first, is_closed = _walk(ends, is_boundary, is_junction)
    curve = np.repeat(np.arange(len(first) - 1), np.diff(first) - 1)
    start = np.where(along, ends[walked, 0], ends[walked, 1])
    code = np.full(len(corners), -1, dtype=np.int64)
    for side in sides[walked].T:
        there = np.flatnonzero(side >= 0)
        code[side[there]] = 2 * curve[there] + (corners[side[there]] != start[there])
    is_inside = ~is_boundary[walked][first[:-1] - np.arange(len(first) - 1)]
    codes = np.roll(code.reshape(-1, 3), -1, axis=1)  # the side opposite corner i starts at corner i + 1
    return Curves(nodes, first, is_closed, is_inside, is_junction), codes


def _walk(ends: Ints, is_boundary: Bools, is_junction: Bools) -> tuple[Ints, Ints, Bools, Ints, Bools]:
    """Return nodes, the edges between them and whether each is walked along, rows of curves, closedness."""
    n = len(ends)
    order = np.argsort(ends.ravel(), kind="stable")
    sorted_ends = ends.ravel()[order]
    start = np.searchsorted(sorted_ends, np.arange(len(is_junction) + 1))
    nodes = np.empty(2 * n + 1, dtype=np.int64)
    walked, along = np.empty(n, dtype=np.int64), np.empty(n, dtype=np.bool_)
    first, is_closed = np.empty(n + 1, dtype=np.int64), np.empty(n, dtype=np.bool_)
    n_nodes, n_curves = chain(
        ends, is_boundary, is_junction, start, order, nodes, walked, along, first, is_closed
    )
    return nodes[:n_nodes], walked, along, first[: n_curves + 1], is_closed[:n_curves]
