"""Writing rows inside a transaction: a triangle's corners, neighbours and curves, a vertex's triangle."""

from __future__ import annotations

from ...compiled import inner, whole
from ..kinds import NO_CURVE
from .fan import side_to
from .journal import keep_triangle, keep_vertex
from .state import TRIANGLE, State

FREE = whole(NO_CURVE)
"""Code of a side on no curve."""


@inner
def put_triangle(
    state: State, t: int, a: int, b: int, c: int, na: int, nb: int, nc: int, ca: int, cb: int, cc: int
) -> None:
    """Write corners, neighbours and curve codes of a triangle; its energy is refreshed apart."""
    keep_triangle(state, t)
    row = state.triangle
    row[t, 0], row[t, 1], row[t, 2] = a, b, c
    row[t, 3], row[t, 4], row[t, 5] = na, nb, nc
    row[t, 6], row[t, 7], row[t, 8] = ca, cb, cc


@inner
def relink(state: State, t: int, old: int, new: int) -> None:
    """Let triangle t (or nobody, -1) have neighbour new where it had old."""
    if t >= 0:
        keep_triangle(state, t)
        state.triangle[t, 3 + side_to(state, t, old)] = new


@inner
def anchor(state: State, v: int, t: int) -> None:
    """Let vertex v remember triangle t as one of its own."""
    if state.vertex[v, TRIANGLE] != t:
        keep_vertex(state, v)
        state.vertex[v, TRIANGLE] = t
