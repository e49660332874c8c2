"""How well shaped a triangle is: area, mean ratio, smallest angle, longest over shortest edge.

The ratios and angles are computed from edge lengths, so they hold in the plane and on surfaces alike.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints


def signed_areas(points: Floats, triangles: Ints) -> Floats:
    """Return the area of each triangle, (n_triangles,), negative where clockwise in the plane.

    >>> signed_areas(np.array([[0.0, 0], [1, 0], [0, 1]]), np.array([[0, 1, 2], [0, 2, 1]]))
    array([ 0.5, -0.5])
    """
    if points.shape[1] == 2:
        x, y = (axis[triangles.T] for axis in points.T)
        return 0.5 * ((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]))
    a, b, c = (points[corner] for corner in triangles.T)
    u, v = b - a, c - a
    return 0.5 * np.linalg.norm(np.cross(u, v), axis=1)


def corner_edge_lengths(points: Floats, triangles: Ints) -> Floats:
    """Return the length of the edge opposite each corner, (n_triangles, 3), length."""
    squares = np.zeros(triangles.shape)
    for axis in points.T:
        at = axis[triangles]
        for k in range(3):
            squares[:, k] += (at[:, k - 1] - at[:, k - 2]) ** 2
    return np.sqrt(squares)


def lengths(vectors: Floats) -> Floats:
    """Return the lengths of vectors, (n, 2 or 3).

    >>> lengths(np.array([[3.0, 4.0]]))
    array([5.])
    """
    first, *others = vectors.T
    total = first * first
    for axis in others:
        total += axis * axis
    return np.sqrt(total)


def mean_ratio(areas: Floats, lengths: Floats) -> Floats:
    """Return the mean ratio of triangles, (n_triangles,), 1 for equilateral and 0 for flat.

    q = 4 sqrt(3) A / (l1^2 + l2^2 + l3^2), [Zint & Grosso], Eq. 6.

    >>> mean_ratio(np.array([0.5]), np.array([[1.0, 1.0, 2.0**0.5]])).round(4)
    array([0.866])
    """
    total = np.einsum("ij,ij->i", lengths, lengths)
    return 4 * np.sqrt(3) * np.asarray(areas) / np.where(total > 0, total, 1.0)


def angles(lengths: Floats) -> Floats:
    """Return the angle at each corner, (n_triangles, 3), radians.

    >>> np.degrees(angles(np.array([[1.0, 1.0, 1.0]]))).round(6)
    array([[60., 60., 60.]])
    """
    a, b, c = lengths.T
    squares = lengths**2
    others = np.column_stack([b * c, c * a, a * b])
    cosine = (squares.sum(axis=1, keepdims=True) - 2 * squares) / (2 * np.where(others > 0, others, 1.0))
    return np.arccos(np.clip(cosine, -1.0, 1.0))


def edge_ratio(lengths: Floats) -> Floats:
    """Return longest over shortest edge of each triangle, (n_triangles,), at least 1.

    >>> edge_ratio(np.array([[1.0, 2.0, 2.5]]))
    array([2.5])
    """
    return lengths.max(axis=1) / lengths.min(axis=1)
