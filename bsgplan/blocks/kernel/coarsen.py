"""Remeshing towards the wanted size: split long edges, collapse short ones, flip, relax.

[Botsch & Kobbelt 2004, A Remeshing Approach to Multiresolution Modeling]. The mesh is valid all the time: a
step that would make a bad triangle is not taken.
"""

from __future__ import annotations

import numpy as np

from ...compiled import compiled, inner
from .collapse import collapse, kept_end
from .energy import is_upright, twice_area
from .fan import corner_of, fan_of
from .journal import begin, commit, rollback
from .shape import SHAPE
from .split import can_split, split
from .state import N_TRIANGLES, NEAR, OVERFLOW, State, U
from .sweeps import flip_all, relax_all

LONG, SHORT = 1.25, 0.68
"""Edges beyond these multiples of the wanted length are split and collapsed."""

LONGEST = 1.6
"""No collapse may make an edge longer than this many wanted lengths."""

WORST = 0.25
"""A collapse must leave triangles of this mean ratio or better (or of the least one before it)."""


def coarsen(state: State, n_rounds: int) -> None:
    """Remesh towards the wanted size."""
    for _ in range(n_rounds):
        n_changed = _split_long(state) + _collapse_short(state)
        flip_all(state)
        relax_all(state, 2)
        if n_changed == 0:
            break


@inner
def edge_length(state: State, a: int, b: int) -> float:
    """Return the length of an edge in wanted lengths."""
    dx, dy = state.point[b, 0] - state.point[a, 0], state.point[b, 1] - state.point[a, 1]
    return np.sqrt(dx * dx + dy * dy) * 0.5 * (np.exp(-state.value[a, U]) + np.exp(-state.value[b, U]))


@inner
def quality(state: State, t: int) -> float:
    """Return the mean ratio of a triangle, negative where inverted."""
    a, b, c = state.triangle[t, 0], state.triangle[t, 1], state.triangle[t, 2]
    squares = 0.0
    for v, w in ((a, b), (b, c), (c, a)):
        squares += (state.point[v, 0] - state.point[w, 0]) ** 2 + (state.point[v, 1] - state.point[w, 1]) ** 2
    return twice_area(state, t) / (SHAPE * squares)


@compiled
def _split_long(state: State) -> int:
    n_changed = 0
    for t in range(state.counter[N_TRIANGLES]):
        for side in range(3):
            if state.triangle[t, 0] < 0:
                continue
            a, b = state.triangle[t, (side + 1) % 3], state.triangle[t, (side + 2) % 3]
            if edge_length(state, a, b) <= LONG or not can_split(state, t, side):
                continue
            begin(state)
            m = split(state, t, side)
            if m >= 0 and state.counter[OVERFLOW] == 0 and _is_sound(state, m, 0.0, 1e9):
                commit(state)
                n_changed += 1
            else:
                rollback(state)
    return n_changed


@compiled
def _collapse_short(state: State) -> int:
    n_changed = 0
    for t in range(state.counter[N_TRIANGLES]):
        for side in range(3):
            if state.triangle[t, 0] < 0:
                continue
            a, b = state.triangle[t, (side + 1) % 3], state.triangle[t, (side + 2) % 3]
            if edge_length(state, a, b) >= SHORT:
                continue
            keep = kept_end(state, t, side)
            if keep < 0:
                continue
            least = min(_least_quality(state, a), _least_quality(state, b))
            begin(state)
            is_done = collapse(state, t, side, keep)
            if (
                is_done
                and state.counter[OVERFLOW] == 0
                and _is_sound(state, keep, min(WORST, least), LONGEST)
            ):
                commit(state)
                n_changed += 1
            else:
                rollback(state)
    return n_changed


@inner
def _least_quality(state: State, v: int) -> float:
    n, _ = fan_of(state, v, NEAR)
    least = 1.0
    for i in range(n):
        least = min(least, quality(state, state.fan[NEAR, i]))
    return least


@inner
def _is_sound(state: State, v: int, worst: float, longest: float) -> bool:
    n, _ = fan_of(state, v, NEAR)
    for i in range(n):
        t = state.fan[NEAR, i]
        k = corner_of(state, t, v)
        if not is_upright(state, t) or quality(state, t) < worst:
            return False
        if edge_length(state, v, state.triangle[t, (k + 1) % 3]) > longest:
            return False
    return n > 0
