"""What a mesh is worth against a size field: quality, irregular vertices, size conformity, deviation.

The same measures for the input, the blocks and the grid, so that they can stand side by side.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..mesh import Mesh, quality
from ..mesh.irregularity import Irregularity, fitted_boundary_irregularity
from ..sizing import SizeField
from .domain import Domain
from .layout import BlockGrid, BlockLayout
from .placed import PlacedMesh

GRAVITY = 9.81
"""Acceleration of free fall, m/s^2."""

NODES, WEIGHTS = np.polynomial.legendre.leggauss(5)
"""The five-point rule of Gauss along an edge, on -1 .. 1."""


@dataclass(frozen=True)
class EdgeRatio:
    """How long edges are against the size wanted: integral of ds / (s h) along each, 1 where as wanted."""

    p05: float
    p50: float
    p95: float
    rms_log: float
    """Root of the mean square of its logarithm."""


@dataclass(frozen=True)
class Measures:
    """What one mesh is worth; n_blocks is None for a mesh without blocks."""

    n_triangles: int
    n_blocks: int | None
    q_min: float
    q_mean: float
    q_p01: float
    irregular_interior: int
    """Interior vertices of valence other than 6."""
    irregular_boundary: int
    """Boundary vertices of valence other than 4."""
    irregular_boundary_fitted: int
    """Boundary vertices whose triangles do not fit their angle, 60 degrees each."""
    irregularity: Irregularity
    edge_ratio: EdgeRatio


def input_measures(size: SizeField) -> Measures:
    """Return the measures of the mesh that carries a size field."""
    log_h = size.log_h[size.mesh.topology.edges]
    along = (log_h[:, :1] * (1 - NODES) + log_h[:, 1:] * (1 + NODES)) / 2
    return _measures(size.mesh, None, edge_ratio(size.mesh.edge_lengths, along))


def layout_measures(layout: BlockLayout) -> Measures:
    """Return the measures of the blocks with straight sides, against s h.

    n_triangles is that of the grid.
    """
    n = layout.n_blocks
    ratio = conformity(layout.domain, layout.placed, _log_h(layout) + np.log(layout.side))
    return _measures(layout.mesh, n, ratio, n_triangles=n * layout.side**2)


def grid_measures(grid: BlockGrid) -> Measures:
    """Return the measures of the triangles, against h."""
    ratio = conformity(grid.layout.domain, grid.placed, _log_h(grid.layout))
    return _measures(grid.mesh, grid.layout.n_blocks, ratio)


def target_conformity(layout: BlockLayout) -> EdgeRatio:
    """Return the edges of blocks against the target, s h with all its limits."""
    domain = layout.domain
    return conformity(domain, layout.placed, np.log(layout.target.length / domain.scale))


def conformity(domain: Domain, placed: PlacedMesh, log_size: Floats) -> EdgeRatio:
    """Return how edges follow a size; log_size is at the domain's points, in its unit."""
    edges = placed.topology.edges
    start, end = placed.points[edges].swapaxes(0, 1)
    at = (start[:, None] * (1 - NODES[:, None]) + end[:, None] * (1 + NODES[:, None])) / 2
    hints = np.repeat(placed.hints[edges[:, 0]], len(NODES))
    along = _at(domain, log_size, at.reshape(-1, 2), hints).reshape(-1, len(NODES))
    return edge_ratio(np.linalg.norm(end - start, axis=1), along)


def edge_ratio(lengths: Floats, log_size: Floats) -> EdgeRatio:
    """Return the spread of integral ds / size; log_size at the five points of each edge, (n_edges, 5).

    >>> round(edge_ratio(np.array([2.0, 2.0]), np.zeros((2, 5))).p50, 6)
    2.0
    """
    ratio = lengths * (np.exp(-log_size) @ WEIGHTS) / 2
    low, middle, high = np.percentile(ratio, [5, 50, 95])
    return EdgeRatio(float(low), float(middle), float(high), float(np.sqrt((np.log(ratio) ** 2).mean())))


def boundary_deviation(grid: BlockGrid) -> tuple[float, float]:
    """Return how far the grid's lines lie from those of the domain, the most and the 99th percentile, in h.

    Distances both ways: from the domain's boundary points to the grid's sides, and from five points of
    every side of the grid to the domain's boundary. Interfaces count as boundary.
    """
    import shapely

    domain, placed = grid.layout.domain, grid.placed
    triangle, k = np.nonzero(placed.codes >= 0)
    ends = placed.triangles[triangle[:, None], np.stack([(k + 1) % 3, (k + 2) % 3], axis=1)]
    sides = placed.points[ends]
    start, end = sides.swapaxes(0, 1)
    at = (start[:, None] * (1 - NODES[:, None]) + end[:, None] * (1 + NODES[:, None])) / 2
    samples = at.reshape(-1, 2)
    log_h = _log_h(grid.layout)
    unit = np.exp(_at(domain, log_h, samples, np.repeat(placed.hints[ends[:, 0]], len(NODES))))
    triangle, k = np.nonzero(domain.side_codes >= 0)
    shore = domain.triangles[triangle[:, None], np.stack([(k + 1) % 3, (k + 2) % 3], axis=1)]
    nodes = np.unique(shore)

    def distances(points: Floats, segments: Floats) -> Floats:
        tree = shapely.STRtree(shapely.linestrings(segments))
        return np.asarray(
            tree.query_nearest(shapely.points(points), all_matches=False, return_distance=True)[1]
        )

    off = np.concatenate(
        [
            distances(samples, domain.points[shore]) / unit,
            distances(domain.points[nodes], sides) / np.exp(log_h[nodes]),
        ]
    )
    return float(off.max()), float(np.percentile(off, 99))


def least_time_step(mesh: Mesh, depth: Floats, scale: Floats | None = None) -> float | None:
    """Return the smallest edge / sqrt(g depth), seconds, where depth, (n_points,) in metres, is positive.

    The deeper end of an edge counts. scale is the plane's length per true metre at each point. None on land.
    """
    ends = mesh.topology.edges
    lengths = mesh.edge_lengths / (1.0 if scale is None else scale[ends].mean(axis=1))
    deeper = depth[ends].max(axis=1)
    is_wet = deeper > 0
    return float((lengths[is_wet] / np.sqrt(GRAVITY * deeper[is_wet])).min()) if is_wet.any() else None


def _measures(mesh: Mesh, n_blocks: int | None, ratio: EdgeRatio, n_triangles: int | None = None) -> Measures:
    topology, is_irregular = mesh.topology, mesh.vertex_irregularity != 0
    fitted = fitted_boundary_irregularity(topology, quality.angles(mesh.corner_edge_lengths))
    return Measures(
        n_triangles=mesh.n_triangles if n_triangles is None else n_triangles,
        n_blocks=n_blocks,
        q_min=float(mesh.qualities.min()),
        q_mean=float(mesh.qualities.mean()),
        q_p01=float(np.percentile(mesh.qualities, 1)),
        irregular_interior=int(np.count_nonzero(is_irregular & ~topology.is_boundary)),
        irregular_boundary=int(np.count_nonzero(is_irregular & topology.is_boundary)),
        irregular_boundary_fitted=int(np.count_nonzero(fitted)),
        irregularity=mesh.irregularity,
        edge_ratio=ratio,
    )


def _log_h(layout: BlockLayout) -> Floats:
    """Return log h of the input at the domain's points, (n_points,), in the domain's unit."""
    return np.asarray(layout.size.log_h[layout.domain.source] - np.log(layout.domain.scale))


def _at(domain: Domain, values: Floats, points: Floats, hints: Ints) -> Floats:
    """Return values at the domain's points interpolated at other points near the triangles hints."""
    from .kernel.walk import locate

    triangle, shares = locate(domain.points, domain.triangles, points, hints)
    return np.asarray((shares * values[domain.triangles[triangle, :3]]).sum(axis=1))
