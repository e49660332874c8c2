"""Quadrilaterals: split into triangles along the better diagonal, and measured as they are."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints


def split_quads(points: Floats, quads: Ints) -> tuple[Ints, Ints]:
    """Return the triangles of quads, (n, 3), and the quad that each comes from, (n,), in their order.

    Each quad is cut along the diagonal whose worse triangle has the greater mean ratio, counted negative
    where it is turned over: a quad that is not convex is cut inside. A quad that names a corner twice is
    one triangle.

    >>> kite = np.array([[0.0, 0], [4, -1], [3, 0], [4, 1]])
    >>> split_quads(kite, np.array([[0, 1, 2, 3]]))[0].tolist()
    [[0, 1, 2], [0, 2, 3]]
    """
    ways = np.stack([quads[:, [[0, 1, 2], [0, 2, 3]]], quads[:, [[0, 1, 3], [1, 2, 3]]]])
    corners = points[quads]
    normal = _cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    worst = np.stack([_turned_ratio(points[way], normal).min(axis=1) for way in ways])
    best = np.where(worst[1] > worst[0], 1, 0)
    triangles = ways[best, np.arange(len(quads))].reshape(-1, 3)
    quad = np.repeat(np.arange(len(quads)), 2)
    a, b, c = triangles.T
    is_triangle = (a != b) & (b != c) & (c != a)
    return triangles[is_triangle], quad[is_triangle]


def quad_angles(points: Floats, quads: Ints) -> Floats:
    """Return the angle at each corner, (n_quads, 4), radians from 0 to pi; 0 where a side has no length.

    >>> np.degrees(quad_angles(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]), np.array([[0, 1, 2, 3]])))
    array([[90., 90., 90., 90.]])
    """
    corners = points[quads]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    normal = _cross(ahead, back)
    sine = np.linalg.norm(normal, axis=-1)
    return np.asarray(np.arctan2(sine, (ahead * back).sum(axis=-1)))


def _turned_ratio(corners: Floats, normal: Floats) -> Floats:
    """Return the mean ratio of triangles, (n, 2, 3, 2 or 3) corners, negative where turned from normal."""
    a, b, c = corners.transpose(2, 0, 1, 3)
    cross = _cross(b - a, c - a)
    turned = np.sign((cross * normal[:, None, :]).sum(axis=-1))
    total = ((b - a) ** 2 + (c - b) ** 2 + (a - c) ** 2).sum(axis=-1)
    ratio = 2 * np.sqrt(3) * np.linalg.norm(cross, axis=-1) / np.where(total > 0, total, 1.0)
    return np.asarray(turned * ratio)


def _cross(u: Floats, v: Floats) -> Floats:
    """Return cross products, (..., 1) in the plane and (..., 3) in space."""
    if u.shape[-1] == 2:
        return np.asarray(u[..., :1] * v[..., 1:] - u[..., 1:] * v[..., :1])
    return np.asarray(np.cross(u, v))
