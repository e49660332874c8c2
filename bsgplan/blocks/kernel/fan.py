"""The triangles round a vertex, gathered in order."""

from __future__ import annotations

from ...compiled import inner
from .state import COMMON, FAN, JOINED, SPARE, TRIANGLE, State


@inner
def corner_of(state: State, t: int, v: int) -> int:
    """Return which corner of triangle t vertex v is."""
    if state.triangle[t, 0] == v:
        return 0
    return 1 if state.triangle[t, 1] == v else 2


@inner
def side_to(state: State, t: int, neighbour: int) -> int:
    """Return the side of triangle t beyond which a neighbour lies."""
    if state.triangle[t, 3] == neighbour:
        return 0
    return 1 if state.triangle[t, 4] == neighbour else 2


@inner
def fan_of(state: State, v: int, row: int) -> tuple[int, bool]:
    """Gather the triangles at v into state.fan[row], counter-clockwise; return how many, and if they close.

    An open fan begins at the boundary. Returns 0 where there are more than FAN.
    """
    fan = state.fan
    start = state.vertex[v, TRIANGLE]
    t, n, is_closed = start, 0, False
    while True:
        if n == FAN:
            return 0, False
        fan[row, n] = t
        n += 1
        t = state.triangle[t, 3 + (corner_of(state, t, v) + 1) % 3]
        if t == start:
            is_closed = True
            break
        if t < 0:
            break
    if is_closed:
        return n, True
    back = 0
    t = start
    while True:
        t = state.triangle[t, 3 + (corner_of(state, t, v) + 2) % 3]
        if t < 0:
            break
        if n + back == FAN:
            return 0, False
        fan[row, n + back] = t
        back += 1
    if back:
        for i in range(back):
            fan[SPARE, i] = fan[row, n + back - 1 - i]
        for i in range(n - 1, -1, -1):
            fan[row, back + i] = fan[row, i]
        for i in range(back):
            fan[row, i] = fan[SPARE, i]
    return n + back, False


@inner
def are_joined(state: State, a: int, b: int) -> bool:
    """Return True where an edge joins vertices a and b."""
    n, _ = fan_of(state, a, JOINED)
    for i in range(n):
        t = state.fan[JOINED, i]
        if state.triangle[t, 0] == b or state.triangle[t, 1] == b or state.triangle[t, 2] == b:
            return True
    return n == 0


@inner
def n_common(state: State, a: int, b: int) -> int:
    """Return the number of vertices joined to both a and b."""
    n, is_closed = fan_of(state, a, COMMON)
    common = 0
    for i in range(n):
        t = state.fan[COMMON, i]
        ahead = state.triangle[t, (corner_of(state, t, a) + 1) % 3]
        if ahead != b and are_joined(state, b, ahead):
            common += 1
    if not is_closed and n:
        t = state.fan[COMMON, n - 1]
        last = state.triangle[t, (corner_of(state, t, a) + 2) % 3]
        if last != b and are_joined(state, b, last):
            common += 1
    return common
