"""The clean-up that never surprises: from raw arrays to a mesh.

`clean` orients, drops what is unused and flattens; it never moves or merges a point.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from .check import check_shapes, is_planar
from .mesh import Mesh
from .orient import turned_in_plane, turned_in_space


@dataclass(frozen=True, eq=False)
class Cleaned:
    """A mesh and what was done to the raw arrays to get it."""

    mesh: Mesh
    kept_points: Ints
    """Index in the raw points of each point of the mesh, (n_points,)."""
    n_flipped: int
    """Triangles turned: the clockwise of the plane; on a surface those against most of their component."""
    n_unused: int
    """Raw points of no triangle, dropped."""
    is_flattened: bool
    """True where a constant third coordinate was dropped."""


def clean(points: Floats, triangles: Ints) -> Cleaned:
    """Return the mesh of raw points, (n, 2 or 3), and triangles, (m, 3) in any orientation.

    Points of no triangle are dropped, a constant third coordinate too; triangles are turned to run one way.
    Raises InvalidMesh when what remains is no mesh, or a surface of one side.
    """
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
    is_turned = (
        turned_in_plane(points, triangles)
        if points.shape[1] == 2
        else turned_in_space(triangles, len(points))
    )
    n_flipped = int(np.count_nonzero(is_turned))
    if n_flipped:
        triangles = np.where(is_turned[:, None], triangles[:, ::-1], triangles)
    return Cleaned(Mesh(points, triangles), kept, n_flipped, len(is_used) - len(kept), is_flattened)
