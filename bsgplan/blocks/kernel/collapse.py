"""The collapse of an edge: its two ends become one vertex, its triangles vanish."""

from __future__ import annotations

from ...compiled import inner
from ..kinds import CORNER, INTERIOR, NO_CURVE, SLIDING
from .bend import side_arcs
from .energy import drop_valence, refresh_triangle, set_valence
from .fan import corner_of, fan_of, n_common, side_to
from .flip import MOST
from .journal import TRIANGLE_ROW, VERTEX_ROW, give_up, keep_triangle, keep_vertex
from .rows import anchor, relink
from .size_at import goal_on_curve, grid_goal_on_curve, look_up, place_on_curve
from .state import DELTA, GOAL, GONE, GRID_GOAL, KIND, VALENCE, State


@inner
def kept_end(state: State, t: int, side: int) -> int:
    """Return the end of the edge that stays: the fixed one, else the one on a curve, else the first.

    -1 where the collapse would break the domain: two fixed ends, two curves, the last edges of a loop,
    valences out of range, triangles that share both other sides.
    """
    row = state.triangle
    a, b, c = row[t, side], row[t, (side + 1) % 3], row[t, (side + 2) % 3]
    n, code = row[t, 3 + side], row[t, 6 + side]
    kind_b, kind_c = state.vertex[b, KIND], state.vertex[c, KIND]
    if kind_b >= CORNER and kind_c >= CORNER:
        return -1
    if code < 0 and kind_b != INTERIOR and kind_c != INTERIOR:
        return -1
    if code >= 0 and (kind_b == INTERIOR or kind_c == INTERIOR):
        return -1
    valence = state.vertex[b, VALENCE] + state.vertex[c, VALENCE] - (4 if n >= 0 else 3)
    if valence > MOST:
        return -1
    if not _may_lose(state, a) or not _sheds(state, t, side):
        return -1
    if n >= 0:
        back = side_to(state, n, t)
        if not _may_lose(state, row[n, back]) or not _sheds(state, n, back):
            return -1
    keep = c if kind_c > kind_b else b
    kind = state.vertex[keep, KIND]
    if valence < (4 if kind == INTERIOR else 3 if kind == SLIDING else 2):
        return -1
    if n_common(state, b, c) != (2 if n >= 0 else 1):
        return -1
    return keep


@inner
def _may_lose(state: State, v: int) -> bool:
    kind = state.vertex[v, KIND]
    return state.vertex[v, VALENCE] > (4 if kind == INTERIOR else 3 if kind == SLIDING else 2)


@inner
def _sheds(state: State, t: int, side: int) -> bool:
    """Return True where the two other sides can become one: a neighbour is left, curves do not meet."""
    first, second = (side + 1) % 3, (side + 2) % 3
    if state.triangle[t, 3 + first] < 0 and state.triangle[t, 3 + second] < 0:
        return False
    return state.triangle[t, 6 + first] == NO_CURVE or state.triangle[t, 6 + second] == NO_CURVE


@inner
def collapse(state: State, t: int, side: int, keep: int) -> bool:
    """Collapse the edge at that side into its end keep, inside a transaction; False where fans overflow.

    `kept_end` has said which end and that it may be done. The vertex comes to lie at the middle unless it
    is fixed or belongs to a curve that the other end does not.
    """
    row = state.triangle
    b, c = row[t, (side + 1) % 3], row[t, (side + 2) % 3]
    gone = c if keep == b else b
    n, code = row[t, 3 + side], row[t, 6 + side]
    valence = state.vertex[b, VALENCE] + state.vertex[c, VALENCE] - (4 if n >= 0 else 3)
    n_gone, _ = fan_of(state, gone, GONE)
    if n_gone == 0:
        return False
    _move(state, t, side, keep, gone, code)
    for i in range(n_gone):
        s = state.fan[GONE, i]
        if s != t and s != n:
            keep_triangle(state, s)
            row[s, corner_of(state, s, gone)] = keep
    _remove(state, t, side, keep)
    if n >= 0:
        _remove(state, n, side_to(state, n, t), keep)
    keep_vertex(state, gone)
    give_up(state, VERTEX_ROW, gone)
    drop_valence(state, gone)
    set_valence(state, keep, valence)
    m, _ = fan_of(state, keep, GONE)
    for i in range(m):
        refresh_triangle(state, state.fan[GONE, i])
    return m > 0


@inner
def _move(state: State, t: int, side: int, keep: int, gone: int, code: int) -> None:
    kind = state.vertex[keep, KIND]
    if kind == INTERIOR:
        keep_vertex(state, keep)
        state.point[keep, 0] = 0.5 * (state.point[keep, 0] + state.point[gone, 0])
        state.point[keep, 1] = 0.5 * (state.point[keep, 1] + state.point[gone, 1])
        look_up(state, keep)
    elif kind == SLIDING and code >= 0:
        curve, start, end = side_arcs(state, t, side)
        keep_vertex(state, keep)
        place_on_curve(state, keep, curve, 0.5 * (start + end))
        state.value[keep, GOAL] = goal_on_curve(state, keep)
        state.value[keep, GRID_GOAL] = grid_goal_on_curve(state, keep)


@inner
def _remove(state: State, t: int, side: int, keep: int) -> None:
    """Take triangle t out: the triangles beyond its two other sides become neighbours."""
    row = state.triangle
    a = row[t, side]
    first, second = (side + 1) % 3, (side + 2) % 3
    x, y = row[t, 3 + first], row[t, 3 + second]
    code_x, code_y = row[t, 6 + first], row[t, 6 + second]
    # the curve code of the merged side: as seen from the triangle that keeps it
    if x >= 0:
        if code_y != NO_CURVE:
            keep_triangle(state, x)
            row[x, 6 + side_to(state, x, t)] = code_y
        relink(state, x, t, y)
    if y >= 0:
        if code_x != NO_CURVE:
            keep_triangle(state, y)
            row[y, 6 + side_to(state, y, t)] = code_x
        relink(state, y, t, x)
    left = x if x >= 0 else y
    anchor(state, a, left)
    anchor(state, keep, left)
    set_valence(state, a, state.vertex[a, VALENCE] - 1)
    keep_triangle(state, t)
    state.scalar[DELTA] -= state.energy[t]
    state.energy[t] = 0.0
    row[t, 0] = -1
    give_up(state, TRIANGLE_ROW, t)
