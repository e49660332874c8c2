"""Corners of curves, found over a window: where a curve really turns, not where it is merely rough."""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Ints
from .domain import Domain

SHARP = np.radians(50.0)
"""A curve that turns by more than this over the window has a corner."""

WINDOW = 0.5
"""Half-width of the window in wanted block edges."""

SPACING = 1.5
"""A corner silences others within this many windows: corners closer than a block force short edges."""

LOOP_SHARE = 1 / 6
"""The window is at most this share of a curve's length."""


def find_corners(domain: Domain, size: Floats) -> tuple[Bools, Floats]:
    """Return which points are corners, (n_points,), and by how much the curve turns left there, radians.

    size is the wanted block edge at each point, (n_points,), in the domain's unit. Tangents are means of
    chords over the window and half of it; the sharpest corner silences others within its window. The ends
    of curves are junctions, not corners.
    """
    is_corner = domain.is_kept & (domain.curve_of_point >= 0)
    turning = np.zeros(domain.n_points)
    arcs, points = domain.curve_points[:, 2], domain.curve_points[:, :2]
    for c, (first, stop, is_closed, _) in enumerate(domain.curves):
        nodes = domain.curve_nodes[first:stop]
        length = domain.curve_lengths[c]
        own = slice(0, -1) if is_closed else slice(1, -1)
        window = np.minimum(WINDOW * size[nodes], LOOP_SHARE * length)[own]
        turn = _turning(arcs[first:stop], points[first:stop], bool(is_closed), window, own)
        turning[nodes[own]] = turn
        kept = _sharpest(arcs[first:stop][own], np.abs(turn), window, length if is_closed else np.inf)
        is_corner[nodes[own][kept]] = True
    is_corner &= ~domain.lines.is_junction
    return is_corner, turning


def boundary_goals(domain: Domain, size: Floats) -> Floats:
    """Return the number of edges that suits a block vertex at each row of the curves, (k,).

    On the boundary 1 + the angle of the domain over 60 degrees, rounded, the angle being that of two edges
    of the wanted size, (n_points,), which end there; 6 on an interface.
    """
    goals = np.full(len(domain.curve_nodes), 6.0)
    arcs, points = domain.curve_points[:, 2], domain.curve_points[:, :2]
    for c, (first, stop, is_closed, is_inside) in enumerate(domain.curves):
        if is_inside:
            continue
        own = slice(0, -1) if is_closed else slice(1, -1)
        window = np.minimum(size[domain.curve_nodes[first:stop]], domain.curve_lengths[c] / 3)[own]
        turn = np.zeros(stop - first)
        turn[own] = _turning(arcs[first:stop], points[first:stop], bool(is_closed), window, own, (1.0,))
        if is_closed:
            turn[-1] = turn[0]
        goals[first:stop] = np.maximum(3.0, np.rint(4.0 - turn / (np.pi / 3)))
    return goals


def _turning(
    arc: Floats,
    points: Floats,
    is_closed: bool,
    window: Floats,
    own: slice,
    shares: tuple[float, ...] = (1.0, 0.5),
) -> Floats:
    """Return how much a curve turns left at its own nodes: between means of chords before and after."""
    if is_closed:
        length = arc[-1]
        arc_round = np.concatenate([arc[:-1] - length, arc[:-1], arc + length])
        round_points = np.concatenate([points[:-1], points[:-1], points])
    else:
        arc_round, round_points = arc, points

    def at(where: Floats) -> Floats:
        return np.column_stack([np.interp(where, arc_round, round_points[:, i]) for i in range(2)])

    here, place = points[own], arc[own]

    def tangent(sign: int) -> Floats:
        total = np.zeros_like(here)
        for share in shares:
            chord = sign * (at(place + sign * share * window) - here)
            total += chord / np.maximum(np.linalg.norm(chord, axis=1), 1e-300)[:, None]
        return total

    before, after = tangent(-1), tangent(1)
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.asarray(np.arctan2(cross, (before * after).sum(axis=1)))


def _sharpest(arc: Floats, turn: Floats, window: Floats, period: float) -> Ints:
    """Return the nodes that turn sharply, each the sharpest within its window."""
    candidates = np.flatnonzero(turn > SHARP)
    kept: list[int] = []
    for i in candidates[np.argsort(-turn[candidates], kind="stable")]:
        if kept:
            gap = np.abs(arc[kept] - arc[i])
            if (np.minimum(gap, period - gap) < SPACING * window[kept]).any():
                continue
        kept.append(int(i))
    return np.array(sorted(kept), dtype=np.int64)
