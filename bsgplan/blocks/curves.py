"""The curves of a domain as sequences of points: boundary loops and interfaces, cut at their junctions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Ints
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


def find_curves(
    triangles: Ints, side_edges: Ints, edges: Ints, is_line: Bools, is_boundary: Bools
) -> tuple[Curves, Ints]:
    """Return the curves of the marked edges, and the code of each triangle side, (n_triangles, 3).

    side_edges is the edge opposite each corner. A code is 2 c on a side along curve c, 2 c + 1 against it,
    -1 on no curve. A junction is a point with other than two marked edges.
    """
    n_points = int(edges.max()) + 1
    directed = edges.copy()
    triangle, side = np.nonzero(is_boundary[side_edges])
    edge = side_edges[triangle, side]
    directed[edge, 0] = triangles[triangle, (side + 1) % 3]
    directed[edge, 1] = triangles[triangle, (side + 2) % 3]
    marked = np.flatnonzero(is_line)
    ends = directed[marked]
    is_junction = ~np.isin(np.bincount(ends.ravel(), minlength=n_points), (0, 2))
    nodes, walked, along, first, is_closed = _walk(ends, is_boundary[marked], is_junction)
    curve = np.repeat(np.arange(len(first) - 1), np.diff(first) - 1)
    code_of_edge = np.full(len(edges), -1, dtype=np.int64)
    code_of_edge[marked[walked]] = 2 * curve
    run_along = np.zeros((len(edges), 2), dtype=np.int64)
    run_along[marked[walked]] = np.where(along[:, None], ends[walked], ends[walked][:, ::-1])
    code = code_of_edge[side_edges]
    is_against = run_along[side_edges][..., 0] != triangles[:, [1, 2, 0]]
    is_inside = ~is_boundary[marked[walked]][first[:-1] - np.arange(len(first) - 1)]
    return (
        Curves(nodes, first, is_closed, is_inside, is_junction),
        np.where(code >= 0, code + is_against, -1),
    )


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
