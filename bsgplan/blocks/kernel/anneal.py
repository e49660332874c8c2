"""Simulated annealing of the topology: flip, split or collapse somewhere, relax there, accept or undo.

[Kirkpatrick, Gelatt & Vecchi 1983] with the acceptance of Metropolis. Every move is one transaction. Most
moves begin at an irregular vertex; a split or collapse is followed by flips that mend valences, so that a
move can glide a pair of irregular vertices or annihilate one.
"""

from __future__ import annotations

import numpy as np

from ...compiled import compiled, inner, whole
from ..kinds import CORNER, HALF_EDGE, NO_CURVE
from .chance import below, uniform
from .collapse import collapse, kept_end
from .energy import is_upright
from .fan import corner_of, fan_of, side_to
from .flip import can_flip, flip, flip_gain
from .journal import begin, commit, rollback
from .relax import relax_vertex
from .split import can_split, split
from .state import (
    DELTA,
    DELTA_VALENCES,
    FAN,
    GOAL,
    KIND,
    N_VERTICES,
    NEAR,
    OVERFLOW,
    STAMP,
    TEMPERATURE,
    TRIANGLE,
    VALENCE,
    State,
)

AT_IRREGULAR = 0.6
"""Share of the moves that begin in the star of an irregular vertex."""

BESIDE = 0.3
"""Share of those that begin one triangle further."""

FLIPS = 0.6
"""Share of the moves that are flips; the others are splits and collapses, half each."""

FOLLOW_UP = 0.3
"""Share of the flips with a second flip beside: the glide of a dislocation."""

MOST_MENDS = 4
"""A split or collapse is followed by 0 .. MOST_MENDS - 1 flips."""

NOISE = 0.9
"""Noise on the gain by which those flips are chosen."""

MARGIN = 1.0
"""A move so much over the acceptance after the first relaxation is given up."""

HOPELESS = 1.5
"""A move whose valences alone cost so much over the acceptance is given up before any relaxation."""

VERTICES = 4.0
"""A pass over the mesh makes one move for so many vertices, most of which are then where it found them."""

MOST_THERE = 8.0
"""The most moves that a pass begins at one irregular vertex: where few are left the others move anywhere."""

NONE = whole(-1)
"""No triangle, side or vertex."""

TOUCHED, RING = 0, 1
"""Rows of state.fan that hold the vertices touched and those round them."""


@compiled
def anneal(state: State, n_moves: int) -> int:
    """Make about n_moves moves at the state's temperature; return how many were accepted.

    They are made in passes over the vertices in the order of their rows: where rows that follow each other
    lie near each other, so do the moves, and what they touch is in the cache.
    """
    n_done, n_accepted = 0, 0
    while n_done < n_moves:
        n_vertices, n_irregular = _count(state)
        n_now = min(n_vertices / VERTICES, n_moves - n_done)
        there = min(AT_IRREGULAR * n_now / max(n_irregular, 1), MOST_THERE)
        anywhere = (n_now - there * n_irregular) / n_vertices
        for v in range(state.counter[N_VERTICES]):
            if state.vertex[v, TRIANGLE] >= 0 and uniform(state) < anywhere:
                n_accepted += _moved(state, v, 0.0)
                n_done += 1
            if not _is_found(state, v):
                continue
            for _ in range(int(there + uniform(state))):
                n_accepted += _moved(state, v, BESIDE)
                n_done += 1
                if not _is_found(state, v):
                    break
    return n_accepted


@inner
def _is_found(state: State, v: int) -> bool:
    return state.vertex[v, TRIANGLE] >= 0 and is_irregular(state, v)


@inner
def _count(state: State) -> tuple[int, int]:
    """Return the number of vertices and that of the irregular ones."""
    n_vertices, n_irregular = 0, 0
    for v in range(state.counter[N_VERTICES]):
        if state.vertex[v, TRIANGLE] >= 0:
            n_vertices += 1
            n_irregular += 1 if is_irregular(state, v) else 0
    return n_vertices, n_irregular


@inner
def _moved(state: State, v: int, beside: float) -> int:
    """Try one move in the star of a vertex, or with that chance one triangle beside it; return 1 if made."""
    m, _ = fan_of(state, v, NEAR)
    if m == 0:
        return 0
    t = state.fan[NEAR, below(state, m)]
    if uniform(state) < beside:
        across = state.triangle[t, 3 + below(state, 3)]
        t = across if across >= 0 else t
    side = below(state, 3)
    begin(state)
    n = _change(state, t, side)
    if n == 0 or state.counter[OVERFLOW] != 0:
        rollback(state)
        return 0
    bound = -state.scalar[TEMPERATURE] * np.log(1.0 - uniform(state))
    if state.scalar[DELTA_VALENCES] > bound + HOPELESS:
        rollback(state)
        return 0
    for i in range(n):
        relax_vertex(state, state.fan[TOUCHED, i])
    if state.scalar[DELTA] > bound + MARGIN or state.counter[OVERFLOW] != 0:
        rollback(state)
        return 0
    m = _ring(state, n)
    for i in range(m):
        relax_vertex(state, state.fan[RING, i])
    if state.scalar[DELTA] > bound or state.counter[OVERFLOW] != 0 or not _are_upright(state, n):
        rollback(state)
        return 0
    commit(state)
    return 1


@inner
def is_irregular(state: State, v: int) -> bool:
    """Return True where the valence of a vertex is off its goal, at a corner by more than half an edge."""
    off = abs(state.vertex[v, VALENCE] - state.value[v, GOAL])
    return off > (HALF_EDGE if state.vertex[v, KIND] >= CORNER else 0.0)


@inner
def _change(state: State, t: int, side: int) -> int:
    """Change the topology at an edge; return the number of vertices touched, 0 where it may not be."""
    state.counter[STAMP] += 1
    if uniform(state) < FLIPS:
        if not can_flip(state, t, side):
            return 0
        other = flip(state, t, side)
        n = _touch_pair(state, 0, t, other)
        n_mends = 1 if uniform(state) < FOLLOW_UP else 0
        return _mend(state, n, n_mends, state.triangle[t, 0], state.triangle[t, 2])
    if uniform(state) < 0.5:
        if not can_split(state, t, side):
            return 0
        b, c, a = (
            state.triangle[t, (side + 1) % 3],
            state.triangle[t, (side + 2) % 3],
            state.triangle[t, side],
        )
        m = split(state, t, side)
        if m < 0:
            return 0
        n = _touch(state, 0, m)
        n = _touch(state, n, a)
        n = _touch(state, n, b)
        n = _touch(state, n, c)
        return _mend(state, n, below(state, MOST_MENDS), NONE, NONE)
    keep = kept_end(state, t, side)
    if keep < 0:
        return 0
    a, other = state.triangle[t, side], state.triangle[t, 3 + side]
    d = -1 if other < 0 else state.triangle[other, side_to(state, other, t)]
    if not collapse(state, t, side, keep):
        return 0
    n = _touch(state, 0, keep)
    n = _touch(state, n, a)
    if d >= 0:
        n = _touch(state, n, d)
    return _mend(state, n, below(state, MOST_MENDS), NONE, NONE)


@inner
def _touch(state: State, n: int, v: int) -> int:
    """Add a vertex to those touched unless it is there; return their number."""
    if state.mark[v] != state.counter[STAMP] and n < FAN:
        state.mark[v] = state.counter[STAMP]
        state.fan[TOUCHED, n] = v
        return n + 1
    return n


@inner
def _touch_pair(state: State, n: int, t: int, other: int) -> int:
    for i in range(3):
        n = _touch(state, n, state.triangle[t, i])
        n = _touch(state, n, state.triangle[other, i])
    return n


@inner
def _mend(state: State, n: int, n_flips: int, last_a: int, last_b: int) -> int:
    """Flip the edges round the touched vertices that mend valences most, never the last one back."""
    for _ in range(n_flips):
        best, best_t, best_side = 0.0, NONE, NONE
        for i in range(n):
            v = state.fan[TOUCHED, i]
            m, _ = fan_of(state, v, NEAR)
            for j in range(m):
                t = state.fan[NEAR, j]
                k = corner_of(state, t, v)
                for side in (k, (k + 2) % 3):  # the edge opposite v and the one that leaves it
                    if state.triangle[t, 3 + side] < 0 or state.triangle[t, 6 + side] != NO_CURVE:
                        continue
                    p, q = state.triangle[t, (side + 1) % 3], state.triangle[t, (side + 2) % 3]
                    if (p == last_a and q == last_b) or (p == last_b and q == last_a):
                        continue
                    score = flip_gain(state, t, side) + NOISE * uniform(state)
                    if score > best and can_flip(state, t, side):
                        best, best_t, best_side = score, t, side
        if best_t < 0:
            break
        other = flip(state, best_t, best_side)
        last_a, last_b = state.triangle[best_t, 0], state.triangle[best_t, 2]
        n = _touch_pair(state, n, best_t, other)
    return n


@inner
def _ring(state: State, n: int) -> int:
    """Gather the vertices joined to those touched into row RING; return how many."""
    m = 0
    for i in range(n):
        v = state.fan[TOUCHED, i]
        k, _ = fan_of(state, v, NEAR)
        for j in range(k):
            t = state.fan[NEAR, j]
            for corner in range(3):
                w = state.triangle[t, corner]
                if state.mark[w] != state.counter[STAMP] and m < FAN:
                    state.mark[w] = state.counter[STAMP]
                    state.fan[RING, m] = w
                    m += 1
    return m


@inner
def _are_upright(state: State, n: int) -> bool:
    for i in range(n):
        k, _ = fan_of(state, state.fan[TOUCHED, i], NEAR)
        for j in range(k):
            if not is_upright(state, state.fan[NEAR, j]):
                return False
    return True
