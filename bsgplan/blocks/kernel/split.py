"""The split of an edge: a new vertex at its middle, each triangle beside it cut in two."""

from __future__ import annotations

from ...compiled import inner
from ..kinds import FROZEN_SIDE, INTERIOR, SLIDING
from .bend import side_arcs
from .energy import refresh_triangle, set_valence
from .fan import side_to
from .flip import MOST
from .journal import keep_vertex, take_triangle, take_vertex
from .rows import FREE, anchor, put_triangle, relink
from .size_at import goal_on_curve, grid_goal_on_curve, look_up
from .state import ARC, CURVE, ENERGY, GOAL, GRID_GOAL, HINT, KIND, TRIANGLE, VALENCE, State


@inner
def can_split(state: State, t: int, side: int) -> bool:
    """Return True where the edge is not frozen and the vertices opposite it may get one more edge."""
    if state.triangle[t, 6 + side] == FROZEN_SIDE:
        return False
    if state.vertex[state.triangle[t, side], VALENCE] >= MOST:
        return False
    n = state.triangle[t, 3 + side]
    return n < 0 or state.vertex[state.triangle[n, side_to(state, n, t)], VALENCE] < MOST


@inner
def split(state: State, t: int, side: int) -> int:
    """Split the edge at that side, inside a transaction; return the new vertex, -1 on overflow.

    t = (a, b, c) becomes (a, b, m) and (a, m, c); its neighbour (d, c, b) becomes (d, m, b) and (d, c, m).
    """
    row = state.triangle
    a, b, c = row[t, side], row[t, (side + 1) % 3], row[t, (side + 2) % 3]
    n, code = row[t, 3 + side], row[t, 6 + side]
    m, t2 = take_vertex(state), take_triangle(state)
    n2 = take_triangle(state) if n >= 0 else -1
    if m < 0 or t2 < 0 or (n >= 0 and n2 < 0):
        return -1
    _place(state, m, t, side, b, c, code)
    t_b, k_b = row[t, 3 + (side + 1) % 3], row[t, 6 + (side + 1) % 3]
    t_c, k_c = row[t, 3 + (side + 2) % 3], row[t, 6 + (side + 2) % 3]
    if n >= 0:
        back = side_to(state, n, t)
        d, reverse = row[n, back], row[n, 6 + back]
        n_c, l_c = row[n, 3 + (back + 1) % 3], row[n, 6 + (back + 1) % 3]
        n_b, l_b = row[n, 3 + (back + 2) % 3], row[n, 6 + (back + 2) % 3]
        put_triangle(state, n, d, m, b, t, n_c, n2, reverse, l_c, FREE)
        put_triangle(state, n2, d, c, m, t2, n, n_b, reverse, FREE, l_b)
        relink(state, n_b, n, n2)
        set_valence(state, d, state.vertex[d, VALENCE] + 1)
        anchor(state, d, n)
    put_triangle(state, t, a, b, m, n, t2, t_c, code, FREE, k_c)
    put_triangle(state, t2, a, m, c, n2, t_b, t, code, k_b, FREE)
    relink(state, t_b, t, t2)
    anchor(state, a, t)
    anchor(state, b, t)
    anchor(state, c, t2)
    anchor(state, m, t)
    set_valence(state, a, state.vertex[a, VALENCE] + 1)
    set_valence(state, m, 4 if n >= 0 else 3)
    refresh_triangle(state, t)
    refresh_triangle(state, t2)
    if n >= 0:
        refresh_triangle(state, n)
        refresh_triangle(state, n2)
    return m


@inner
def _place(state: State, m: int, t: int, side: int, b: int, c: int, code: int) -> None:
    keep_vertex(state, m)
    state.value[m, ENERGY] = 0.0
    state.vertex[m, TRIANGLE] = t
    state.vertex[m, HINT] = state.vertex[b, HINT]
    if code < 0:
        state.vertex[m, KIND], state.vertex[m, CURVE] = INTERIOR, -1
        state.value[m, ARC], state.value[m, GOAL] = 0.0, 6.0
        state.point[m, 0] = 0.5 * (state.point[b, 0] + state.point[c, 0])
        state.point[m, 1] = 0.5 * (state.point[b, 1] + state.point[c, 1])
    else:
        curve, start, end = side_arcs(state, t, side)
        state.vertex[m, KIND], state.vertex[m, CURVE] = SLIDING, curve
        state.value[m, ARC] = 0.5 * (start + end)
    look_up(state, m)
    if code >= 0:
        state.value[m, GOAL] = goal_on_curve(state, m)
        state.value[m, GRID_GOAL] = grid_goal_on_curve(state, m)
