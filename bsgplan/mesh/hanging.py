"""Hanging nodes: points in the middle of an edge of a neighbour, where a mesh that looks whole is cracked.

Split quads of an adaptive grid leave them. The long edge and the short ones along it then all lie on the
boundary, and the first short one begins where the long one does, in its direction.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints
from .quality import lengths
from .topology import Topology

SAME_DIRECTION = 1e-6
"""Sine of the angle under which two edges of the boundary run one way: coordinates of a text file have six
digits and more, and no mesh has a notch so sharp."""
MOST_AT_A_POINT = 16
"""Edges of the boundary at one point that are held against each other; a point of more joins many corners."""


def hanging_points(points: Floats, topology: Topology) -> Ints:
    """Return the points that lie in the middle of an edge of the boundary, sorted.

    Those next to one of its ends where several do. A triangle over two:

    >>> from bsgplan.mesh.topology import topology
    >>> points = np.array([[0.0, 0], [1, 0], [2, 0], [0, -1], [2, -1], [1, 1]])
    >>> hanging_points(points, topology(np.array([[0, 2, 5], [0, 3, 1], [1, 4, 2]]), 6))
    array([1])
    """
    ends = topology.edges[topology.is_boundary_edge]
    starts = np.concatenate([ends[:, 0], ends[:, 1]])
    order = np.argsort(starts, kind="stable")
    start, end = starts[order], np.concatenate([ends[:, 1], ends[:, 0]])[order]
    side = points[end] - points[start]
    length = lengths(side)
    found = [np.empty(0, dtype=np.int64)]
    for step in range(1, min(MOST_AT_A_POINT, int(np.bincount(start).max(initial=1)))):
        is_here = start[step:] == start[:-step]
        first, second = np.flatnonzero(is_here), np.flatnonzero(is_here) + step
        unit = [side[k] / length[k, None] for k in (first, second)]
        is_along = lengths(unit[1] - unit[0]) < SAME_DIRECTION  # the chord of a small angle is its sine
        shorter = np.where(length[first] < length[second], first, second)[is_along]
        found.append(end[shorter])
    return np.unique(np.concatenate(found))
