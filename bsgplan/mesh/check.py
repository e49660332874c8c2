"""What makes raw arrays a mesh: the checks of the noun, and the clean-up that never surprises.

`clean` orients, drops what is unused and flattens; it never moves or merges a point.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import RELATIVE_TOLERANCE, Bools, Floats, Ints
from ..errors import InvalidMesh
from .quality import signed_areas

if TYPE_CHECKING:
    from .mesh import Mesh

FLAT = 1e-13
"""A triangle whose area is below this share of its longest edge squared is degenerate: the rounding of
coordinates in double precision, seven orders below the worst sliver met in practice."""


@dataclass(frozen=True, eq=False)
class Cleaned:
    """A mesh and what was done to the raw arrays to get it."""

    mesh: Mesh
    kept_points: Ints
    """Index in the raw points of each point of the mesh, (n_points,)."""
    n_flipped: int
    """Triangles that were clockwise and have been turned."""
    n_unused: int
    """Raw points of no triangle, dropped."""
    is_flattened: bool
    """True where a constant third coordinate was dropped."""


def clean(points: Floats, triangles: Ints) -> Cleaned:
    """Return the mesh of raw points, (n, 2 or 3), and triangles, (m, 3) in any orientation.

    Points of no triangle are dropped, a constant third coordinate too, clockwise triangles of the plane
    are turned. Raises InvalidMesh when what remains is no mesh.
    """
    from .mesh import Mesh

    points, triangles = np.asarray(points, dtype=np.float64), np.asarray(triangles, dtype=np.int64)
    check_shapes(points, triangles)
    is_used = np.zeros(len(points), dtype=bool)
    is_used[triangles] = True
    kept = np.flatnonzero(is_used)
    if len(kept) < len(points):
        new_index = np.cumsum(is_used) - 1
        points, triangles = points[kept], new_index[triangles]
    is_flattened = points.shape[1] == 3 and is_planar(points)
    if is_flattened:
        points = points[:, :2]
    n_flipped = 0
    if points.shape[1] == 2:
        is_clockwise = signed_areas(points, triangles) < 0
        n_flipped = int(np.count_nonzero(is_clockwise))
        if n_flipped:
            triangles = np.where(is_clockwise[:, None], triangles[:, ::-1], triangles)
    return Cleaned(Mesh(points, triangles), kept, n_flipped, len(is_used) - len(kept), is_flattened)


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
    is_bad = np.asarray(((triangles < 0) | (triangles >= len(points))).any(axis=1))
    if is_bad.any():
        raise InvalidMesh(
            _first(is_bad, triangles, f"an index outside 0 .. {len(points) - 1}", "repair the file")
        )
    is_bad = np.asarray(~np.isfinite(points).all(axis=1))
    if is_bad.any():
        where = np.flatnonzero(is_bad)
        raise InvalidMesh(
            f"{len(where)} points are not finite, the first {where[0]} at {points[where[0]]}; repair the file"
        )


def check_mesh(points: Floats, triangles: Ints) -> None:
    """Raise InvalidMesh unless points and triangles satisfy what `Mesh` promises, edges aside."""
    check_shapes(points, triangles)
    if np.count_nonzero(np.bincount(triangles.ravel(), minlength=len(points))) < len(points):
        raise InvalidMesh("some points belong to no triangle; drop them with bsgplan.mesh.clean")
    with np.errstate(over="ignore", invalid="ignore"):
        areas = signed_areas(points, triangles)
        corners = points[triangles]
        longest = ((corners - np.roll(corners, 1, axis=1)) ** 2).sum(axis=2).max(axis=1)
        is_flat = ~(np.abs(areas) > FLAT * longest)
    if is_flat.any():
        raise InvalidMesh(_first(is_flat, triangles, "zero area", "clean the mesh first"))
    if points.shape[1] == 2 and (areas < 0).any():
        raise InvalidMesh(
            _first(
                np.asarray(areas < 0), triangles, "clockwise corners", "orient them with bsgplan.mesh.clean"
            )
        )


def _first(is_bad: Bools, triangles: Ints, what: str, remedy: str) -> str:
    where = np.flatnonzero(is_bad)
    named = ", ".join(f"{i} (points {', '.join(map(str, triangles[i]))})" for i in where[:3])
    more = f" and {len(where) - 3} more" if len(where) > 3 else ""
    has = "triangle" if len(where) == 1 else "triangles"
    return f"{has} {named}{more}: {what}; {remedy}"
