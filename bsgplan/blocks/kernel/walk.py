"""Point location: a walk over a triangulation to the triangle that holds a point."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats, Ints
from ...compiled import compiled, inner

STEPS = 2000
"""The most triangles that one walk crosses: it stops walks that circle round a point outside."""


@inner
def walk(points: Floats, triangles: Ints, x: float, y: float, hint: int) -> tuple[int, float, float, float]:
    """Return the triangle that holds (x, y) and its barycentric coordinates there, from triangle hint on.

    triangles is corners and neighbours, (n, 6). Crosses the side that separates most and is not boundary;
    outside the domain the triangle where that ends, coordinates clipped to be positive with sum 1.
    """
    t = hint
    for _ in range(STEPS):
        i, j, k = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        ax, ay = points[i, 0] - x, points[i, 1] - y
        bx, by = points[j, 0] - x, points[j, 1] - y
        cx, cy = points[k, 0] - x, points[k, 1] - y
        la, lb, lc = bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx
        limit = -1e-12 * (la + lb + lc)
        side = -1
        if la < limit and triangles[t, 3] >= 0:
            side, limit = 0, la
        if lb < limit and triangles[t, 4] >= 0:
            side, limit = 1, lb
        if lc < limit and triangles[t, 5] >= 0:
            side = 2
        if side < 0:
            break
        t = triangles[t, 3 + side]
    la, lb, lc = max(la, 0.0), max(lb, 0.0), max(lc, 0.0)
    total = la + lb + lc
    return t, la / total, lb / total, lc / total


@compiled
def walk_all(
    points: Floats, triangles: Ints, where: Floats, hints: Ints, found: Ints, shares: Floats
) -> None:
    """Fill the triangle, (n,), and the barycentric coordinates, (n, 3), of many points, (n, 2)."""
    for k in range(len(where)):
        t, la, lb, lc = walk(points, triangles, where[k, 0], where[k, 1], hints[k])
        found[k] = t
        shares[k, 0], shares[k, 1], shares[k, 2] = la, lb, lc


def locate(points: Floats, triangles: Ints, where: Floats, hints: Ints) -> tuple[Ints, Floats]:
    """Return the triangle of each point, (n,), and its barycentric coordinates there, (n, 3)."""
    found, shares = np.empty(len(where), dtype=np.int64), np.empty((len(where), 3))
    walk_all(points, triangles, np.ascontiguousarray(where), np.ascontiguousarray(hints), found, shares)
    return found, shares
