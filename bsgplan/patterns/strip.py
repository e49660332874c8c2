r"""The strip between two fronts of m and n equal elements: its Delaunay triangles, in integers.

The apex of an edge is the vertex of the other front nearest to the edge's midpoint, whatever the width.
Open fronts share both ends. Where a midpoint lies halfway between two vertices (cocircular), the diagonal
runs from the upper first to the lower second vertex, as in the unit square of [Zint & Grosso], Figure 1a:
always the same way, so equal fronts are regular and irregularity spreads evenly.
Closed rings are turned against each other by the angle at which no tie is left: equal rings interlock.

    first  second            Invariants: m + n triangles, counter-clockwise with the first front on the left
      *------*               and indices upwards; the m triangles on the first front come first.
      | \    |
      |   \  |
      *------*
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from math import gcd, lcm

import numpy as np

from ..arrays import Floats, Ints, frozen_floats, frozen_ints


@lru_cache(maxsize=4096)
def strip_triangles(m: int, n: int, *, is_closed: bool = False) -> Ints:
    """Return the triangles between fronts of m and n elements, (m + n, 3).

    Vertices of the first front are 0 to m (m - 1 closed), those of the second follow.

    >>> strip_triangles(2, 1).tolist()
    [[0, 3, 1], [1, 4, 2], [3, 4, 1]]
    """
    first, second = strip_apexes(m, n, is_closed=is_closed)
    i, j = np.arange(m), np.arange(n)
    n_first, n_second = (m, n) if is_closed else (m + 1, n + 1)
    on_first = np.column_stack([i, n_first + first % n_second, (i + 1) % n_first])
    on_second = np.column_stack([n_first + j, n_first + (j + 1) % n_second, second % n_first])
    return frozen_ints(np.concatenate([on_first, on_second]))


@lru_cache(maxsize=4096)
def strip_apexes(m: int, n: int, *, is_closed: bool = False) -> tuple[Ints, Ints]:
    """Return the apex of each edge of the first front, (m,), and of the second, (n,), not wrapped.

    >>> [apexes.tolist() for apexes in strip_apexes(3, 1)]
    [[0, 0, 1], [2]]
    """
    a, b = n // gcd(m, n), m // gcd(m, n)  # edges of the first and second front in units of 1 / lcm
    turn = int(2 * lcm(m, n) * ring_turn(m, n)) if is_closed else 0
    on_first = a * (2 * np.arange(m) + 1) - turn  # twice the midpoints
    on_second = b * (2 * np.arange(n) + 1) + turn
    first = -((b - on_first) // (2 * b))  # nearest, ties down
    second = (on_second + a) // (2 * a)  # nearest, ties up: the other half of the same quadrilateral
    return frozen_ints(first), frozen_ints(second)


def ring_turn(m: int, n: int) -> Fraction:
    """Return by how much the second of two rings is turned ahead of the first, in turns.

    Half of 1 / lcm where both reduced counts are odd, else 0: the turn without ties, and so the best.

    >>> ring_turn(12, 12), ring_turn(12, 6)
    (Fraction(1, 24), Fraction(0, 1))
    """
    is_odd = (m // gcd(m, n)) % 2 == 1 and (n // gcd(m, n)) % 2 == 1
    return Fraction(1, 2 * lcm(m, n)) if is_odd else Fraction(0)


@lru_cache(maxsize=4096)
def strip_table(m: int, n: int, *, is_closed: bool = False) -> Floats:
    """Return base, midpoint and apex of each triangle, (4, m + n), as shares of the front's length.

    Rows: 1 where the base lies on the second front; length of the base; its midpoint; the apex on the
    other front. Midpoint and apex are measured from the middle of open fronts, from the first vertex of
    the first ring for closed ones.

    >>> strip_table(1, 1).tolist()
    [[0.0, 1.0], [1.0, 1.0], [0.0, 0.0], [-0.5, 0.5]]
    """
    first, second = strip_apexes(m, n, is_closed=is_closed)
    turn = float(ring_turn(m, n)) if is_closed else 0.0
    middle = 0.0 if is_closed else 0.5
    side = np.repeat([0.0, 1.0], [m, n])
    base = np.repeat([1 / m, 1 / n], [m, n])
    midpoint = np.concatenate([(np.arange(m) + 0.5) / m, (np.arange(n) + 0.5) / n + turn]) - middle
    apex = np.concatenate([first / n + turn, second / m]) - middle
    return frozen_floats(np.stack([side, base, midpoint, apex]))


@lru_cache(maxsize=4096)
def critical_turns(m: int, n: int, *, is_closed: bool = False) -> Floats:
    """Return the smallest and the largest turn of apex against midpoint on each front, (2, 2).

    >>> critical_turns(4, 2).tolist()
    [[0.125, 0.125], [0.0, 0.0]]
    """
    table = strip_table(m, n, is_closed=is_closed)
    turn = np.abs(table[3] - table[2])
    return frozen_floats([[side.min(), side.max()] for side in (turn[:m], turn[m:])])
