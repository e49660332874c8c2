"""Calculus of values at the vertices: gradient, stiffness and mass of piecewise linear functions.

Intrinsic: in space the gradient of a triangle lies in its plane.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array, diags_array

from ..arrays import Floats, Ints, sums_by
from .mesh import Mesh


def gradient(mesh: Mesh, values: Floats) -> Floats:
    """Return the gradient of vertex values in each triangle, (n_triangles, 2 or 3), value/length."""
    a, b, c = mesh.triangles.T
    start = values[a]
    along_u, along_v = values[b] - start, values[c] - start
    if mesh.is_planar:
        (ux, vx), (uy, vy) = ((axis[b] - axis[a], axis[c] - axis[a]) for axis in mesh.points.T)
        twice = 2 * mesh.areas
        slope = np.empty((mesh.n_triangles, 2))
        slope[:, 0] = (along_u * vy - along_v * uy) / twice
        slope[:, 1] = (along_v * ux - along_u * vx) / twice
        return slope
    u, v = mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]
    uu, uv, vv = (np.einsum("ij,ij->i", p, q) for p, q in ((u, u), (u, v), (v, v)))
    slope = (vv * along_u - uv * along_v)[:, None] * u + (uu * along_v - uv * along_u)[:, None] * v
    return np.asarray(slope / (4 * mesh.areas**2)[:, None])


def corner_means(triangles: Ints, values: Floats) -> Floats:
    """Return the mean of the values at the corners of each triangle, (n_triangles, ...).

    >>> corner_means(np.array([[0, 1, 2]]), np.array([1.0, 2.0, 6.0]))
    array([3.])
    """
    a, b, c = (values[corner] for corner in triangles.T)
    return np.asarray((a + b + c) / 3)


def cotangents(mesh: Mesh) -> Floats:
    """Return the cotangent of the angle at each corner, (n_triangles, 3)."""
    lengths = mesh.corner_edge_lengths
    total = np.einsum("ij,ij->i", lengths, lengths)
    return np.asarray((total[:, None] - 2 * lengths**2) / (4 * mesh.areas)[:, None])


def edge_weights(mesh: Mesh, conductivity: Floats | None = None) -> Floats:
    """Return what the stiffness matrix holds for each edge, sign turned, (n_edges,).

    Half the conductivity times the cotangent of the angle opposite, summed over the triangles beside it.
    """
    opposite = (
        cotangents(mesh) / 2 if conductivity is None else cotangents(mesh) * (conductivity / 2)[:, None]
    )
    return sums_by(mesh.topology.cell_edges, opposite[:, [2, 0, 1]], len(mesh.topology.edges))


def between_ends(mesh: Mesh, weights: Floats) -> csr_array:
    """Return the symmetric matrix with the weight of each edge between its ends, (n_points, n_points)."""
    others, edges, start = mesh.topology.links
    return csr_array((weights[edges], others, start), shape=(mesh.n_points, mesh.n_points))


def stiffness(mesh: Mesh, conductivity: Floats | None = None) -> csr_array:
    """Return the stiffness matrix, (n_points, n_points): integral of c grad(phi_i) . grad(phi_j).

    conductivity is one value c a triangle (default 1).
    """
    matrix = between_ends(mesh, -edge_weights(mesh, conductivity))
    return csr_array(matrix - diags_array(matrix.sum(axis=1)))


def vertex_areas(mesh: Mesh) -> Floats:
    """Return a third of the area of the triangles around each vertex, (n_points,), length**2."""
    return to_corners(mesh, mesh.areas / 3)


def to_vertices(mesh: Mesh, triangle_values: Floats) -> Floats:
    """Return the area-weighted mean of triangle values around each vertex, (n_points, ...)."""
    values = triangle_values.reshape(mesh.n_triangles, -1)
    sums = [to_corners(mesh, column * mesh.areas) for column in values.T]
    means = np.column_stack(sums) / to_corners(mesh, mesh.areas)[:, None]
    return np.asarray(means.reshape(mesh.n_points, *triangle_values.shape[1:]))


def to_corners(mesh: Mesh, triangle_values: Floats) -> Floats:
    """Return the sum of the values of the triangles around each vertex, (n_points,)."""
    return np.asarray(sum(sums_by(corner, triangle_values, mesh.n_points) for corner in mesh.triangles.T))
