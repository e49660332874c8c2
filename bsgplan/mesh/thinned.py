"""The noun Thinned, and the verb that makes one: a mesh with a fifth of its triangles, for what is smooth.

Its points are points of the mesh, all of the boundary among them. Every point and triangle of the mesh knows
the one that it was merged into, so that what is found on the few can be said of the many.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..arrays import Ints, Wholes, short_type
from .mesh import Mesh


@dataclass(frozen=True, eq=False)
class Thinned:
    """A mesh and a thinner one of the same domain."""

    whole: Mesh = field(repr=False)
    """The mesh that was thinned."""
    mesh: Mesh
    """What is left of it."""
    kept: Ints = field(repr=False)
    """The point of the whole mesh that each point is, (mesh.n_points,)."""
    point: Ints = field(repr=False)
    """The point left that each point of the whole was merged into, (whole.n_points,)."""
    triangle: Ints = field(repr=False)
    """The triangle left that each triangle of the whole was merged into, (whole.n_triangles,)."""

    @property
    def edge_ratio(self) -> float:
        """How many edges of the whole mesh one of the thinned spans."""
        return float(np.sqrt(self.whole.n_triangles / self.mesh.n_triangles))


def thinned(mesh: Mesh) -> Thinned:
    """Return a plane mesh with its inner vertices merged where edges stay short, see `collapse.LONGEST`.

    The boundary, pinches and folds stay as they are, and the triangles are positive; linear in time.
    """
    from .collapse import MOST_BESIDE, Corners, collapse_all, prepare  # compiled: for large meshes only

    n = mesh.n_points
    short = short_type(max(mesh.triangles.size, n))
    room = np.empty((2, MOST_BESIDE), dtype=short)
    corners = Corners(
        points=mesh.points,
        square=np.zeros(n),
        stays=np.zeros(n, dtype=bool),
        vertex=mesh.triangles.ravel().astype(short),
        twin=np.empty(mesh.triangles.size, dtype=short),
        first=np.zeros(n, dtype=short),
        point=np.arange(n, dtype=short),
        triangle=np.arange(mesh.n_triangles, dtype=short),
        ring=room[0],
        corner=room[1],
    )
    prepare(corners, mesh.topology.edge_sides, *np.zeros((2, n), dtype=short))
    collapse_all(corners)
    kept, point = _numbered(corners.point)
    left, triangle = _numbered(corners.triangle)
    triangles = point[corners.vertex.reshape(-1, 3)[left]]
    return Thinned(mesh, Mesh(mesh.points[kept], triangles), kept, point, triangle)


def _numbered(into: Wholes) -> tuple[Ints, Ints]:
    """Return what was merged into itself, (n_left,), and the number among these that each was merged into.

    >>> [part.tolist() for part in _numbered(np.array([1, 1, 2, 2]))]
    [[1, 2], [0, 0, 1, 1]]
    """
    stays = into == np.arange(len(into))
    return np.flatnonzero(stays), (np.cumsum(stays) - 1)[into]
