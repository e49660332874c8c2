"""Between the noun PlacedMesh and the state that kernels change."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from ..domain import Domain
from ..placed import PlacedMesh
from ..weights import BLOCKS, Weights
from .state import (
    ARC,
    BEND,
    CURVE,
    GOAL,
    HINT,
    KIND,
    N_TRIANGLES,
    N_VERTICES,
    OF_GRID,
    OFFSET,
    POWER,
    QUALITY,
    SIZE,
    TRIANGLE,
    VALENCES,
    State,
    new_state,
)
from .sweeps import prepare


def load(
    domain: Domain,
    mesh: PlacedMesh,
    log_size: Floats,
    *,
    room: float = 2.0,
    seed: int = 0,
    weights: Weights = BLOCKS,
    offset: float = 0.0,
) -> State:
    """Return the state of a mesh on a domain whose wanted edge length has that log at its points."""
    n = len(mesh.points)
    vertices = np.column_stack([np.full(n, -1), np.zeros(n, np.int64), mesh.kinds, mesh.curves, mesh.hints])
    rows = np.column_stack([mesh.triangles, mesh.neighbours, mesh.codes])
    state = new_state(
        domain, log_size, mesh.points, rows, vertices, mesh.arcs, mesh.goals, room=room, seed=seed
    )
    state.scalar[OFFSET], state.scalar[POWER] = offset, 1.0
    state.scalar[QUALITY], state.scalar[SIZE], state.scalar[BEND] = 1.0, weights.size, weights.bend
    state.scalar[VALENCES], state.scalar[OF_GRID] = weights.valence, weights.of_grid
    prepare(state)
    return state


def unload(state: State) -> PlacedMesh:
    """Return the mesh of a state, without its free rows."""
    n_vertices, n_triangles = state.counter[N_VERTICES], state.counter[N_TRIANGLES]
    vertex, value = state.vertex[:n_vertices], state.value[:n_vertices]
    is_used = vertex[:, TRIANGLE] >= 0
    new_index = np.cumsum(is_used) - 1
    rows = state.triangle[:n_triangles]
    rows = rows[rows[:, 0] >= 0]
    return PlacedMesh(
        points=state.point[:n_vertices][is_used].copy(),
        triangles=new_index[rows[:, :3]],
        codes=rows[:, 6:9].copy(),
        kinds=vertex[is_used, KIND].copy(),
        curves=vertex[is_used, CURVE].copy(),
        arcs=value[is_used, ARC].copy(),
        goals=value[is_used, GOAL].copy(),
        hints=vertex[is_used, HINT].copy(),
    )
