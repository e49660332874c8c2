"""Passes over the whole mesh: energies from scratch, relaxation of every vertex, flips that pay."""

from __future__ import annotations

import numpy as np

from ...compiled import compiled, inner
from ..kinds import CORNER, SLIDING
from .energy import is_upright, triangle_energy, valence_energy
from .flip import can_flip, flip
from .journal import begin, commit, rollback
from .relax import relax_vertex
from .size_at import grid_goal_on_curve, look_up
from .state import (
    CURVE,
    DELTA,
    ENERGY,
    GOAL,
    GRID_GOAL,
    KIND,
    N_TRIANGLES,
    N_VERTICES,
    OVERFLOW,
    TRIANGLE,
    VALENCE,
    State,
)

GAIN = 1e-9
"""A flip must lower the energy by more than this."""


@compiled
def prepare(state: State) -> None:
    """Set anchors, valences, sizes and energies of all rows from corners, neighbours and places."""
    for v in range(state.counter[N_VERTICES]):
        state.vertex[v, TRIANGLE] = -1
        state.vertex[v, VALENCE] = 0
    for t in range(state.counter[N_TRIANGLES]):
        if state.triangle[t, 0] < 0:
            continue
        for i in range(3):
            v = state.triangle[t, i]
            state.vertex[v, TRIANGLE] = t
            state.vertex[v, VALENCE] += 1
            if state.triangle[t, 3 + (i + 2) % 3] < 0:  # the boundary edge that leaves v
                state.vertex[v, VALENCE] += 1
    for v in range(state.counter[N_VERTICES]):
        if state.vertex[v, TRIANGLE] >= 0:
            look_up(state, v)
    _fit_goals(state)
    renew(state)


@inner
def _fit_goals(state: State) -> None:
    """Give the vertices on the boundary the valences that suit their angles: a triangle for 60 degrees."""
    for v in range(state.counter[N_VERTICES]):
        if _is_fitted(state, v):
            state.value[v, GOAL] = 0.0
    for t in range(state.counter[N_TRIANGLES]):
        if state.triangle[t, 0] < 0:
            continue
        for i in range(3):
            v = state.triangle[t, i]
            if _is_fitted(state, v):
                state.value[v, GOAL] += _angle(
                    state, v, state.triangle[t, (i + 1) % 3], state.triangle[t, (i + 2) % 3]
                )
    for v in range(state.counter[N_VERTICES]):
        if _is_fitted(state, v):
            fitting = 1.0 + state.value[v, GOAL] / (np.pi / 3.0)
            state.value[v, GOAL] = max(3.0, np.rint(fitting)) if state.vertex[v, KIND] == SLIDING else fitting
        if state.vertex[v, TRIANGLE] >= 0:
            slides = state.vertex[v, KIND] == SLIDING
            state.value[v, GRID_GOAL] = grid_goal_on_curve(state, v) if slides else state.value[v, GOAL]


@inner
def _is_fitted(state: State, v: int) -> bool:
    """Return True for vertices that slide on the boundary and its corners, False on interfaces and inside."""
    kind = state.vertex[v, KIND]
    if state.vertex[v, TRIANGLE] < 0 or (kind != SLIDING and kind != CORNER):
        return False
    c = state.vertex[v, CURVE]
    return c >= 0 and state.curve[c, 3] == 0


@inner
def _angle(state: State, v: int, a: int, b: int) -> float:
    """Return the angle at v from a to b, radians, negative where clockwise."""
    ux, uy = state.point[a, 0] - state.point[v, 0], state.point[a, 1] - state.point[v, 1]
    vx, vy = state.point[b, 0] - state.point[v, 0], state.point[b, 1] - state.point[v, 1]
    return np.arctan2(ux * vy - uy * vx, ux * vx + uy * vy)


@compiled
def renew(state: State) -> float:
    """Set all energies from scratch and return their sum: what guards against drift."""
    total = 0.0
    for v in range(state.counter[N_VERTICES]):
        if state.vertex[v, TRIANGLE] >= 0:
            state.value[v, ENERGY] = valence_energy(state, v)
            total += state.value[v, ENERGY]
    for t in range(state.counter[N_TRIANGLES]):
        if state.triangle[t, 0] >= 0:
            state.energy[t] = triangle_energy(state, t)
            total += state.energy[t]
    begin(state)
    return total


@compiled
def relax_all(state: State, n_sweeps: int) -> None:
    """Relax every vertex, n_sweeps times."""
    for _ in range(n_sweeps):
        for v in range(state.counter[N_VERTICES]):
            if state.vertex[v, TRIANGLE] >= 0:
                begin(state)
                relax_vertex(state, v)
                commit(state)


@compiled
def flip_all(state: State) -> int:
    """Flip every edge whose flip lowers the energy; return how many."""
    n_flipped = 0
    for t in range(state.counter[N_TRIANGLES]):
        for side in range(3):
            if state.triangle[t, 0] < 0 or not can_flip(state, t, side):
                continue
            begin(state)
            other = flip(state, t, side)
            is_better = state.scalar[DELTA] < -GAIN and state.counter[OVERFLOW] == 0
            if is_better and is_upright(state, t) and is_upright(state, other):
                commit(state)
                n_flipped += 1
            else:
                rollback(state)
    return n_flipped
