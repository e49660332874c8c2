"""Transactions: every row is written down before it changes, so any composite move can be taken back.

`keep_vertex` and `keep_triangle` come before each write; `commit` frees the rows that a move gave up,
`rollback` replays the journal backwards. On overflow the move must be rolled back by the caller.
"""

from __future__ import annotations

from ...arrays import Ints
from ...compiled import inner, whole
from .state import (
    DELTA,
    DELTA_VALENCES,
    LOG_ROWS,
    N_FREE_TRIANGLES,
    N_FREE_VERTICES,
    N_FREED,
    N_LOG,
    N_TAKEN,
    N_TRIANGLES,
    N_VERTICES,
    OVERFLOW,
    TRIANGLE,
    State,
)

VERTEX_ROW, TRIANGLE_ROW = whole(0), whole(1)
"""What a row is of."""


@inner
def begin(state: State) -> None:
    """Begin a transaction."""
    state.counter[N_LOG] = 0
    state.counter[N_TAKEN] = 0
    state.counter[N_FREED] = 0
    state.counter[OVERFLOW] = 0
    state.scalar[DELTA] = 0.0
    state.scalar[DELTA_VALENCES] = 0.0


@inner
def keep_vertex(state: State, v: int) -> None:
    """Write the row of a vertex down."""
    k = state.counter[N_LOG]
    if k >= LOG_ROWS:
        state.counter[OVERFLOW] = 1
        return
    whole, real = state.log_int[k], state.log_float[k]
    whole[0], whole[1] = 0, v
    for i in range(5):
        whole[2 + i] = state.vertex[v, i]
    for i in range(6):
        real[2 + i] = state.value[v, i]
    real[0], real[1] = state.point[v, 0], state.point[v, 1]
    state.counter[N_LOG] = k + 1


@inner
def keep_triangle(state: State, t: int) -> None:
    """Write the row of a triangle down."""
    k = state.counter[N_LOG]
    if k >= LOG_ROWS:
        state.counter[OVERFLOW] = 1
        return
    whole = state.log_int[k]
    whole[0], whole[1] = 1, t
    for i in range(9):
        whole[2 + i] = state.triangle[t, i]
    state.log_float[k, 0] = state.energy[t]
    state.counter[N_LOG] = k + 1


@inner
def rollback(state: State) -> None:
    """Undo the transaction."""
    for k in range(state.counter[N_LOG] - 1, -1, -1):
        whole, real = state.log_int[k], state.log_float[k]
        row = whole[1]
        if whole[0] == 0:
            for i in range(5):
                state.vertex[row, i] = whole[2 + i]
            for i in range(6):
                state.value[row, i] = real[2 + i]
            state.point[row, 0], state.point[row, 1] = real[0], real[1]
        else:
            for i in range(9):
                state.triangle[row, i] = whole[2 + i]
            state.energy[row] = real[0]
    for k in range(state.counter[N_TAKEN] - 1, -1, -1):
        _release(state, state.taken[k, 0], state.taken[k, 1])
    begin(state)


@inner
def commit(state: State) -> None:
    """Make the transaction final: the rows given up become free."""
    for k in range(state.counter[N_FREED]):
        _release(state, state.freed[k, 0], state.freed[k, 1])
    begin(state)


@inner
def take_vertex(state: State) -> int:
    """Return a free vertex row, -1 (and overflow) where there is none."""
    counter = state.counter
    if counter[N_FREE_VERTICES] > 0:
        counter[N_FREE_VERTICES] -= 1
        v = state.free_vertex[counter[N_FREE_VERTICES]]
    elif counter[N_VERTICES] < len(state.point):
        v = counter[N_VERTICES]
        counter[N_VERTICES] += 1
        state.vertex[v, TRIANGLE] = -1
    else:
        counter[OVERFLOW] = 1
        return -1
    _list(state, state.taken, N_TAKEN, VERTEX_ROW, v)
    return v


@inner
def take_triangle(state: State) -> int:
    """Return a free triangle row, -1 (and overflow) where there is none."""
    counter = state.counter
    if counter[N_FREE_TRIANGLES] > 0:
        counter[N_FREE_TRIANGLES] -= 1
        t = state.free_triangle[counter[N_FREE_TRIANGLES]]
    elif counter[N_TRIANGLES] < len(state.energy):
        t = counter[N_TRIANGLES]
        counter[N_TRIANGLES] += 1
        state.triangle[t, 0] = -1
        state.energy[t] = 0.0
    else:
        counter[OVERFLOW] = 1
        return -1
    _list(state, state.taken, N_TAKEN, TRIANGLE_ROW, t)
    return t


@inner
def give_up(state: State, what: int, row: int) -> None:
    """Note a row (VERTEX_ROW or TRIANGLE_ROW) that becomes free if the transaction is committed."""
    _list(state, state.freed, N_FREED, what, row)


@inner
def _list(state: State, rows: Ints, counted: int, what: int, row: int) -> None:
    """Put a row on a list of the transaction whose length is counter[counted]."""
    k = state.counter[counted]
    if k >= LOG_ROWS:
        state.counter[OVERFLOW] = 1
        return
    rows[k, 0], rows[k, 1] = what, row
    state.counter[counted] = k + 1


@inner
def _release(state: State, what: int, row: int) -> None:
    counter = state.counter
    if what == 0:
        state.vertex[row, TRIANGLE] = -1
        state.free_vertex[counter[N_FREE_VERTICES]] = row
        counter[N_FREE_VERTICES] += 1
    else:
        state.triangle[row, 0] = -1
        state.energy[row] = 0.0
        state.free_triangle[counter[N_FREE_TRIANGLES]] = row
        counter[N_FREE_TRIANGLES] += 1
