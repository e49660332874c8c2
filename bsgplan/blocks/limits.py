"""What the boundary can carry: the largest block edge at each of its points, and across narrow channels.

Five rules, each a reason why a longer edge would miss the domain: a loop needs five edges, a stretch
between corners one, an edge must not cut off a bay or a cape, and a channel is no wider than its triangles.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import dijkstra

from ..arrays import Bools, Floats, Ints
from ..mesh.operators import between_ends
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
"""Two places of one loop face each other over a channel where the way along the loop is so many widths."""


def boundary_limit(domain: Domain, length: Floats, h: Floats, is_corner: Bools) -> Floats:
    """Return the longest block edge that the curves carry at each point, (n_points,); inf inside.

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
    return limit


def _along_curve(rows: Floats, is_closed: bool, length: Floats, h: Floats, stop: Bools) -> Floats:
    """Return the longest edge at each node of one curve: by the corners beside it and by its bow."""
    arc, total = rows[:, 2], rows[-1, 2]
    behind, ahead = _to_corners(arc, is_closed, total, stop)
    gap = np.where(stop, np.minimum(behind, ahead), behind + ahead)
    if is_closed:
        axis = np.concatenate([arc[:-1] - total, arc[:-1], arc + total])
        xy = np.concatenate([rows[:-1, :2], rows[:-1, :2], rows[:, :2]])
    else:
        axis, xy = arc, rows[:, :2]
    longest = np.minimum(1.5 * h, length)
    is_open = np.ones(len(arc), dtype=bool)
    for edges in ARCS:
        want = np.minimum(edges * h, length)
        # at a corner the arcs before and after it are tried apart: an edge ends there
        low, high = (np.minimum(np.where(stop, want, want / 2), reach) for reach in (behind, ahead))
        before, here, after = (
            np.column_stack([np.interp(x, axis, xy[:, i]) for i in range(2)])
            for x in (arc - low, arc, arc + high)
        )
        across = np.linalg.norm(after - before, axis=1)
        one_sided = [np.linalg.norm(here - before, axis=1), np.linalg.norm(after - here, axis=1)]
        is_straight = np.where(
            stop,
            (low <= BOW * one_sided[0]) & (high <= BOW * one_sided[1]),
            low + high <= BOW * across,
        )
        is_open &= is_straight
        longest = np.where(is_open, np.maximum(longest, want), longest)
        if (want >= length).all():
            break
    return np.minimum(longest, gap)


def _to_corners(arc: Floats, is_closed: bool, total: float, stop: Bools) -> tuple[Floats, Floats]:
    """Return the arc from each node back to the corner behind and on to the one ahead; inf without any.

    At the ends of an open curve the arc beyond it is that within.
    """
    at = np.unique(arc[stop])
    if is_closed:
        at = np.unique(np.concatenate([at - total, at, at + total]))
    else:
        at = np.unique(np.concatenate([[0.0], at, [total]]))
    if not len(at):
        return np.full(len(arc), np.inf), np.full(len(arc), np.inf)
    at = np.concatenate([[-np.inf], at, [np.inf]])
    behind = arc - at[np.searchsorted(at, arc, side="left") - 1]
    ahead = at[np.searchsorted(at, arc, side="right")] - arc
    return np.where(np.isinf(behind), ahead, behind), np.where(np.isinf(ahead), behind, ahead)


def channel_limit(domain: Domain, length: Floats) -> Floats:
    """Return CHANNEL times the width of the channel at each point of the boundary that faces another."""
    limit = _to_opposite_banks(domain)
    shore = np.flatnonzero(domain.is_boundary)
    mesh, wanted = domain.mesh, length * domain.scale
    away, _, nearest = dijkstra(
        between_ends(mesh, mesh.edge_lengths),
        indices=shore,
        return_predecessors=True,
        limit=2 * float(wanted[shore].max()),
        min_only=True,
    )
    first, second = mesh.topology.edges.T
    between = np.flatnonzero(nearest[first] != nearest[second])
    between = between[np.minimum(nearest[first[between]], nearest[second[between]]) >= 0]
    ends = mesh.topology.edges[between]
    a, b = nearest[ends].T
    width = away[ends].sum(axis=1) + mesh.edge_lengths[between]
    faces = _is_apart(domain, a, b, domain.arc_of_point[b], width / domain.scale)
    faces &= width < 2 * np.maximum(wanted[a], wanted[b])
    for side in (a, b, *ends.T):
        np.minimum.at(limit, side[faces], CHANNEL * width[faces] / domain.scale)
    return limit


def _to_opposite_banks(domain: Domain) -> Floats:
    """Return CHANNEL times the distance of each point of the boundary to the side opposite it, (n_points,).

    In a channel one triangle wide edges run aslant from bank to bank: they are longer than it is wide.
    """
    limit = np.full(domain.n_points, np.inf)
    topology = domain.mesh.topology
    a, b = topology.outline.T
    tip = np.roll(topology.cells, 1, axis=1).ravel()[topology.outer_sides]  # of the corner before the side
    is_shore = domain.is_boundary[tip] & ~(domain.lines.is_junction[a] | domain.lines.is_junction[b])
    tip, a, b = tip[is_shore], a[is_shore], b[is_shore]
    bank, there = domain.points[b] - domain.points[a], domain.points[tip] - domain.points[a]
    share = np.clip((bank * there).sum(axis=1) / (bank**2).sum(axis=1), 0.0, 1.0)
    width = np.linalg.norm(there - share[:, None] * bank, axis=1)
    foot = domain.arc_of_point[a] + share * np.linalg.norm(bank, axis=1)
    faces = _is_apart(domain, tip, a, foot, width)
    np.minimum.at(limit, tip[faces], CHANNEL * width[faces])
    return limit


def _is_apart(domain: Domain, a: Ints, b: Ints, arc: Floats, width: Floats) -> Bools:
    """Return where points a and places on the curves of points b face each other over a channel, (n,).

    arc is where on its curve that place is, width the distance between them. They are on different loops,
    or far from each other along their own.
    """
    curve = domain.curve_of_point
    total = domain.curve_lengths[np.maximum(curve[b], 0)]
    along = np.abs(domain.arc_of_point[a] - arc)
    along = np.where(domain.lines.is_closed[np.maximum(curve[b], 0)], np.minimum(along, total - along), along)
    is_junction = domain.lines.is_junction[a] | domain.lines.is_junction[b]
    return np.asarray(((curve[a] != curve[b]) | (along > WINDING * width)) & ~is_junction)
