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
    is_minimum = minimum == np.arange(len(values))
    minima, basin = np.flatnonzero(is_minimum), (np.cumsum(is_minimum) - 1)[minimum]
    merged = _merge(edges, values, minima, basin, persistence)
    return minima[merged[basin]]


def _descend(edges: Ints, lengths: Floats, values: Floats) -> Ints:
    """Return the minimum below each node; of equal neighbours the first is the lower one."""
    n_nodes = len(values)
    a, b = edges.T
    first, second = np.minimum(a, b), np.maximum(a, b)
    rise = values[first] - values[second]
    is_down = rise > 0
    upper, lower = np.where(is_down, first, second), np.where(is_down, second, first)
    slope = np.abs(rise) / lengths
    steepest = np.full(n_nodes, -np.inf)
    np.maximum.at(steepest, upper, slope)
    best = np.flatnonzero(slope >= steepest[upper])
    upper, lower = upper[best], lower[best]
    lowest = np.full(n_nodes, np.inf)  # of edges equally steep: to the lower node, to the first of equal ones
    np.minimum.at(lowest, upper, values[lower])
    is_lowest = values[lower] == lowest[upper]
    target = np.full(n_nodes, n_nodes)
    np.minimum.at(target, upper[is_lowest], lower[is_lowest])
    target = np.where(target < n_nodes, target, np.arange(n_nodes))  # a minimum stays where it is
    while True:  # pointer jumping: the number of steps is the logarithm of the longest path
        further = target[target]
        if np.array_equal(further, target):
            return target
        target = further


def _merge(edges: Ints, values: Floats, minima: Ints, basin: Ints, persistence: float) -> Ints:
    first, second = basin[edges[:, 0]], basin[edges[:, 1]]
    is_border = first != second
    # edges that meet in one highest node have one height: the lower end decides, not the numbering
    first, second = first[is_border], second[is_border]
    ends = values[edges.take(np.flatnonzero(is_border), axis=0)].T
    low, high = np.minimum(*ends), np.maximum(*ends)
    pair, lowest = _lowest_of_pairs(first, second, low, high, len(minima))
    order = np.lexsort((low[lowest], high[lowest]))
    levels = high[lowest][order]
    is_new = np.ones(len(order), dtype=bool)
    is_new[1:] = (levels[1:] != levels[:-1]) | (low[lowest][order][1:] != low[lowest][order][:-1])
    saddle = np.empty(len(order), dtype=np.int64)
    saddle[order] = np.cumsum(is_new) - 1
    levels = levels[is_new]
    tree = _lowest_saddles(pair // len(minima), pair % len(minima), saddle, len(minima))
    depth = values[minima]
    label = np.arange(len(minima))
    sublevel = list(range(len(minima)))  # union-find over the components below the current saddle
    for a, b, rank in zip(*tree, strict=True):
        height = levels[rank]
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


def _lowest_of_pairs(
    first: Ints, second: Ints, low: Floats, high: Floats, n_basins: int
) -> tuple[Ints, Ints]:
    """Return the pairs of basins that meet, a n + b with a < b, and the index of the lowest edge of each."""
    key, member = np.unique(
        np.minimum(first, second) * np.int64(n_basins) + np.maximum(first, second), return_inverse=True
    )
    least = np.full(len(key), np.inf)
    np.minimum.at(least, member, high)
    tied = np.flatnonzero(high == least[member])
    np.minimum.at(beyond := np.full(len(key), np.inf), member[tied], low[tied])
    tied = tied[low[tied] == beyond[member[tied]]]
    lowest = np.empty(len(key), dtype=np.int64)
    lowest[member[tied]] = tied
    return key, lowest


def _lowest_saddles(
    first: Ints, second: Ints, saddle: Ints, n_basins: int
) -> tuple[list[int], list[int], list[int]]:
    """Return the minimum spanning tree of pairs of basins over the ranks of their saddles, lowest first."""
    if not len(saddle):
        return [], [], []
    weight = saddle + 1.0  # positive, as csgraph takes 0 for no edge
    graph = coo_array((weight, (first, second)), shape=(n_basins, n_basins)).tocsr()
    tree = minimum_spanning_tree(graph).tocoo()
    by_height = np.lexsort((tree.col, tree.row, tree.data))
    ranks = tree.data[by_height].astype(np.int64) - 1
    return tree.row[by_height].tolist(), tree.col[by_height].tolist(), ranks.tolist()


def _root(parent: list[int], node: int) -> int:
    while parent[node] != node:
        parent[node] = parent[parent[node]]
        node = parent[node]
    return node
