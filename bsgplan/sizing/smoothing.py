"""Fit a smooth function to values on a mesh without bending what is linear.

The smoother penalises curvature, as the jump of the gradient across edges, and not slope: a field linear in
space passes unchanged up to the wall, where plain diffusion would flatten it within one smoothing length.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.linalg import LinearOperator, cg

from ..arrays import Floats, sums_by
from ..mesh import Mesh
from ..mesh.operators import between_ends, cotangents
from .diffusion import SLIVER

SOLVER_TOLERANCE = 1e-4
"""Relative residual of the smoothers: sizes are known to a few percent, so four digits are plenty."""


def gradient_jumps(mesh: Mesh) -> csr_array:
    """Return the jump of the normal gradient across each interior edge, (n_interior_edges, n_points).

    Dimensionless: the jump times the length of the edge, that is h^2 / sqrt(3) times the second derivative
    across it. Zero for a linear field, also at the wall. In cotangents: cot a + cot b for the corner opposite
    the edge a b of a triangle, -cot b for a, -cot a for b.
    """
    topology, cotangent = mesh.topology, cotangents(mesh)
    damping = np.minimum(mesh.qualities / SLIVER, 1.0)
    n_edges, own = len(topology.edges), np.arange(mesh.n_triangles)
    least = np.minimum(*damping[topology.edge_cells.T])  # of boundary edges any: they are dropped below
    columns, values = np.empty((n_edges, 4), dtype=np.int32), np.zeros((n_edges, 4))
    columns[:, :2] = topology.edges
    for k, edge in enumerate(topology.cell_edges.T):
        start, end = cotangent[:, k], cotangent[:, (k + 1) % 3]
        is_turned = mesh.triangles[:, k] > mesh.triangles[:, (k + 1) % 3]
        values[:, 0] -= sums_by(edge, np.where(is_turned, start, end), n_edges)
        values[:, 1] -= sums_by(edge, np.where(is_turned, end, start), n_edges)
        side = 2 + (topology.edge_cells[edge, 0] != own)
        columns[edge, side] = mesh.triangles[:, (k + 2) % 3]
        values[edge, side] = start + end
    inner = np.flatnonzero(~topology.is_boundary_edge)
    values = values[inner] * least[inner, None]
    rows = np.arange(0, 4 * len(inner) + 1, 4)
    return csr_array((values.ravel(), columns[inner].ravel(), rows), shape=(len(inner), mesh.n_points))


def fit_edges(mesh: Mesh, edge_values: Floats, reach: float) -> Floats:
    """Return vertex values whose means along the edges fit edge_values, (n_points,).

    Minimises sum over edges of ((u_i + u_j)/2 - value)^2 plus reach^4 times the squared curvature; reach
    is the smoothing length in local edge lengths. Fits are exact where the values are linear in space.
    With 3 edges a vertex in 3 directions the squared jumps sum to 3/8 (h^2 u_xx)^2 a vertex, and the fit
    weighs 3 a vertex: hence 8 reach^4 on the jumps, so that waves of h / reach are halved.
    """
    level = edge_values.mean()  # taken out, as the solver's tolerance is relative: units do not matter
    edge_values = edge_values - level
    i, j = mesh.topology.edges.T
    n = mesh.n_points
    degree = mesh.topology.valence
    total = sums_by(i, edge_values, n) + sums_by(j, edge_values, n)
    upper = between_ends(mesh, np.full(len(i), 0.25))
    lower = upper.T

    def normal(v: Floats) -> Floats:
        return np.asarray(upper @ v + lower @ v + degree / 4 * v)

    return level + _regularised(mesh, normal, degree / 4, total / 2, total / degree, reach)


def smooth(mesh: Mesh, values: Floats, reach: float) -> Floats:
    """Return vertex values smoothed over reach local edge lengths, (n_points,), linear fields unchanged."""
    level = values.mean()  # see `fit_edges`
    v = values - level
    three = np.full(mesh.n_points, 3.0)
    return level + _regularised(mesh, lambda u: 3 * u, three, 3 * v, v, reach)


def _regularised(
    mesh: Mesh,
    normal: Callable[[Floats], Floats],
    diagonal: Floats,
    right: Floats,
    start: Floats,
    reach: float,
) -> Floats:
    """Return the solution of (N + 8 reach^4 J^T J) u = right by conjugate gradients, J the gradient jumps."""
    jumps = gradient_jumps(mesh)
    back, factor = jumps.T, 8 * reach**4  # 8: see `fit_edges`
    diagonal = diagonal + factor * sums_by(jumps.indices, jumps.data**2, mesh.n_points)
    shape = (mesh.n_points, mesh.n_points)

    def product(v: Floats) -> Floats:
        return np.asarray(normal(v) + factor * (back @ (jumps @ v)))

    matrix = LinearOperator(shape, matvec=product, dtype=np.float64)
    inverse = LinearOperator(shape, matvec=lambda v: v / diagonal, dtype=np.float64)
    solution, _ = cg(matrix, right, x0=start, rtol=SOLVER_TOLERANCE, maxiter=500, M=inverse)
    return np.asarray(solution, dtype=np.float64)
