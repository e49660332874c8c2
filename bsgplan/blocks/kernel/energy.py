"""The energy: quality and size of triangles, irregularity of vertices.

Of a triangle: wq ((1/q)^p - 1) / p + ws log(r)^2 + wb bend - credit, q the mean ratio, r its area over that
wanted, I = (sqrt(3)/2) 3 / (w1 + w2 + w3) being twice the wanted area: the harmonic mean of h^2 at its
corners. The ratio enters through chi(r) > 0, so that inverted triangles have a finite energy and relax. Of a
vertex: wv phi(valence - goal). Each is written to its row, its change added to DELTA.
"""

from __future__ import annotations

import numpy as np

from ...compiled import inner
from ..kinds import CORNER, HALF_EDGE, JUNCTION, SLIDING
from .bend import bend
from .journal import keep_triangle, keep_vertex
from .shape import SHAPE, soft
from .state import (
    BEND,
    CREDIT,
    DELTA,
    DELTA_VALENCES,
    ENERGY,
    GOAL,
    GRID_GOAL,
    KIND,
    OF_GRID,
    POWER,
    QUALITY,
    SIZE,
    VALENCE,
    VALENCES,
    State,
    W,
)

WANTED = 1.5 * np.sqrt(3.0)
"""Twice the wanted area is this over the sum of the corners' w = 1 / h^2."""


@inner
def twice_area(state: State, t: int) -> float:
    """Return twice the signed area of a triangle."""
    a, b, c = state.triangle[t, 0], state.triangle[t, 1], state.triangle[t, 2]
    ax, ay = state.point[a, 0], state.point[a, 1]
    return (state.point[b, 0] - ax) * (state.point[c, 1] - ay) - (state.point[b, 1] - ay) * (
        state.point[c, 0] - ax
    )


@inner
def triangle_energy(state: State, t: int) -> float:
    """Return the energy of a triangle where its corners are now."""
    a, b, c = state.triangle[t, 0], state.triangle[t, 1], state.triangle[t, 2]
    ux, uy = state.point[b, 0] - state.point[a, 0], state.point[b, 1] - state.point[a, 1]
    vx, vy = state.point[c, 0] - state.point[a, 0], state.point[c, 1] - state.point[a, 1]
    squares = ux * ux + uy * uy + vx * vx + vy * vy + (vx - ux) ** 2 + (vy - uy) ** 2
    wanted = WANTED / (state.value[a, W] + state.value[b, W] + state.value[c, W])
    chi = soft((ux * vy - uy * vx) / wanted)
    inverse = SHAPE * squares / (wanted * chi)
    scalar = state.scalar
    power = scalar[POWER]
    shape = inverse if power == 1.0 else inverse**power
    energy = scalar[QUALITY] * (shape - 1.0) / power + scalar[SIZE] * np.log(chi) ** 2 - scalar[CREDIT]
    if scalar[BEND] > 0.0:
        for side in range(3):
            if state.triangle[t, 6 + side] >= 0:
                energy += scalar[BEND] * bend(state, t, side, wanted)
    return energy


@inner
def valence_energy(state: State, v: int) -> float:
    """Return the energy of a vertex's valence."""
    return state.scalar[VALENCES] * valence_cost(state, v, state.vertex[v, VALENCE])


@inner
def valence_cost(state: State, v: int, valence: int) -> float:
    """Return what a valence would cost at a vertex, before weighting."""
    cost = cost_of_valence(off_goal(state, v, valence))
    share = state.scalar[OF_GRID]
    if share > 0.0 and state.vertex[v, KIND] == SLIDING:
        return (1.0 - share) * cost + share * cost_of_valence(abs(valence - state.value[v, GRID_GOAL]))
    return cost


@inner
def off_goal(state: State, v: int, valence: int) -> float:
    """Return how many edges off its goal a vertex would be: at corner and junction off the fitting numbers.

    The goal there is no whole number; all within HALF_EDGE of it fit.
    """
    off = abs(valence - state.value[v, GOAL])
    if CORNER <= state.vertex[v, KIND] <= JUNCTION:
        return np.ceil(max(0.0, off - HALF_EDGE))
    return off


@inner
def cost_of_valence(off: float) -> float:
    """Return phi: 0, 1, 2.8, 5.8 at 0, 1, 2, 3 off, linear between and beyond."""
    if off <= 1.0:
        return off
    if off <= 2.0:
        return 1.0 + 1.8 * (off - 1.0)
    return 2.8 + 3.0 * (off - 2.0)


@inner
def refresh_triangle(state: State, t: int) -> None:
    """Write the energy of a triangle anew, inside a transaction."""
    energy = triangle_energy(state, t)
    keep_triangle(state, t)
    state.scalar[DELTA] += energy - state.energy[t]
    state.energy[t] = energy


@inner
def set_valence(state: State, v: int, valence: int) -> None:
    """Set the valence of a vertex and its energy, inside a transaction."""
    keep_vertex(state, v)
    state.vertex[v, VALENCE] = valence
    energy = valence_energy(state, v)
    state.scalar[DELTA] += energy - state.value[v, ENERGY]
    state.scalar[DELTA_VALENCES] += energy - state.value[v, ENERGY]
    state.value[v, ENERGY] = energy


@inner
def drop_valence(state: State, v: int) -> None:
    """Take the energy of a vertex that goes out of the sum, inside a transaction; its row is written down."""
    state.scalar[DELTA] -= state.value[v, ENERGY]
    state.scalar[DELTA_VALENCES] -= state.value[v, ENERGY]
    state.value[v, ENERGY] = 0.0


@inner
def is_upright(state: State, t: int) -> bool:
    """Return True where a triangle's area is positive: above a millionth of the wanted one."""
    a, b, c = state.triangle[t, 0], state.triangle[t, 1], state.triangle[t, 2]
    wanted = WANTED / (state.value[a, W] + state.value[b, W] + state.value[c, W])
    return twice_area(state, t) > 1e-6 * wanted
