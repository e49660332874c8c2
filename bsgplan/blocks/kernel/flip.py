"""The flip of an edge: the other diagonal of its two triangles."""

from __future__ import annotations

from ...compiled import inner
from ..kinds import CORNER, INTERIOR, NO_CURVE
from .energy import refresh_triangle, set_valence, valence_cost
from .fan import are_joined, side_to
from .rows import FREE, anchor, put_triangle, relink
from .state import KIND, VALENCE, State

MOST = 11
"""No vertex gets more edges than this."""


@inner
def least_valence(state: State, v: int) -> int:
    """Return the fewest edges that a vertex may have: 4 inside, 3 on a curve, 2 where it is fixed."""
    kind = state.vertex[v, KIND]
    if kind == INTERIOR:
        return 4
    return 2 if kind >= CORNER else 3


@inner
def can_flip(state: State, t: int, side: int) -> bool:
    """Return True where the edge has two triangles, lies on no curve and its ends may lose it."""
    other = state.triangle[t, 3 + side]
    if other < 0 or state.triangle[t, 6 + side] != NO_CURVE:
        return False
    b, c = state.triangle[t, (side + 1) % 3], state.triangle[t, (side + 2) % 3]
    if state.vertex[b, VALENCE] <= least_valence(state, b) or state.vertex[c, VALENCE] <= least_valence(
        state, c
    ):
        return False
    a = state.triangle[t, side]
    d = state.triangle[other, side_to(state, other, t)]
    if state.vertex[a, VALENCE] >= MOST or state.vertex[d, VALENCE] >= MOST:
        return False
    return not are_joined(state, a, d)


@inner
def flip_gain(state: State, t: int, side: int) -> float:
    """Return by how much a flip lowers the costs of the four valences, before weighting."""
    other = state.triangle[t, 3 + side]
    a, d = state.triangle[t, side], state.triangle[other, side_to(state, other, t)]
    b, c = state.triangle[t, (side + 1) % 3], state.triangle[t, (side + 2) % 3]
    return _change(state, a, 1) + _change(state, d, 1) + _change(state, b, -1) + _change(state, c, -1)


@inner
def _change(state: State, v: int, by: int) -> float:
    valence = state.vertex[v, VALENCE]
    return valence_cost(state, v, valence) - valence_cost(state, v, valence + by)


@inner
def flip(state: State, t: int, side: int) -> int:
    """Flip the edge at that side, inside a transaction; return the other triangle.

    t = (a, b, c) and (d, c, b) become t = (a, b, d) and (a, d, c).
    """
    row = state.triangle
    n = row[t, 3 + side]
    back = side_to(state, n, t)
    a, b, c = row[t, side], row[t, (side + 1) % 3], row[t, (side + 2) % 3]
    d = row[n, back]
    t_b, t_c = row[t, 3 + (side + 1) % 3], row[t, 3 + (side + 2) % 3]  # opposite b, opposite c
    k_b, k_c = row[t, 6 + (side + 1) % 3], row[t, 6 + (side + 2) % 3]
    n_c, n_b = row[n, 3 + (back + 1) % 3], row[n, 3 + (back + 2) % 3]  # opposite c, opposite b
    l_c, l_b = row[n, 6 + (back + 1) % 3], row[n, 6 + (back + 2) % 3]
    # t keeps side ab (opposite c in the old t) and gets bd (opposite c in the old n)
    put_triangle(state, t, a, b, d, n_c, n, t_c, l_c, FREE, k_c)
    put_triangle(state, n, a, d, c, n_b, t_b, t, l_b, k_b, FREE)
    relink(state, n_c, n, t)
    relink(state, t_b, t, n)
    anchor(state, b, t)
    anchor(state, c, n)
    anchor(state, a, t)
    anchor(state, d, t)
    set_valence(state, a, state.vertex[a, VALENCE] + 1)
    set_valence(state, d, state.vertex[d, VALENCE] + 1)
    set_valence(state, b, state.vertex[b, VALENCE] - 1)
    set_valence(state, c, state.vertex[c, VALENCE] - 1)
    refresh_triangle(state, t)
    refresh_triangle(state, n)
    return n
