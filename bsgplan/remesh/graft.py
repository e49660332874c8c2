"""The noun Graft: a mesh with parts of it exchanged, and where each of its points and triangles comes from.

Invariants: triangles outside the parts come first, in their order, and keep their three vertices bit for bit;
so do points that stay. New points follow them part by part.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..blocks.kinds import FROZEN
from ..blocks.placed import PlacedMesh
from ..mesh import Mesh
from .cut import Cut


@dataclass(frozen=True, eq=False)
class Graft:
    """A mesh made of another by exchanging parts."""

    mesh: Mesh
    """The mesh after the exchange."""
    new_index: Ints
    """Point of the new mesh that each old point is, (n_old_points,); -1 where it is gone."""
    source: Ints
    """Old triangle that each triangle is, or in which its centroid lies, (n_triangles,)."""
    n_outside: int
    """The first so many triangles are old ones."""
    corners: Ints
    """Old points between which each point lies, (n_points, 3)."""
    shares: Floats
    """What part each of them has in it, (n_points, 3), sum 1."""

    def at_points(self, values: Floats) -> Floats:
        """Return values at the old points, (n_old_points, ...), at the new: exact where a point stayed."""
        found = np.einsum("pc,pc...->p...", self.shares, values[self.corners])
        kept = np.flatnonzero(self.new_index >= 0)
        found[self.new_index[kept]] = values[kept]
        return np.asarray(found)

    def at_triangles(self, values: Floats) -> Floats:
        """Return values at the old triangles, (n_old_triangles, ...), at the new: that at the centroid."""
        return np.asarray(values[self.source])


def graft(mesh: Mesh, parts: Sequence[tuple[Cut, PlacedMesh]]) -> Graft:
    """Return the mesh with each part replaced by what was made of it; parts have no triangle in common."""
    is_outside = np.ones(mesh.n_triangles, dtype=bool)
    stays = np.zeros(mesh.n_points, dtype=bool)
    for part, _ in parts:
        is_outside &= ~part.is_inside
        stays[part.point[part.is_frozen]] = True
    stays[mesh.triangles[is_outside]] = True
    kept = np.flatnonzero(stays)
    new_index = np.where(stays, np.cumsum(stays) - 1, -1)
    points, triangles = [mesh.points[kept]], [new_index[mesh.triangles[is_outside]]]
    source, corners = [np.flatnonzero(is_outside)], [np.repeat(kept[:, None], 3, axis=1)]
    shares = [np.tile([1.0, 0.0, 0.0], (len(kept), 1))]
    n_points = len(kept)
    for part, placed in parts:
        is_new = placed.kinds != FROZEN
        number = np.empty(len(placed.points), dtype=np.int64)
        number[~is_new] = new_index[part.point[part.is_frozen]]
        number[is_new] = n_points + np.arange(np.count_nonzero(is_new))
        n_points += int(np.count_nonzero(is_new))
        found, share = _located(part, placed.points[is_new], placed.hints[is_new])
        centroids = placed.points[placed.triangles].mean(axis=1)
        points.append(part.domain.to_mesh(placed.points[is_new]))
        triangles.append(number[placed.triangles])
        corners.append(part.point[part.domain.triangles[found, :3]])
        shares.append(share)
        source.append(part.triangle[_located(part, centroids, placed.hints[placed.triangles[:, 0]])[0]])
    return Graft(
        Mesh(np.concatenate(points), np.concatenate(triangles)),
        new_index,
        np.concatenate(source),
        int(np.count_nonzero(is_outside)),
        np.concatenate(corners),
        np.concatenate(shares),
    )


def _located(part: Cut, where: Floats, hints: Ints) -> tuple[Ints, Floats]:
    from ..blocks.kernel.walk import locate

    return locate(part.domain.points, part.domain.triangles, where, hints)
