"""The boundary and the interfaces of a mesh on a domain as segments: crossings, area inside, distances."""

from __future__ import annotations

import numpy as np
import shapely

from ..arrays import Floats, Ints
from .curve_places import side_arcs
from .domain import Domain
from .orientation import cross_properly
from .placed import PlacedMesh


def outline(mesh: PlacedMesh) -> Ints:
    """Return the boundary edges, domain on their left, (n, 2)."""
    triangle, side = np.nonzero(mesh.neighbours < 0)
    return np.column_stack([mesh.triangles[triangle, (side + step) % 3] for step in (1, 2)])


def curve_sides(mesh: PlacedMesh) -> tuple[Ints, Ints]:
    """Return triangle and side of each edge on a curve, once: where the triangle runs along it, (n,) each."""
    triangle, side = np.nonzero((mesh.codes >= 0) & (mesh.codes % 2 == 0))
    return triangle, side


def crossings(points: Floats, segments: Ints) -> Ints:
    """Return the pairs of segments, (n, 2) points, that cross properly, (m, 2)."""
    lines = shapely.linestrings(points[segments])
    pairs = np.stack(shapely.STRtree(lines).query(lines, predicate="intersects"), axis=1).astype(np.int64)
    pairs = pairs[pairs[:, 0] < pairs[:, 1]]
    first, second = segments[pairs[:, 0]], segments[pairs[:, 1]]
    is_apart = ~(first[:, :, None] == second[:, None, :]).any(axis=(1, 2))
    pairs = pairs[is_apart]
    return pairs[cross_properly(points, first[is_apart], second[is_apart])]


def area_inside(points: Floats, segments: Ints, *, is_crossing: bool) -> float:
    """Return the area inside closed loops of segments, (n, 2) points, by the even-odd rule."""
    lines = shapely.multilinestrings(shapely.linestrings(points[segments]))
    return float(shapely.build_area(shapely.node(lines) if is_crossing else lines).area)


def distances(points: Floats, ends: Floats) -> tuple[Floats, Ints]:
    """Return the distance of each point, (n, 2), to the nearest segment, (m, 2, 2), and which it is, (n,)."""
    tree = shapely.STRtree(shapely.linestrings(ends))
    (_, nearest), distance = tree.query_nearest(
        shapely.points(points), return_distance=True, all_matches=False
    )
    return distance, nearest


def rounds(domain: Domain, mesh: PlacedMesh) -> Floats:
    """Return how many times the sides on each curve cover it, (n_curves,): 1 in a mesh of the domain."""
    triangle, side = curve_sides(mesh)
    curve, start, end = side_arcs(domain, mesh, triangle, side)
    return np.bincount(curve, end - start, len(domain.curve_lengths)) / domain.curve_lengths
