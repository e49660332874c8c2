"""The floor under the irregular vertices inside a mesh whose boundary stays as it is."""

from __future__ import annotations

import numpy as np

from ..arrays import sums_by
from ..blocks.kinds import HALF_EDGE
from ..mesh import Mesh
from ..mesh.quality import angles


def floor_of(mesh: Mesh) -> int:
    """Return the fewest irregular vertices inside, each off by one, where boundary vertices fit their angles.

    iota inside = -6 chi - sum of (triangles - 3) over the boundary, pinches split. An angle halfway between
    two numbers of triangles has either.

    >>> floor_of(Mesh(np.array([[0.0, 0], [1, 0], [0.5, 0.9]]), np.array([[0, 1, 2]])))
    0
    """
    topology = mesh.topology
    rim = topology.is_boundary
    wanted = (sums_by(mesh.triangles, angles(mesh.corner_edge_lengths), mesh.n_points) / (np.pi / 3))[rim]
    n_fans = (topology.valence - topology.n_cells_at)[rim]  # a boundary vertex has one edge more a fan
    inside = -6 * (topology.euler_characteristic + topology.n_pinches) + int(3 * n_fans.sum())
    fewest = int(np.maximum(1.0, np.ceil(wanted - HALF_EDGE)).sum())
    most = int(np.maximum(1.0, np.floor(wanted + HALF_EDGE)).sum())
    return max(inside - most, fewest - inside, 0)
