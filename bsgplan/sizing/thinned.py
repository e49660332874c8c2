"""Read the size field of a mesh on a thinned one, and carry it back.

Each point left has the mean of all that was merged into it, moved to its own place along the slope: a field
that is linear in space passes unchanged, up to the wall.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, sums_by
from ..mesh import Mesh
from ..mesh.operators import gradient, to_vertices
from ..mesh.thinned import Thinned
from .field import SizeField
from .measure import REACH, calibrated, log_sizes
from .smoothing import smooth

MOVES = 3
"""Times that the slope is taken to move the means: the first is off where the ways to them differ."""


def thin_size_field(thin: Thinned) -> SizeField:
    """Return the size field of a mesh's own edges on its thinned mesh; see `measure.size_field`.

    Calibrated: it expects as many triangles as the whole mesh has.
    """
    from .edge_means import add_edges  # compiled: for large meshes only

    sums = np.zeros((thin.mesh.n_points, 4))
    add_edges(thin.whole.points, thin.whole.topology.edges, thin.point, sums)
    return calibrated(SizeField(thin.mesh, np.exp(_in_place(thin, sums))), thin.whole.n_triangles)


def thin_named_size_field(thin: Thinned, values: Floats, name: str) -> SizeField:
    """Return the size field of an array of the whole mesh on its thinned one; see `measure.named_size_field`.

    Raises InvalidSize as that does.
    """
    log_h = log_sizes(thin.whole, values, name)
    n = thin.mesh.n_points
    sums = np.column_stack(
        [sums_by(thin.point, each, n) for each in (np.ones_like(log_h), log_h, *thin.whole.points.T)]
    )
    return SizeField(thin.mesh, np.exp(_in_place(thin, sums)), name)


def whole_size_field(thin: Thinned, size: SizeField) -> SizeField:
    """Return a size field of the thinned mesh on the whole one, along the slope at each point left.

    It expects as many triangles as before.
    """
    way = thin.whole.points - thin.mesh.points[thin.point]
    rise = np.einsum("ij,ij->i", _slope(thin.mesh, size.log_h)[thin.point], way)
    h = np.exp(size.log_h[thin.point] + rise)
    return calibrated(SizeField(thin.whole, h, size.source), size.expected_triangles)


def _in_place(thin: Thinned, sums: Floats) -> Floats:
    """Return the means moved from where they were taken to the points, and smoothed, (n_points,).

    sums is (n_points, 4): of one for each value, of the values, and of their places. Smoothed over the same
    length as those of the whole mesh, REACH of its edges, each as much as it stands for.
    """
    means = sums[:, 1] / sums[:, 0]
    way = sums[:, 2:] / sums[:, :1] - thin.mesh.points
    values, reach = means, REACH / thin.edge_ratio
    for _ in range(MOVES):
        values = means - np.einsum("ij,ij->i", _slope(thin.mesh, values), way)
    return smooth(thin.mesh, values, reach, sums[:, 0])


def _slope(mesh: Mesh, values: Floats) -> Floats:
    return to_vertices(mesh, gradient(mesh, values))
