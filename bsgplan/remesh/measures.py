"""The noun Measures: what is told of a mesh, or of a region of it, before and after."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats
from ..mesh import Mesh
from ..mesh.irregularity import Irregularity, fitted_boundary_irregularity, summed
from ..mesh.quality import angles
from ..sizing.misfit import size_misfit


@dataclass(frozen=True)
class Measures:
    """Counts and qualities of some triangles and of the vertices that count with them."""

    n_triangles: int
    n_points: int
    """Vertices."""
    irregular_interior: int
    """Interior vertices of valence other than 6."""
    irregular_boundary: int
    """Boundary vertices of valence other than 4 (Definition 1)."""
    irregular_boundary_fitted: int
    """Boundary vertices whose triangles are not max(1, round(angle / 60 degrees))."""
    irregularity: Irregularity
    """Sums of the positive and of the negative vertex irregularities."""
    q_min: float
    """Least mean ratio."""
    q_1_percent: float
    """The mean ratio that one triangle in a hundred is under."""
    q_mean: float
    """Mean of the mean ratios."""
    size_misfit: float
    """rms of log(edge / wanted edge)."""


def measured(
    mesh: Mesh, log_size: Floats, triangles: Bools | None = None, points: Bools | None = None
) -> Measures:
    """Return the measures of a mesh, or of some of its triangles, (n_triangles,), and points, (n_points,).

    log_size is the log of the wanted edge at the mesh's points, in the unit of the mesh.
    """
    topology = mesh.topology
    triangles = np.ones(mesh.n_triangles, dtype=bool) if triangles is None else triangles
    points = np.ones(mesh.n_points, dtype=bool) if points is None else points
    off, is_boundary = mesh.vertex_irregularity, topology.is_boundary
    fitted = fitted_boundary_irregularity(topology, angles(mesh.corner_edge_lengths))
    quality = mesh.qualities[triangles]
    edge = np.unique(topology.cell_edges[triangles])
    return Measures(
        n_triangles=int(np.count_nonzero(triangles)),
        n_points=int(np.count_nonzero(points)),
        irregular_interior=int(np.count_nonzero((off != 0) & ~is_boundary & points)),
        irregular_boundary=int(np.count_nonzero((off != 0) & is_boundary & points)),
        irregular_boundary_fitted=int(np.count_nonzero((fitted != 0) & points)),
        irregularity=summed(off[points]),
        q_min=float(quality.min()),
        q_1_percent=float(np.quantile(quality, 0.01)),
        q_mean=float(quality.mean()),
        size_misfit=size_misfit(mesh.edge_lengths[edge], topology.edges[edge], log_size),
    )
