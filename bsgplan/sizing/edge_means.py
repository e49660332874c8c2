"""Mean log length of the edges at groups of points, and where: the compiled loop of `thinned`."""

from __future__ import annotations

from math import log

from ..arrays import Floats, Ints
from ..compiled import compiled


@compiled
def add_edges(points: Floats, edges: Ints, owner: Ints, sums: Floats) -> None:
    """Add every edge to the owners of its two ends.

    points is (n_points, 2), edges (n_edges, 2), owner (n_points,); sums is (n_owners, 4): how many edges,
    their log lengths, and the coordinates of their middles.
    """
    for k in range(len(edges)):
        a, b = edges[k, 0], edges[k, 1]
        x, y = points[b, 0] - points[a, 0], points[b, 1] - points[a, 1]
        size = 0.5 * log(x * x + y * y)
        x, y = 0.5 * (points[a, 0] + points[b, 0]), 0.5 * (points[a, 1] + points[b, 1])
        for own in (owner[a], owner[b]):
            sums[own, 0] += 1.0
            sums[own, 1] += size
            sums[own, 2] += x
            sums[own, 3] += y
