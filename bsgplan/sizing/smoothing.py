"""Fit a smooth function to values on a mesh without bending what is linear.

The smoother penalises curvature, as the jump of the gradient across edges, and not slope: a field linear in
space passes unchanged up to the wall, where plain diffusion would flatten it within one smoothing length.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array, dia_array
from scipy.sparse.linalg import LinearOperator, cg

from ..arrays import Floats
from ..mesh import Mesh
from ..mesh.operators import hat_gradients, stiffness, to_vertices, vertex_areas

SLIVER = 0.3
"""Mean ratio below which a triangle's stiffness is damped: cotangents of slivers grow without bound and
would tie their corners together. Real meshes have a mean ratio of .9; this touches under 1 % of them."""

SOLVER_TOLERANCE = 1e-4
"""Relative residual of the smoothers: sizes are known to a few percent, so four digits are plenty."""


def gradient_jumps(mesh: Mesh) -> csr_array:
    """Return the jump of the normal gradient across each interior edge, (n_interior_edges, n_points).

    Dimensionless: the jump times the length of the edge, that is h^2 / sqrt(3) times the second derivative
    across it. Zero for a linear field, also at the wall.
    """
    topology = mesh.topology
    hats = hat_gradients(mesh)
    edges = np.flatnonzero(~topology.is_boundary_edge)
    cells = topology.edge_cells[edges]
    rows, columns, values = [], [], []
    for side in (0, 1):
        cell = cells[:, side]
        corner = (np.argmax(topology.cell_edges[cell] == edges[:, None], axis=1) + 2) % 3
        opposite = hats[cell, corner]
        outward = -opposite / np.linalg.norm(opposite, axis=1, keepdims=True)
        rows.append(np.repeat(np.arange(len(edges)), 3))
        columns.append(mesh.triangles[cell].ravel())
        values.append(np.einsum("eci,ei->ec", hats[cell], outward).ravel())
    damping = np.minimum(mesh.qualities[cells].min(axis=1) / SLIVER, 1.0)
    weight = np.tile(np.repeat(mesh.edge_lengths[edges] * damping, 3), 2)
    entries = (weight * np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return csr_array(entries, shape=(len(edges), mesh.n_points))


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
    total = np.bincount(i, edge_values, n) + np.bincount(j, edge_values, n)
    rows = np.concatenate([i, j, np.arange(n)])
    columns = np.concatenate([j, i, np.arange(n)])
    weights = np.concatenate([np.full(2 * len(i), 0.25), degree / 4])
    normal = csr_array((weights, (rows, columns)), shape=(n, n))
    return level + _regularised(mesh, normal, total / 2, total / degree, reach)


def smooth(mesh: Mesh, values: Floats, reach: float) -> Floats:
    """Return vertex values smoothed over reach local edge lengths, (n_points,), linear fields unchanged."""
    identity = csr_array(_diagonal(np.full(mesh.n_points, 3.0)))
    level = values.mean()  # see `fit_edges`
    return level + _regularised(mesh, identity, 3 * (values - level), values - level, reach)


def diffuse(mesh: Mesh, values: Floats, length: Floats) -> Floats:
    """Return vertex values diffused over a local length, (n_points, ...): (M + K_{length^2}) v = M values.

    length is one value a triangle, (n_triangles,). Keeps the mean; flattens at the wall.
    """
    mass = vertex_areas(mesh)
    matrix = csr_array(
        _diagonal(mass) + stiffness(mesh, length**2 * np.minimum(mesh.qualities / SLIVER, 1.0))
    )
    flat = values.reshape(mesh.n_points, -1)
    columns = [_solve(matrix, mass * column, column) for column in flat.T]
    result: Floats = np.column_stack(columns).reshape(values.shape)
    return result


def smooth_gradient(mesh: Mesh, triangle_gradient: Floats, length: Floats) -> Floats:
    """Return triangle gradients averaged to the vertices over a local length, (n_points, 2 or 3)."""
    return diffuse(mesh, to_vertices(mesh, triangle_gradient), length)


def _regularised(mesh: Mesh, normal: csr_array, right: Floats, start: Floats, reach: float) -> Floats:
    jumps = gradient_jumps(mesh)
    matrix = csr_array(normal + 8 * reach**4 * (jumps.T @ jumps))  # 8: see `fit_edges`
    return _solve(matrix, right, start)


def _solve(matrix: csr_array, right: Floats, start: Floats) -> Floats:
    diagonal = matrix.diagonal()
    inverse = LinearOperator(matrix.shape, matvec=lambda v: v / diagonal, dtype=np.float64)
    solution, _ = cg(matrix, right, x0=start, rtol=SOLVER_TOLERANCE, maxiter=500, M=inverse)
    return np.asarray(solution, dtype=np.float64)


def _diagonal(values: Floats) -> dia_array:
    return dia_array((values[None, :], [0]), shape=(len(values), len(values)))
