"""Gaps between triangles and a rim, closed by constrained Delaunay triangles of the vertices there are.

Invariant: what is closed has every rim side once, every triangle is positive, and areas add up.
"""

from __future__ import annotations

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ..arrays import Floats, Ints
from ..blocks.kinds import INTERIOR
from ..blocks.placed import PlacedMesh
from ..mesh.quality import signed_areas

AREA_TOLERANCE = 1e-9
"""Share of the area by which triangles and outline may differ: rounding; an overlap is a triangle's area."""


def closed(points: Floats, triangles: Ints, rim: Ints) -> Ints | None:
    """Return the triangles and those that fill what they leave of the inside of a rim, (m, 3).

    points is (n, 2), triangles (k, 3) counter-clockwise, rim the directed sides, inside on their left,
    (r, 2). None where triangles overlap or reach over the rim, or where
    sides cross.
    """
    n = len(points)
    sides = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    keys, rim_keys = sides[:, 0] * n + sides[:, 1], rim[:, 0] * n + rim[:, 1]
    if len(np.unique(keys)) < len(keys):
        return None
    is_free = ~np.isin(sides[:, 1] * n + sides[:, 0], keys) & ~np.isin(keys, rim_keys)
    is_open = ~np.isin(rim_keys, keys)
    around = np.concatenate([rim[is_open], sides[is_free][:, ::-1]])
    try:
        filled = np.concatenate([triangles, _filled(points, around)]) if len(around) else triangles
    except shapely.errors.GEOSException:  # sides that cross: no polygon with convex corners
        return None
    area = signed_areas(points, filled)
    start, end = points[rim].swapaxes(0, 1)
    wanted = 0.5 * float((start[:, 0] * end[:, 1] - end[:, 0] * start[:, 1]).sum())
    if not (area > 0).all() or abs(area.sum() - wanted) > AREA_TOLERANCE * wanted:
        return None
    return filled if _has_sides(filled, rim_keys, n) else None


def within(part: PlacedMesh, points: Floats, triangles: Ints) -> PlacedMesh:
    """Return triangles as a mesh with the rim of a part, vertices of the rim in their order.

    points begin with those of the part, of which the triangles have the rim's.
    """
    n = len(part.points)
    used, corners = np.unique(triangles, return_inverse=True)
    nearest = used.copy()
    new = used >= n
    nearest[new] = cKDTree(part.points).query(points[used[new]])[1]
    corners = corners.reshape(-1, 3)
    triangle, side = np.nonzero(part.neighbours < 0)
    total = len(points)

    def keys(corner: Ints, at: Ints) -> Ints:
        rows = np.arange(len(corner))
        return np.asarray(corner[rows, (at + 1) % 3] * total + corner[rows, (at + 2) % 3])

    own = keys(part.triangles[triangle], side)
    order = np.argsort(own)
    row, at = (v.ravel() for v in np.indices(triangles.shape))
    found = keys(triangles[row], at)
    where = np.minimum(np.searchsorted(own[order], found), len(own) - 1)
    is_rim = own[order][where] == found
    codes = np.where(is_rim, part.codes[triangle, side][order][where], -1).reshape(-1, 3)
    return PlacedMesh(
        points=points[used],
        triangles=corners,
        codes=codes,
        kinds=np.where(new, INTERIOR, part.kinds[nearest]),
        curves=np.where(new, -1, part.curves[nearest]),
        arcs=np.where(new, 0.0, part.arcs[nearest]),
        goals=np.where(new, 6.0, part.goals[nearest]),
        hints=part.hints[nearest],
    )


def _filled(points: Floats, around: Ints) -> Ints:
    """Return the constrained Delaunay triangles of the gaps on the left of directed sides, (m, 3)."""
    n = len(points)
    faces = shapely.get_parts(shapely.polygonize(shapely.linestrings(points[around])))
    used = np.unique(around)  # other points may lie where one of these does
    own = points[used]
    keys = np.sort(around[:, 0] * n + around[:, 1])

    def index(where: Floats) -> Ints:
        """Return the point at each place, exactly."""
        both = np.concatenate([own, where])
        _, first, inverse = np.unique(both, axis=0, return_index=True, return_inverse=True)
        return used[first[inverse.ravel()[len(own) :]]]

    gaps = []
    for face in faces:
        ring = shapely.get_coordinates(shapely.get_exterior_ring(face))
        ring = ring if shapely.is_ccw(shapely.get_exterior_ring(face)) else ring[::-1]
        a, b = index(ring[:2])
        at = min(int(np.searchsorted(keys, a * n + b)), len(keys) - 1)
        if keys[at] == a * n + b:
            gaps.append(face)
    pieces = shapely.get_parts(shapely.constrained_delaunay_triangles(np.array(gaps, dtype=object)))
    if not len(pieces):
        return np.empty((0, 3), dtype=np.int64)
    corners = shapely.get_coordinates(pieces).reshape(-1, 4, 2)[:, :3]
    made = index(corners.reshape(-1, 2)).reshape(-1, 3)
    is_clockwise = signed_areas(points, made) < 0
    made[is_clockwise] = made[is_clockwise][:, ::-1]
    return np.asarray(made)


def _has_sides(triangles: Ints, rim_keys: Ints, n: int) -> bool:
    """Return True where the triangles are conforming and their boundary is the rim."""
    sides = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    keys, back = sides[:, 0] * n + sides[:, 1], sides[:, 1] * n + sides[:, 0]
    is_one_sided = ~np.isin(back, keys)
    return len(np.unique(keys)) == len(keys) and np.array_equal(
        np.sort(keys[is_one_sided]), np.sort(rim_keys)
    )
