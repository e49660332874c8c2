"""The state that every kernel works on: a triangle mesh on a domain, energies, journal and random numbers.

One NamedTuple of arrays, so that every kernel takes one argument. Invariants between transactions: corners
run counter-clockwise, side i of a triangle lies opposite its corner i, neighbours are mutual, valences and
energies are those of the mesh, the journal is empty.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeVar

import numpy as np

from ...arrays import Floats, Ints
from ...compiled import whole
from ..corners import boundary_goals
from ..domain import Domain

TRIANGLE, VALENCE, KIND, CURVE, HINT = range(5)
"""Columns of `vertex`: a triangle at it, number of edges, kind, curve (or -1), domain triangle near it."""

U, W, ARC, GOAL, ENERGY, GRID_GOAL = range(6)
"""Columns of `value`: log of the wanted edge length, exp(-2 u), place on its curve, goal valence, energy,
goal valence in the grid that the blocks will be cut into."""

DELTA, DELTA_VALENCES, TEMPERATURE, OFFSET, POWER, QUALITY, SIZE, VALENCES, BEND, CREDIT, OF_GRID = range(11)
"""Entries of `scalar`: energy change of the move, of its valences alone, temperature, added to u, weights,
what each triangle is credited with."""

N_VERTICES, N_TRIANGLES, N_FREE_VERTICES, N_FREE_TRIANGLES, N_LOG, N_TAKEN, N_FREED, OVERFLOW, STAMP = range(
    9
)
"""Entries of `counter`: rows in use (with holes), free rows, journal, rows taken and freed by the move."""

LOG_ROWS = 6000
"""Rows of the journal: a move touches at most a few hundred; one that needs more is rejected."""

FAN = 64
"""The most triangles at one vertex that kernels gather."""

NEAR, GONE, STAR, JOINED, COMMON, SPARE = map(whole, range(2, 8))
"""Rows of `fan` that hold the triangles at a vertex, by who asks; the first two are the annealing's."""

PARTS = 4
"""Edges into which a bent side is cut for its price."""

Numbers = TypeVar("Numbers", bound=np.ndarray[Any, Any])


class State(NamedTuple):
    """A mesh under change, with room for more rows than are in use."""

    point: Floats
    """Coordinates, (room, 2)."""
    value: Floats
    """Further numbers of a vertex, (room, 6): columns U .. GRID_GOAL."""
    vertex: Ints
    """Whole numbers of a vertex, (room, 5): columns TRIANGLE .. HINT; TRIANGLE is -1 in a free row."""
    triangle: Ints
    """(room, 9): three corners, three neighbours (-1 none), three curve codes; first corner -1 in a free row.

    A code is 2 c on a side that runs along curve c, 2 c + 1 against it, NO_CURVE or FROZEN_SIDE on others.
    """
    energy: Floats
    """Energy of each triangle, (room,)."""
    free_vertex: Ints
    free_triangle: Ints
    counter: Ints
    scalar: Floats
    log_int: Ints
    """Journal, (LOG_ROWS, 11): what (0 vertex, 1 triangle), row, the old whole numbers."""
    log_float: Floats
    """Journal, (LOG_ROWS, 8): the old coordinates and numbers."""
    taken: Ints
    """Rows taken in this transaction, (LOG_ROWS, 2): what, row."""
    freed: Ints
    """Rows freed in this transaction, (LOG_ROWS, 2): what, row."""
    fan: Ints
    """Scratch for fans of triangles, (8, FAN)."""
    bow: Floats
    """Scratch for how far a bent side lies from its chord, (PARTS + 1, 2); its ends stay 0."""
    mark: Ints
    """Stamp of the last list that each vertex was put on, (room,)."""
    seed: np.ndarray[tuple[int], np.dtype[np.uint64]]
    """State of the random numbers, (1,)."""
    map_point: Floats
    """Points of the domain's triangulation, (n, 2)."""
    map_triangle: Ints
    """Its corners and neighbours, (m, 6)."""
    map_u: Floats
    """Log of the wanted edge length at its points, (n,)."""
    curve_point: Floats
    """Polylines of all curves, (k, 5): x, y, arc length, log of the wanted edge length, goal valence."""
    curve_triangle: Ints
    """A triangle of the domain at each polyline point, (k,)."""
    curve: Ints
    """(n_curves, 4): first and one past the last polyline point, 1 if closed, 1 if inside the domain."""


def new_state(domain: Domain, log_size: Floats, points: Floats, rows: Ints, vertices: Ints, arcs: Floats,
              goals: Floats, *, room: float, seed: int) -> State:  # fmt: skip
    """Return the state of a mesh: points (n, 2), rows of `triangle` (m, 9), rows of `vertex` (n, 5)."""
    n_vertices, n_triangles = len(points), len(rows)
    most_vertices, most_triangles = int(n_vertices * room) + 100, int(n_triangles * room) + 200
    state = State(
        point=_padded(points, most_vertices),
        value=np.zeros((most_vertices, 6)),
        vertex=_padded(vertices, most_vertices),
        triangle=_padded(rows, most_triangles),
        energy=np.zeros(most_triangles),
        free_vertex=np.empty(most_vertices, dtype=np.int64),
        free_triangle=np.empty(most_triangles, dtype=np.int64),
        counter=np.zeros(9, dtype=np.int64),
        scalar=np.zeros(11),
        log_int=np.empty((LOG_ROWS, 11), dtype=np.int64),
        log_float=np.empty((LOG_ROWS, 8)),
        taken=np.empty((LOG_ROWS, 2), dtype=np.int64),
        freed=np.empty((LOG_ROWS, 2), dtype=np.int64),
        fan=np.empty((8, FAN), dtype=np.int64),
        bow=np.zeros((PARTS + 1, 2)),
        mark=np.zeros(most_vertices, dtype=np.int64),
        seed=np.array([seed], dtype=np.uint64),
        map_point=np.ascontiguousarray(domain.points),
        map_triangle=np.ascontiguousarray(domain.triangles),
        map_u=np.ascontiguousarray(log_size),
        curve_point=np.column_stack(
            [domain.curve_points, log_size[domain.curve_nodes], boundary_goals(domain, np.exp(log_size))]
        ),
        curve_triangle=np.ascontiguousarray(domain.curve_triangles),
        curve=np.ascontiguousarray(domain.curves),
    )
    state.value[:n_vertices, ARC], state.value[:n_vertices, GOAL] = arcs, goals
    state.counter[N_VERTICES], state.counter[N_TRIANGLES] = n_vertices, n_triangles
    return state


def _padded(array: Numbers, n_rows: int) -> Numbers:
    rest = np.full((n_rows - len(array), *array.shape[1:]), -1, dtype=array.dtype)
    return np.concatenate([array, rest])  # type: ignore[return-value]
