"""Calculus of values at the vertices: gradient, stiffness and mass of piecewise linear functions.

Intrinsic: in space the gradient of a triangle lies in its plane.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csr_array

from ..arrays import Floats, sums_by
from .mesh import Mesh


def hat_gradients(mesh: Mesh) -> Floats:
    """Return the gradient of each corner's hat function, (n_triangles, 3, 2 or 3), 1/length."""
    corners = mesh.points[mesh.triangles]
    opposite = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]
    if mesh.is_planar:
        turned = np.stack([-opposite[..., 1], opposite[..., 0]], axis=-1)
    else:
        normal = np.cross(opposite[:, 2], -opposite[:, 1])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        turned = np.cross(normal[:, None, :], opposite)
    result: Floats = turned / (2 * mesh.areas)[:, None, None]
    return result


def gradient(mesh: Mesh, values: Floats) -> Floats:
    """Return the gradient of vertex values in each triangle, (n_triangles, 2 or 3), value/length."""
    result: Floats = np.einsum("tci,tc->ti", hat_gradients(mesh), values[mesh.triangles])
    return result


def stiffness(mesh: Mesh, conductivity: Floats | None = None) -> csr_array:
    """Return the stiffness matrix, (n_points, n_points): integral of c grad(phi_i) . grad(phi_j).

    conductivity is one value c a triangle (default 1).
    """
    hats = hat_gradients(mesh)
    weight = mesh.areas if conductivity is None else mesh.areas * conductivity
    local = np.einsum("tci,tdi,t->tcd", hats, hats, weight)
    rows = np.repeat(mesh.triangles, 3, axis=1).ravel()
    columns = np.tile(mesh.triangles, (1, 3)).ravel()
    return coo_array((local.ravel(), (rows, columns)), shape=(mesh.n_points, mesh.n_points)).tocsr()


def vertex_areas(mesh: Mesh) -> Floats:
    """Return a third of the area of the triangles around each vertex, (n_points,), length**2."""
    return sums_by(mesh.triangles, np.repeat(mesh.areas / 3, 3), mesh.n_points)


def to_vertices(mesh: Mesh, triangle_values: Floats) -> Floats:
    """Return the area-weighted mean of triangle values around each vertex, (n_points, ...)."""
    values = triangle_values.reshape(mesh.n_triangles, -1) * mesh.areas[:, None]
    flat = mesh.triangles.ravel()
    sums = [sums_by(flat, np.repeat(column, 3), mesh.n_points) for column in values.T]
    area = sums_by(flat, np.repeat(mesh.areas, 3), mesh.n_points)
    result: Floats = (np.column_stack(sums) / area[:, None]).reshape(
        mesh.n_points, *triangle_values.shape[1:]
    )
    return result
