"""Basins of a function on a graph, shallow ones merged: one half of the Morse-Smale cells.

Produces a basin label for every node. Invariants: a basin is connected, holds exactly one minimum whose
persistence reaches the threshold (the lowest of its component always does), and the labels do not depend
on the order of the edges.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import minimum_spanning_tree

from ..arrays import Floats, Ints


def basins(edges: Ints, lengths: Floats, values: Floats, persistence: float) -> Ints:
    """Return the minimum to which each node descends, (n_nodes,), as the index of that node.

    Each node follows its steepest edge down; a basin whose depth below its lowest saddle is under
    persistence (in the unit of values) joins the basin across that saddle. O(n log n).

    >>> path = np.array([[0, 1], [1, 2], [2, 3], [3, 4]])
    >>> basins(path, np.ones(4), np.array([0.0, 1.0, 0.9, 1.2, 0.5]), 0.2).tolist()
    [0, 0, 0, 4, 4]
    """
    minimum = _descend(edges, lengths, values)
    minima, basin = np.unique(minimum, return_inverse=True)
    merged = _merge(edges, values, minima, basin, persistence)
    return minima[merged[basin]]


def _descend(edges: Ints, lengths: Floats, values: Floats) -> Ints:
    n_nodes = len(values)
    rank = np.empty(n_nodes, dtype=np.int64)
    rank[np.argsort(values, kind="stable")] = np.arange(n_nodes)
    is_down = rank[edges[:, 0]] > rank[edges[:, 1]]
    upper = np.where(is_down, edges[:, 0], edges[:, 1])
    lower = np.where(is_down, edges[:, 1], edges[:, 0])
    slope = (values[upper] - values[lower]) / lengths
    steepest = np.full(n_nodes, -np.inf)
    np.maximum.at(steepest, upper, slope)
    is_best = slope >= steepest[upper]
    target_rank = np.arange(n_nodes)[rank]  # each node's own rank: a minimum stays where it is
    np.minimum.at(target_rank, upper[is_best], rank[lower[is_best]])
    node_of_rank = np.argsort(rank)
    target = node_of_rank[target_rank]
    while True:  # pointer jumping: the number of steps is the logarithm of the longest path
        further = target[target]
        if np.array_equal(further, target):
            return target
        target = further


def _merge(edges: Ints, values: Floats, minima: Ints, basin: Ints, persistence: float) -> Ints:
    first, second = basin[edges[:, 0]], basin[edges[:, 1]]
    is_border = first != second
    # edges that meet in one highest node have one height: the lower end decides, not the numbering
    ends = np.sort(values[edges[is_border]], axis=1)[:, ::-1]
    levels, saddle = np.unique(ends, axis=0, return_inverse=True)
    tree = _lowest_saddles(first[is_border], second[is_border], saddle.ravel(), len(minima))
    depth = values[minima]
    label = np.arange(len(minima))
    sublevel = list(range(len(minima)))  # union-find over the components below the current saddle
    for a, b, rank in zip(*tree, strict=True):
        height = levels[rank, 0]
        root_a, root_b = _root(sublevel, a), _root(sublevel, b)
        if (depth[root_a], root_a) > (depth[root_b], root_b):
            root_a, root_b, a = root_b, root_a, b
        if height - depth[root_b] < persistence:
            label[root_b] = a  # the basin across the saddle; it may be merged itself
        sublevel[root_b] = root_a
    while True:
        further = label[label]
        if np.array_equal(further, label):
            return label
        label = further


def _lowest_saddles(
    first: Ints, second: Ints, saddle: Ints, n_basins: int
) -> tuple[list[int], list[int], list[int]]:
    """Return the minimum spanning tree of the basins over the ranks of their saddles, lowest first."""
    if not len(saddle):
        return [], [], []
    a, b = np.minimum(first, second), np.maximum(first, second)
    order = np.lexsort((b, a, saddle))
    key = a[order] * np.int64(n_basins) + b[order]
    order = order[np.unique(key, return_index=True)[1]]
    weight = saddle[order] + 1.0  # positive, as csgraph takes 0 for no edge
    graph = coo_array((weight, (a[order], b[order])), shape=(n_basins, n_basins)).tocsr()
    tree = minimum_spanning_tree(graph).tocoo()
    by_height = np.lexsort((tree.col, tree.row, tree.data))
    ranks = tree.data[by_height].astype(np.int64) - 1
    return tree.row[by_height].tolist(), tree.col[by_height].tolist(), ranks.tolist()


def _root(parent: list[int], node: int) -> int:
    while parent[node] != node:
        parent[node] = parent[parent[node]]
        node = parent[node]
    return node
