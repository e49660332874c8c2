"""The checks that make arrays of points and triangles a mesh, each naming the first few that fail."""

from __future__ import annotations

import numpy as np

from ..arrays import RELATIVE_TOLERANCE, Bools, Floats, Ints
from ..errors import InvalidMesh
from .quality import corner_edge_lengths, signed_areas

SMALLEST_EXTENT, LARGEST_EXTENT = 1e-60, 1e60
"""Extents between which squares and fourth powers of lengths stay within double precision."""

FLAT = 1e-13
"""A triangle whose area is below this share of its longest edge squared is degenerate: the rounding of
coordinates in double precision, seven orders below the worst sliver met in practice."""


def is_planar(points: Floats) -> bool:
    """Return True where the third coordinate is constant to the one tolerance."""
    extent = np.ptp(points, axis=0)
    return bool(extent[2] <= RELATIVE_TOLERANCE * max(extent[0], extent[1], np.abs(points[:, 2]).max()))


def check_shapes(points: Floats, triangles: Ints) -> None:
    """Raise InvalidMesh unless the arrays have the shapes of a mesh and indices in range."""
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise InvalidMesh(f"points have shape {points.shape}; give (n_points, 2) or (n_points, 3)")
    if triangles.ndim != 2 or triangles.shape[1] != 3:
        raise InvalidMesh(f"triangles have shape {triangles.shape}; give (n_triangles, 3)")
    if not len(triangles):
        raise InvalidMesh("the mesh has no triangles; give a mesh of triangles")
    if triangles.min() < 0 or triangles.max() >= len(points):
        is_bad = np.asarray(((triangles < 0) | (triangles >= len(points))).any(axis=1))
        raise InvalidMesh(
            _first(is_bad, triangles, f"an index outside 0 .. {len(points) - 1}", "repair the file")
        )
    if not np.isfinite(points).all():
        where = np.flatnonzero(~np.isfinite(points).all(axis=1))
        raise InvalidMesh(
            f"{len(where)} points are not finite, the first {where[0]} at {points[where[0]]}; repair the file"
        )


def check_mesh(points: Floats, triangles: Ints) -> tuple[Floats, Floats]:
    """Raise InvalidMesh unless points and triangles satisfy what `Mesh` promises, edges aside.

    Returns what that needs and others will: the area of each triangle, (n_triangles,), length**2, and the
    length of the edge opposite each corner, (n_triangles, 3), length.
    """
    check_shapes(points, triangles)
    if np.count_nonzero(np.bincount(triangles.ravel(), minlength=len(points))) < len(points):
        raise InvalidMesh("some points belong to no triangle; drop them with bsgplan.mesh.clean")
    extent = float(np.ptp(points, axis=0).max())
    if not SMALLEST_EXTENT < extent < LARGEST_EXTENT:
        raise InvalidMesh(f"the mesh is {extent:g} across, beyond reckoning; give it in another unit")
    with np.errstate(over="ignore", invalid="ignore"):
        areas = signed_areas(points, triangles)
        opposite = corner_edge_lengths(points, triangles)
        longest = np.maximum.reduce(opposite.T) ** 2
        is_flat = ~(np.abs(areas) > FLAT * longest)
    if is_flat.any():
        raise InvalidMesh(_first(is_flat, triangles, "zero area", "clean the mesh first"))
    if points.shape[1] == 2 and (areas < 0).any():
        raise InvalidMesh(
            _first(
                np.asarray(areas < 0), triangles, "clockwise corners", "orient them with bsgplan.mesh.clean"
            )
        )
    return np.abs(areas), opposite


def _first(is_bad: Bools, triangles: Ints, what: str, remedy: str) -> str:
    where = np.flatnonzero(is_bad)
    named = ", ".join(f"{i} (points {', '.join(map(str, triangles[i]))})" for i in where[:3])
    more = f" and {len(where) - 3} more" if len(where) > 3 else ""
    has = "triangle" if len(where) == 1 else "triangles"
    return f"{has} {named}{more}: {what}; {remedy}"
