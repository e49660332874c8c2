"""The wanted size at a point: a walk over the domain's triangulation, or along a curve."""

from __future__ import annotations

import numpy as np

from ...compiled import inner
from ..kinds import SLIDING
from .state import ARC, CURVE, HINT, KIND, OFFSET, PARTS, State, U, W
from .walk import walk


@inner
def look_up(state: State, v: int) -> None:
    """Set u, w (and the hint) of a vertex for the place where it is; fixed vertices keep their u."""
    if state.vertex[v, KIND] == SLIDING:
        place_on_curve(state, v, state.vertex[v, CURVE], state.value[v, ARC])
        return
    u, hint = size_at(state, state.point[v, 0], state.point[v, 1], state.vertex[v, HINT])
    state.vertex[v, HINT] = hint
    state.value[v, U] = u + state.scalar[OFFSET]
    state.value[v, W] = np.exp(-2.0 * state.value[v, U])


@inner
def place_on_curve(state: State, v: int, c: int, arc: float) -> None:
    """Put a vertex on curve c at an arc length; sets point, arc, u, w and hint."""
    arc, k, share = polyline_place(state, c, arc)
    a, b = state.curve_point[k], state.curve_point[k + 1]
    state.point[v, 0] = a[0] + share * (b[0] - a[0])
    state.point[v, 1] = a[1] + share * (b[1] - a[1])
    state.value[v, ARC] = arc
    state.value[v, U] = a[3] + share * (b[3] - a[3]) + state.scalar[OFFSET]
    state.value[v, W] = np.exp(-2.0 * state.value[v, U])
    state.vertex[v, HINT] = state.curve_triangle[k]


@inner
def goal_on_curve(state: State, v: int) -> float:
    """Return the valence that suits a sliding vertex where it is."""
    _, k, share = polyline_place(state, state.vertex[v, CURVE], state.value[v, ARC])
    return state.curve_point[k + 1 if share > 0.5 else k, 4]


@inner
def grid_goal_on_curve(state: State, v: int) -> float:
    """Return the valence that suits a sliding vertex in the grid: for the angle of its two sides there."""
    c, arc = state.vertex[v, CURVE], state.value[v, ARC]
    if state.curve[c, 3] == 1:
        return 6.0
    step = np.exp(state.value[v, U] - state.scalar[OFFSET]) / PARTS
    ax, ay = _chord(state, v, c, arc - step)
    bx, by = _chord(state, v, c, arc + step)
    turn = np.arctan2(bx * ay - by * ax, -(ax * bx + ay * by))
    return max(3.0, np.rint(4.0 - turn / (np.pi / 3.0)))


@inner
def _chord(state: State, v: int, c: int, arc: float) -> tuple[float, float]:
    _, k, share = polyline_place(state, c, arc)
    a, b = state.curve_point[k], state.curve_point[k + 1]
    x, y = a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])
    return x - state.point[v, 0], y - state.point[v, 1]


@inner
def polyline_place(state: State, c: int, arc: float) -> tuple[float, int, float]:
    """Return arc (within the curve), the segment it lies on, and where on that segment, 0 to 1."""
    first, stop = state.curve[c, 0], state.curve[c, 1]
    length = state.curve_point[stop - 1, 2]
    if state.curve[c, 2] == 1:
        while arc >= length:
            arc -= length
        while arc < 0.0:
            arc += length
    else:
        arc = min(max(arc, 0.0), length)
    low, high = first, stop - 1
    while high - low > 1:
        middle = (low + high) // 2
        if state.curve_point[middle, 2] <= arc:
            low = middle
        else:
            high = middle
    start, end = state.curve_point[low, 2], state.curve_point[low + 1, 2]
    share = (arc - start) / (end - start) if end > start else 0.0
    return arc, low, min(max(share, 0.0), 1.0)


@inner
def size_at(state: State, x: float, y: float, hint: int) -> tuple[float, int]:
    """Return log of the wanted size and the triangle near (x, y)."""
    t, la, lb, lc = walk(state.map_point, state.map_triangle, x, y, hint)
    corners = state.map_triangle
    u = state.map_u
    return la * u[corners[t, 0]] + lb * u[corners[t, 1]] + lc * u[corners[t, 2]], t
