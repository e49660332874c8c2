"""Edges walked from end to end: the one step of finding curves that is a pointer chase.

Plain Python: a few microseconds for each edge of the boundary, of which there are few; an estimate needs no
compiler for it.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Ints


def chain(
    ends: Ints,
    is_boundary: Bools,
    is_junction: Bools,
    start: Ints,
    order: Ints,
    nodes: Ints,
    walked: Ints,
    along: Bools,
    first: Ints,
    is_closed: Bools,
) -> tuple[int, int]:
    """Fill nodes, walked, along, first and is_closed; return the number of nodes and of curves.

    start and order list the ends (2 edge + which) at each point. Curves that begin at a junction come
    first; boundary edges are walked along their direction, the others as it comes.
    """
    n = len(ends)
    is_done = np.zeros(n, dtype=np.bool_)
    n_nodes, n_edges, n_curves = 0, 0, 0
    for only_open in (True, False):
        for seed in range(n):
            if is_done[seed]:
                continue
            forward = True
            if only_open and not is_junction[ends[seed, 0]]:
                if is_boundary[seed] or not is_junction[ends[seed, 1]]:
                    continue
                forward = False
            edge = seed
            first[n_curves] = n_nodes
            begin = ends[edge, 0] if forward else ends[edge, 1]
            nodes[n_nodes] = begin
            n_nodes += 1
            while True:
                is_done[edge] = True
                walked[n_edges], along[n_edges] = edge, forward
                n_edges += 1
                point = ends[edge, 1] if forward else ends[edge, 0]
                nodes[n_nodes] = point
                n_nodes += 1
                if is_junction[point] or point == begin:
                    break
                following = -1
                for k in range(start[point], start[point + 1]):
                    if order[k] // 2 != edge:
                        following = order[k]
                edge, forward = following // 2, following % 2 == 0
            is_closed[n_curves] = not is_junction[begin]
            n_curves += 1
    first[n_curves] = n_nodes
    return n_nodes, n_curves
