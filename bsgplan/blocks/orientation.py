"""Which way three points turn, exactly: a float filter, and fractions where it cannot tell."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from ..arrays import Bools, Floats, Ints

FILTER = 3.3306690738754716e-16
"""A determinant larger than this share of its two products' sizes has the sign that it shows: (3 + 16 eps)
eps with eps = 2^-53, [Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic], ccwerrboundA."""


def orientation(a: Floats, b: Floats, c: Floats) -> Ints:
    """Return 1 where a, b, c turn left, -1 where right, 0 where they lie on one line; (n, 2) each, (n,).

    >>> orientation(np.zeros((1, 2)), np.array([[1.0, 1.0]]), np.array([[3.0, 3.0]]))
    array([0])
    """
    left = (a[:, 0] - c[:, 0]) * (b[:, 1] - c[:, 1])
    right = (a[:, 1] - c[:, 1]) * (b[:, 0] - c[:, 0])
    determinant = left - right
    result = np.sign(determinant).astype(np.int64)
    is_sure = np.abs(determinant) > FILTER * (np.abs(left) + np.abs(right))
    for i in np.flatnonzero(~is_sure):
        result[i] = _exact(a[i], b[i], c[i])
    return result


def _exact(a: Floats, b: Floats, c: Floats) -> int:
    (ax, ay), (bx, by), (cx, cy) = ([Fraction(float(v)) for v in p] for p in (a, b, c))
    determinant = (ax - cx) * (by - cy) - (ay - cy) * (bx - cx)
    return (determinant > 0) - (determinant < 0)


def cross_properly(points: Floats, first: Ints, second: Ints) -> Bools:
    """Return where segments, (n, 2) points each, cross at one point inside both, (n,)."""
    (a, b), (c, d) = points[first].swapaxes(0, 1), points[second].swapaxes(0, 1)
    is_across = orientation(a, b, c) * orientation(a, b, d) < 0
    result = is_across.copy()
    a, b, c, d = a[is_across], b[is_across], c[is_across], d[is_across]
    result[is_across] = orientation(c, d, a) * orientation(c, d, b) < 0
    return result
