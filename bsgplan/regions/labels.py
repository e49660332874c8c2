"""Small work on region labels, one integer a triangle: components, borders, smoothing, merging.

Every function keeps the promise of the segmentation: each triangle has exactly one label.
"""

from __future__ import annotations

import heapq

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Bools, Floats, Ints, sums_by
from ..mesh import Mesh
from ..mesh.quality import angles

OWN_KIND = 4.0
"""A neighbour of a region's own kind, zone or transition, is as welcome as one with so much more border:
the slivers of a steep transition around a plateau belong together, and not to the plateau."""


def compact(*keys: Ints) -> Ints:
    """Return labels 0, 1, .. for equal rows of keys, (n,), in the sorted order of the keys.

    >>> compact(np.array([5, 5, 2]), np.array([0, 1, 7])).tolist()
    [1, 2, 0]
    """
    label = np.unique(keys[0], return_inverse=True)[1].astype(np.int64)
    for key in keys[1:]:
        second = np.unique(key, return_inverse=True)[1]
        label = np.unique(label * (second.max() + 1) + second, return_inverse=True)[1].astype(np.int64)
    return label


def connected(mesh: Mesh, label: Ints) -> Ints:
    """Return labels split into edge-connected pieces, (n_triangles,), numbered from 0."""
    pairs = mesh.topology.neighbours
    pairs = pairs[label[pairs[:, 0]] == label[pairs[:, 1]]]
    n = mesh.n_triangles
    graph = coo_array((np.ones(len(pairs), np.int8), (pairs[:, 0], pairs[:, 1])), shape=(n, n))
    return connected_components(graph, directed=False)[1].astype(np.int64)


def finest_first(label: Ints, log_h: Floats) -> Ints:
    """Return labels renumbered by their smallest log size, (n_triangles,): no trace of the file's order."""
    n = int(label.max()) + 1
    finest = np.full(n, np.inf)
    np.minimum.at(finest, label, log_h)
    rank = np.empty(n, dtype=np.int64)
    rank[np.lexsort((np.arange(n), finest))] = np.arange(n)
    return rank[label]


def smooth_borders(mesh: Mesh, label: Ints, average: csr_array, *, rounds: int) -> Ints:
    """Return labels with their borders straightened, (n_triangles,); average is `ring_average` of the mesh.

    Threshold dynamics [Merriman, Bence & Osher]: the indicator of each label is averaged over the
    triangles around the vertices, four times, and each triangle takes the label that is strongest there;
    rounds times. Only triangles near a border are touched; ties go to the smaller label. Last, teeth are
    pulled: a triangle with two neighbours in one other region joins them.
    """
    for _ in range(rounds):
        near = _near_border(mesh, label, 4)
        wide = np.flatnonzero(_near_border(mesh, label, 8))
        matrix = average[wide][:, wide]
        names, local = np.unique(label[wide], return_inverse=True)
        n_wide = len(wide)
        share = csr_array((np.ones(n_wide), (np.arange(n_wide), local)), shape=(n_wide, len(names)))
        for _ in range(4):
            share = csr_array(matrix @ share)
        strongest = names[_row_argmax(share)]
        changed = label.copy()
        changed[wide] = np.where(near[wide], strongest, label[wide])
        if np.array_equal(changed, label):
            break
        label = changed
    return _pull_teeth(mesh, label)


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
    pairs = label[topology.neighbours]
    pairs = np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1)
    unique, count = np.unique(pairs, axis=0, return_counts=True)
    border: list[dict[int, int]] = [{} for _ in range(n)]
    for (a, b), n_edges in zip(unique.tolist(), count.tolist(), strict=True):
        border[a][b] = border[b][a] = n_edges
    rim = np.bincount(label[topology.edge_cells[topology.is_boundary_edge, 0]], minlength=n)
    return border, rim.tolist()


def _near_border(mesh: Mesh, label: Ints, rings: int) -> Bools:
    pairs = mesh.topology.neighbours
    cut = pairs[label[pairs[:, 0]] != label[pairs[:, 1]]]
    near = np.zeros(mesh.n_triangles, dtype=bool)
    near[cut] = True
    vertex = np.zeros(mesh.n_points, dtype=bool)
    for _ in range(rings):
        vertex[mesh.triangles[near]] = True
        near = np.asarray(vertex[mesh.triangles].any(axis=1))
    return near


def ring_average(mesh: Mesh) -> csr_array:
    """Return the matrix that averages triangle values around the corners, weighed by their angles.

    Weighed by number, a border would creep from the fine side, with its many triangles, into the coarse.
    """
    n, rows = mesh.n_triangles, np.repeat(np.arange(mesh.n_triangles), 3)
    corner = mesh.triangles.ravel()
    angle = angles(mesh.corner_edge_lengths).ravel()
    share = angle / (3 * sums_by(corner, angle, mesh.n_points)[corner])
    spread = csr_array((np.ones(3 * n), (rows, corner)), shape=(n, mesh.n_points))
    gather = csr_array((share, (corner, rows)), shape=(mesh.n_points, n))
    return csr_array(spread @ gather)


def _pull_teeth(mesh: Mesh, label: Ints) -> Ints:
    topology = mesh.topology
    sides = topology.edge_cells[topology.cell_edges]
    neighbour = np.where(sides[..., 0] == np.arange(mesh.n_triangles)[:, None], sides[..., 1], sides[..., 0])
    for turn in range(20):
        around = np.where(neighbour >= 0, label[neighbour], -1)
        twin = np.where(around[:, 0] == around[:, 1], around[:, 0], around[:, 2])
        is_tooth = (np.count_nonzero(around == twin[:, None], axis=1) == 2) & (twin >= 0)
        # one direction a turn, so that two teeth side by side cannot swap for ever
        is_tooth &= (twin < label) if turn % 2 else (twin > label)
        label = np.where(is_tooth, twin, label)
    return label


def _row_argmax(matrix: csr_array) -> Ints:
    matrix.sort_indices()
    row = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    order = np.lexsort((matrix.indices, -np.round(matrix.data, 9), row))
    return matrix.indices[order[matrix.indptr[:-1]]].astype(np.int64)
