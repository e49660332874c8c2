"""Edges by their two ends: a number for each, the same in both directions, which of a mesh it is; loops."""

from __future__ import annotations

import numpy as np

from ..arrays import Ints
from .mesh import Mesh


def edge_keys(ends: Ints, n_points: int) -> Ints:
    """Return a number for each pair of points, (n,), the same in both directions.

    >>> edge_keys(np.array([[0, 2], [2, 0]]), 3).tolist()
    [2, 2]
    """
    return np.asarray(ends.min(axis=1) * n_points + ends.max(axis=1))


def edge_numbers(mesh: Mesh, ends: Ints) -> Ints:
    """Return the edge of `mesh.topology` between two points each, (n,), either way; -1 for none."""
    keys = edge_keys(mesh.topology.edges, mesh.n_points)  # sorted, as the edges are
    wanted = edge_keys(ends, mesh.n_points)
    at = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
    return np.asarray(np.where(keys[at] == wanted, at, -1))


def loops_of(sides: Ints) -> list[Ints]:
    """Return directed sides, (n, 2), as closed loops of vertices, in their direction; none where they fork.

    >>> [loop.tolist() for loop in loops_of(np.array([[3, 1], [1, 2], [2, 3]]))]
    [[3, 1, 2]]
    """
    after = dict(sides.tolist())
    result = []
    while after:
        first = node = next(iter(after))
        loop = []
        while node in after:
            loop.append(node)
            node = after.pop(node)
        if node != first:
            return []
        result.append(np.array(loop, dtype=np.int64))
    return result
