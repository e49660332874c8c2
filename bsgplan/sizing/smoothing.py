"""Fit a smooth function to values on a mesh without bending what is linear.

The smoother penalises curvature, as the jump of the gradient across edges, and not slope: a field linear in
space passes unchanged up to the wall, where plain diffusion would flatten it within one smoothing length.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.linalg import LinearOperator, cg

from ..arrays import Floats, short_type, sums_by
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
    topology, corners = mesh.topology, mesh.triangles.ravel()
    ends = topology.edges.take(topology.inner_edges, axis=0)
    n = len(ends)
    cotangent = cotangents(mesh)
    of_start, of_end = cotangent.ravel(), np.roll(cotangent, -1, axis=1).ravel()
    values = np.zeros((n, 4))
    low, high, *opposite = values.T
    for side, beyond in zip(topology.inner_sides.T, opposite, strict=True):
        at_start, at_end = of_start[side], of_end[side]
        is_along = corners[side] == ends[:, 0]
        low -= np.where(is_along, at_end, at_start)
        high -= np.where(is_along, at_start, at_end)
        np.add(at_start, at_end, out=beyond)
    damping = np.minimum(mesh.qualities / SLIVER, 1.0)
    values *= np.minimum(*(damping[cell] for cell in topology.neighbours.T))[:, None]
    start = np.arange(0, 4 * n + 1, 4, dtype=short_type(4 * n))
    columns = np.concatenate([ends, topology.tips], axis=1, dtype=start.dtype, casting="same_kind")
    return csr_array((values.ravel(), columns.ravel(), start), shape=(n, mesh.n_points))


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
    quarters = between_ends(mesh, np.full(len(i), 0.25))

    def normal(v: Floats) -> Floats:
        return np.asarray(quarters @ v + degree / 4 * v)

    return level + _regularised(mesh, normal, degree / 4, total / 2, total / degree, reach)


def smooth(mesh: Mesh, values: Floats, reach: float, weights: Floats | None = None) -> Floats:
    """Return vertex values smoothed over reach local edge lengths, (n_points,), linear fields unchanged.

    weights, (n_points,), say how much each value counts; only their ratios matter.
    """
    level = values.mean()  # see `fit_edges`
    v = values - level
    w = np.full(mesh.n_points, 3.0) if weights is None else weights * (3 / np.median(weights))
    return level + _regularised(mesh, lambda u: w * u, w, w * v, v, reach)


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
