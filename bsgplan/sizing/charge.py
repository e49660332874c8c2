"""The irregularity budget of a size field: the charge that its curvature demands, before any block is laid.

sum of iota over the interior vertices of D = -(3/pi) * flux of grad(log h) out of D: Gauss-Bonnet in the
metric h^-2 |dx|^2 ([Bunin], "A continuum theory for unstructured mesh generation in two dimensions"), whose
discrete form is Eq. 16 of [Zint & Grosso]. Unchanged under h -> c h, so a block layout has the budget of
its refinement. The gradient is averaged over a few local sizes first; it is continuous across edges, so the
charges of regions add up to that of the domain.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Floats, Ints, sums_by
from ..mesh import Mesh
from ..mesh.operators import to_vertices
from ..mesh.quality import angles, lengths
from .diffusion import gently

if TYPE_CHECKING:
    from .field import SizeField

REACH = 3.0
"""Smoothing length of the gradient in local sizes: the noise of one region is then 0.05 to 0.1 charges."""

NOISE = 0.1
"""Noise floor of the charge of a region at least five sizes wide, in units of iota."""


def edge_fluxes(size: SizeField) -> Floats:
    """Return the charge that flows through corner edges outwards, (n_triangles, 3), in units of iota.

    Column i belongs to the edge from corner i to corner i + 1, -(3/pi) g . n times its length; the two
    triangles of an edge have opposite values. On a surface its own curvature is added, -(3/pi) times the
    angle that is missing at corner i, so that a closed one has -6 chi in all.
    """
    mesh, slope = size.mesh, wide_slope(size)
    flux = _planar_fluxes(mesh, slope) if mesh.is_planar else _surface_fluxes(mesh, slope)
    return np.asarray(-3 / np.pi * flux)


def _planar_fluxes(mesh: Mesh, slope: Floats) -> Floats:
    """Return the flux of the slope through corner edges outwards, (n_triangles, 3)."""
    (x, y), (p, q) = (([axis[mesh.triangles.T] for axis in vectors.T]) for vectors in (mesh.points, slope))
    flux = np.empty(mesh.triangles.shape)
    for k, after in enumerate((1, 2, 0)):
        flux[:, k] = (y[after] - y[k]) * (p[after] + p[k]) - (x[after] - x[k]) * (q[after] + q[k])
    return np.asarray(flux / 2)


def _surface_fluxes(mesh: Mesh, slope: Floats) -> Floats:
    """Return the flux of the slope through corner edges outwards, and the curvature of the corners."""
    points, slopes = ([vectors[c] for c in mesh.triangles.T] for vectors in (mesh.points, slope))
    normal = np.cross(points[1] - points[0], points[2] - points[0])
    normal /= lengths(normal)[:, None]
    flux = np.empty(mesh.triangles.shape)
    for k, after in enumerate((1, 2, 0)):
        along, both = points[after] - points[k], slopes[after] + slopes[k]
        flux[:, k] = np.einsum("ti,ti->t", np.cross(along, normal), both) / 2
    return _balanced(mesh, flux) + _corner_curvature(mesh)


def _balanced(mesh: Mesh, flux: Floats) -> Floats:
    """Return fluxes that are opposite on the two triangles of an edge, whose planes may differ."""
    edge = mesh.topology.cell_edges
    is_first = mesh.topology.edge_cells[edge, 0] == np.arange(mesh.n_triangles)[:, None]
    sign = np.where(is_first, 1.0, -1.0)
    n_sides = np.where(mesh.topology.is_boundary_edge, 1, 2)
    through = sums_by(edge, sign * flux, len(n_sides)) / n_sides
    return np.asarray(sign * through[edge])


def _corner_curvature(mesh: Mesh) -> Floats:
    """Return each corner's share of the curvature of its vertex, 2 pi less its angles, (n_triangles, 3)."""
    corner = angles(mesh.corner_edge_lengths)
    missing = 2 * np.pi - sums_by(mesh.triangles, corner, mesh.n_points)
    missing[mesh.topology.is_boundary] = 0.0
    return np.asarray((missing / mesh.topology.n_cells_at)[mesh.triangles])


def region_charges(label: Ints, fluxes: Floats) -> Floats:
    """Return the charge inside each region, (n_regions,); label from 0, one a triangle."""
    return sums_by(label, fluxes.sum(axis=1), int(label.max()) + 1)


def wide_slope(size: SizeField, reach: float = REACH) -> Floats:
    """Return grad(log h) at the vertices, averaged over reach local sizes, (n_points, 2 or 3), 1/length.

    What is averaged is grad(h) = h grad(log h), which is constant where h grows linearly from a wall; the
    average is gentle, see `diffusion.gently`.
    """
    mesh, h = size.mesh, size.triangle_h
    growth = to_vertices(mesh, size.triangle_slope * h[:, None])
    return size.diffusion.filtered(growth, gently, reach) / size.h[:, None]
