"""What the boundary can carry: the largest block edge at each of its points, and across narrow channels.

Five rules, each a reason why a longer edge would miss the domain: a loop needs five edges, a stretch
between corners one, an edge must not cut off a bay or a cape, and a channel is no wider than its triangles.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from ..arrays import Bools, Floats, Ints
from .domain import Domain

LOOP_EDGES = 5
"""Edges that a closed curve gets at least."""

BOW = 1.35
"""Largest ratio of arc to chord under one edge: a half circle has 1.57, a third of one 1.21."""

ARCS = 1.5 * 2.0 ** (0.5 * np.arange(16))
"""Arcs tried, in edges of the input: 1.5, 2.1, 3, .. up to the wanted block edge."""

CHANNEL = 1.15
"""Height of an equilateral triangle to its edge: a channel of width w carries edges of this times w."""

WINDING = 3.0
"""Two places of one loop face each other across a channel where the way along the loop is this many widths."""

def boundary_limit(domain: Domain, length: Floats, h: Floats, is_corner: Bools) -> Floats:
    """Return the longest block edge that the boundary carries at each point, (n_points,); inf inside.

    length is the wanted block edge, h the input's own size, both at the points in the domain's unit.
    """
    limit = np.full(domain.n_points, np.inf)
    stop = is_corner | domain.lines.is_junction
    for c, (first, last, is_closed, is_inside) in enumerate(domain.curves):
        nodes = domain.curve_nodes[first:last]
        rows = domain.curve_points[first:last]
        own = _along_curve(rows, bool(is_closed), length[nodes], h[nodes], stop[nodes])
        if is_closed and not is_inside:
            own = np.minimum(own, domain.curve_lengths[c] / LOOP_EDGES)
        np.minimum.at(limit, nodes, own)
    np.minimum(limit, _channels(domain, length), out=limit)
    return limit


def _along_curve(rows: Floats, is_closed: bool, length: Floats, h: Floats, stop: Bools) -> Floats:
    """Return the longest edge at each node of one curve: by the corners beside it and by its bow."""
    arc, total = rows[:, 2], rows[-1, 2]
    behind, ahead = _to_corners(arc, is_closed, total, stop)
    gap = behind + ahead
    at_stop = np.flatnonzero(stop)
    gap[at_stop] = np.minimum(gap[at_stop], _smaller_gap(arc, is_closed, total, at_stop))
    if is_closed:
        axis = np.concatenate([arc[:-1] - total, arc[:-1], arc + total])
        xy = np.concatenate([rows[:-1, :2], rows[:-1, :2], rows[:, :2]])
    else:
        axis, xy = arc, rows[:, :2]
    longest, is_open = np.minimum(1.5 * h, length), np.ones(len(arc), dtype=bool)
    for edges in ARCS:
        want = np.minimum(edges * h, length)
        low, high = arc - np.minimum(want / 2, behind), arc + np.minimum(want / 2, ahead)
        ends = [np.column_stack([np.interp(x, axis, xy[:, i]) for i in range(2)]) for x in (low, high)]
        chord = np.linalg.norm(ends[1] - ends[0], axis=1)
        is_open &= (high - low) <= BOW * chord
        longest = np.where(is_open, np.maximum(longest, want), longest)
        if (want >= length).all():
            break
    return np.minimum(longest, gap)


def _to_corners(arc: Floats, is_closed: bool, total: float, stop: Bools) -> tuple[Floats, Floats]:
    """Return the arc from each node back to the corner behind and on to the one ahead; inf without any."""
    at = np.unique(arc[stop])
    if is_closed and len(at):
        at = np.unique(np.concatenate([at - total, at, at + total]))
    if not is_closed:
        at = np.unique(np.concatenate([[0.0], at, [total]]))
    if not len(at):
        return np.full(len(arc), np.inf), np.full(len(arc), np.inf)
    k = np.searchsorted(at, arc, side="right") - 1
    behind = arc - at[np.maximum(k, 0)]
    ahead = at[np.minimum(k + 1, len(at) - 1)] - arc
    is_at = behind == 0.0  # at a corner itself the arc behind is the one before it
    behind = np.where(is_at & (k > 0), arc - at[np.maximum(k - 1, 0)], behind)
    return behind, ahead


def _smaller_gap(arc: Floats, is_closed: bool, total: float, at_stop: Ints) -> Floats:
    """Return the shorter of the two stretches beside each corner."""
    behind, ahead = _to_corners(arc, is_closed, total, np.isin(np.arange(len(arc)), at_stop))
    both = np.minimum(behind[at_stop], ahead[at_stop])
    return np.where(both > 0, both, np.maximum(behind[at_stop], ahead[at_stop]))


def _channels(domain: Domain, length: Floats) -> Floats:
    """Return CHANNEL times the width of the channel at each point of the boundary that faces another."""
    limit = np.full(domain.n_points, np.inf)
    shore = np.flatnonzero(domain.is_boundary)
    edges = np.sort(domain.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges = np.unique(edges, axis=0)
    steps = np.linalg.norm(domain.points[edges[:, 1]] - domain.points[edges[:, 0]], axis=1)
    n = domain.n_points
    graph = coo_array((steps, (edges[:, 0], edges[:, 1])), shape=(n, n)).tocsr()
    away, _, nearest = dijkstra(
        graph, directed=False, indices=shore, min_only=True, return_predecessors=True
    )
    a, b = nearest[edges].T
    width = away[edges].sum(axis=1) + steps
    curve, arc = domain.curve_of_point, domain.arc_of_point
    total = domain.curve_lengths[np.maximum(curve[a], 0)]
    along = np.abs(arc[a] - arc[b])
    along = np.where(domain.lines.is_closed[np.maximum(curve[a], 0)], np.minimum(along, total - along), along)
    faces = (a != b) & ((curve[a] != curve[b]) | (along > WINDING * width))
    faces &= ~(domain.lines.is_junction[a] | domain.lines.is_junction[b])
    faces &= width < 2 * np.maximum(length[a], length[b])
    for side in (a, b):
        np.minimum.at(limit, side[faces], CHANNEL * width[faces])
    for side in edges[faces].T:
        np.minimum.at(limit, side, CHANNEL * width[faces])
    return limit
