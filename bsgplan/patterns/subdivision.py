"""Uniform subdivision of a triangulation: every triangle into s * s, shared edge nodes merged.

Invariants: conforming and watertight where the input is; corners keep their indices, then come the nodes
inside edges, then those inside triangles; the s * s children of a block are consecutive.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ..arrays import Floats, Ints, frozen_ints
from ..errors import InvalidOption
from ..mesh.topology import topology


def subdivide(points: Floats, triangles: Ints, s: int) -> tuple[Floats, Ints, Ints]:
    """Return points, triangles and the block of each triangle, each block split into s * s triangles.

    >>> points, triangles, block = subdivide(np.eye(3), np.array([[0, 1, 2]]), 2)
    >>> len(points), triangles.tolist(), block.tolist()
    (6, [[0, 3, 4], [3, 1, 5], [4, 5, 2], [5, 4, 3]], [0, 0, 0, 0])
    """
    if s < 1:
        raise InvalidOption(f"subdivision {s} is below 1; each edge of a block is cut into 1 or more")
    mesh = topology(triangles, len(points))
    weights, children = _lattice(s)
    on_edge, inside = _edge_slots(s), np.flatnonzero((weights > 0).all(axis=1))
    n_blocks, n_points = len(triangles), len(points)

    nodes = np.empty((n_blocks, len(weights)), dtype=np.int64)
    nodes[:, _corner_slots(s)] = triangles
    along = np.arange(s - 1)
    for corner in range(3):
        edge = mesh.cell_edges[:, corner, None]
        is_forward = mesh.edges[edge[:, 0], 0] == triangles[:, corner]
        nodes[:, on_edge[corner]] = (
            n_points + edge * (s - 1) + np.where(is_forward[:, None], along, along[::-1])
        )
    n_skeleton = n_points + len(mesh.edges) * (s - 1)
    nodes[:, inside] = n_skeleton + np.arange(n_blocks * len(inside)).reshape(n_blocks, -1)

    share = np.arange(1, s)[:, None] / s
    start, end = points[mesh.edges].swapaxes(0, 1)
    edge_points = start[:, None] * (1 - share) + end[:, None] * share
    inner_points = np.einsum("kc,bcd->bkd", weights[inside] / s, points[triangles])
    dimension = points.shape[1]
    everything = np.concatenate(
        [points, edge_points.reshape(-1, dimension), inner_points.reshape(-1, dimension)]
    )
    return everything, nodes[:, children].reshape(-1, 3), np.repeat(np.arange(n_blocks), s * s)


@lru_cache(maxsize=64)
def _lattice(s: int) -> tuple[Ints, Ints]:
    """Barycentric weights of the nodes, (n, 3), summing to s, and the small triangles, (s * s, 3)."""
    j, k = np.array([(j, k) for k in range(s + 1) for j in range(s + 1 - k)]).T
    slot = np.full((s + 2, s + 2), -1)
    slot[j, k] = np.arange(len(j))
    upright = j + k < s
    j0, k0 = j[upright], k[upright]
    up = np.column_stack([slot[j0, k0], slot[j0 + 1, k0], slot[j0, k0 + 1]])
    flipped = j0 + k0 < s - 1
    j1, k1 = j0[flipped], k0[flipped]
    down = np.column_stack([slot[j1 + 1, k1 + 1], slot[j1, k1 + 1], slot[j1 + 1, k1]])
    return frozen_ints(np.column_stack([s - j - k, j, k])), frozen_ints(np.concatenate([up, down]))


@lru_cache(maxsize=64)
def _corner_slots(s: int) -> Ints:
    weights, _ = _lattice(s)
    return frozen_ints((weights == s).argmax(axis=0))


@lru_cache(maxsize=64)
def _edge_slots(s: int) -> tuple[Ints, ...]:
    """Nodes inside the edge from corner c to corner c + 1, in that order, three of (s - 1,)."""
    weights, _ = _lattice(s)
    slots = []
    for corner in range(3):
        end = (corner + 1) % 3
        on = np.flatnonzero(
            (weights[:, (corner + 2) % 3] == 0) & (weights[:, corner] > 0) & (weights[:, end] > 0)
        )
        slots.append(frozen_ints(on[np.argsort(weights[on, end])]))
    return tuple(slots)
