"""Small work on region labels, one integer a triangle: components, numbers, merging.

Every function keeps the promise of the segmentation: each triangle has exactly one label.
"""

from __future__ import annotations

import heapq

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Bools, Floats, Ints, short_type
from ..mesh import Mesh

SPARSE_KEYS = 8
"""Keys that span more than so many times their number are ranked by sorting."""

OWN_KIND = 4.0
"""A neighbour of a region's own kind, zone or transition, is as welcome as one with so much more border:
the slivers of a steep transition around a plateau belong together, and not to the plateau."""


def compact(*keys: Ints) -> Ints:
    """Return labels 0, 1, .. for equal rows of keys, (n,), in the sorted order of the keys.

    >>> compact(np.array([5, 5, 2]), np.array([0, 1, 7])).tolist()
    [1, 2, 0]
    """
    label = _dense(keys[0])
    for key in keys[1:]:
        second = _dense(key)
        label = _dense(label * (second.max() + 1) + second)
    return label


def _dense(key: Ints) -> Ints:
    """Return the rank of each key among the distinct keys, (n,); in linear time where keys are small."""
    low, high = int(key.min()), int(key.max())
    if high - low > SPARSE_KEYS * len(key):
        return np.unique(key, return_inverse=True)[1].astype(np.int64)
    is_there = np.zeros(high - low + 1, dtype=bool)
    is_there[key - low] = True
    return (np.cumsum(is_there) - 1)[key - low]


def connected(mesh: Mesh, label: Ints) -> Ints:
    """Return labels split into edge-connected pieces, (n_triangles,), numbered from 0."""
    across = mesh.topology.across
    return _components(np.where((across >= 0) & (label[across] == label[:, None]), across, -1))


def pieces(mesh: Mesh, mask: Bools) -> tuple[Ints, Ints]:
    """Return the triangles in the mask, (n,), and the edge-connected piece of each, (n,), from 0."""
    inside = np.flatnonzero(mask)
    number = np.full(mesh.n_triangles + 1, -1)  # the last is that of no triangle
    number[inside] = np.arange(len(inside))
    return inside, _components(number[mesh.topology.across.take(inside, axis=0)])


def _components(beside: Ints) -> Ints:
    """Return the component of each node, (n,), from 0; beside lists its neighbours, (n, 3), -1 for none.

    A node is its own neighbour where there is none, so that nothing needs counting.
    """
    n, size = len(beside), beside.size
    small = short_type(size)
    links = np.where(beside >= 0, beside, np.arange(n)[:, None]).astype(small)
    graph = csr_array((np.ones(size), links.ravel(), np.arange(0, size + 1, 3, dtype=small)), shape=(n, n))
    return connected_components(graph, connection="strong")[1].astype(np.int64)  # symmetric: strong is weak


def finest_first(label: Ints, log_h: Floats) -> Ints:
    """Return labels renumbered by their smallest log size, (n_triangles,): no trace of the file's order."""
    n = int(label.max()) + 1
    finest = np.full(n, np.inf)
    np.minimum.at(finest, label, log_h)
    rank = np.empty(n, dtype=np.int64)
    rank[np.lexsort((np.arange(n), finest))] = np.arange(n)
    return rank[label]


def merge_small(
    mesh: Mesh, label: Ints, log_h: Floats, weight: Floats, *, kind: Bools, least: Floats, width: float
) -> Ints:
    """Return labels where no region is under its least triangles or width layers thick, (n_triangles,).

    The smallest joins first, the neighbour with the longest common border (in edges) weighed against the
    step in mean log size between the two: border / (0.1 + step), and OWN_KIND times that for a neighbour of
    its own kind. Thickness is triangles per border edge. A region without neighbours stays. log_h and
    weight are one value a triangle, kind and least one a label.
    """
    n = int(label.max()) + 1
    parent = np.arange(n)
    total = np.bincount(label, weight, n)
    moment = np.bincount(label, weight * log_h, n)
    border, rim = _borders(mesh, label, n)
    queue = [(float(total[i]), i) for i in range(n)]
    heapq.heapify(queue)
    while queue:
        size, i = heapq.heappop(queue)
        if parent[i] != i or size != total[i] or not border[i]:
            continue
        edges_around = rim[i] + sum(border[i].values())
        if size >= least[i] and size >= width * edges_around:
            continue
        mean = moment[i] / total[i]

        def fit(j: int, i: int = i, mean: float = mean) -> tuple[float, int]:
            favour = OWN_KIND if kind[i] == kind[j] else 1.0
            return favour * border[i][j] / (0.1 + abs(mean - moment[j] / total[j])), -j

        best = max(border[i], key=fit)
        _join(border, rim, i, best)
        parent[i] = best
        total[best] += total[i]
        moment[best] += moment[i]
        heapq.heappush(queue, (float(total[best]), best))
    while not np.array_equal(parent[parent], parent):
        parent = parent[parent]
    return compact(parent[label])


def _join(border: list[dict[int, int]], rim: list[int], i: int, into: int) -> None:
    for j, n_edges in border[i].items():
        del border[j][i]
        if j != into:
            border[into][j] = border[j][into] = border[into].get(j, 0) + n_edges
    border[i] = {}
    rim[into] += rim[i]


def _borders(mesh: Mesh, label: Ints, n: int) -> tuple[list[dict[int, int]], list[int]]:
    """Return the edges shared with each neighbour and the edges on the domain's boundary, per label."""
    topology = mesh.topology
    first, second = (label[side] for side in topology.neighbours.T)
    is_cut = np.flatnonzero(first != second)
    pairs = np.sort(np.column_stack([first[is_cut], second[is_cut]]), axis=1)
    key, count = np.unique(pairs[:, 0] * n + pairs[:, 1], return_counts=True)
    border: list[dict[int, int]] = [{} for _ in range(n)]
    for a, b, n_edges in zip((key // n).tolist(), (key % n).tolist(), count.tolist(), strict=True):
        border[a][b] = border[b][a] = n_edges
    rim = np.bincount(label[topology.edge_cells[topology.is_boundary_edge, 0]], minlength=n)
    return border, rim.tolist()
