"""Passes over the whole mesh: energies from scratch, relaxation of every vertex, flips that pay."""

from __future__ import annotations

from ..kinds import SLIDING
from .compiled import compiled
from .energy import is_upright, triangle_energy, valence_energy
from .flip import can_flip, flip
from .journal import begin, commit, rollback
from .relax import relax_vertex
from .size_at import goal_on_curve, look_up
from .state import DELTA, ENERGY, GOAL, KIND, N_TRIANGLES, N_VERTICES, OVERFLOW, TRIANGLE, VALENCE, State

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
            if state.vertex[v, KIND] == SLIDING:
                state.value[v, GOAL] = goal_on_curve(state, v)
    renew(state)


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
