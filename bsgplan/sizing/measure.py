"""Read the size field off a mesh's own edges, or take it from values the user names."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..errors import InvalidSize
from ..mesh import Mesh
from ..mesh.operators import to_vertices
from .field import SizeField, covering
from .smoothing import fit_edges, smooth

REACH = 0.7
"""Smoothing length of the size field in local edge lengths: waves shorter than four edges are quieted (the
noise of a mesh generator, 10 to 15 % an edge); the ends of a 28 -> 4 transition are hardly bent."""


def size_field(mesh: Mesh, *, reach: float = REACH) -> SizeField:
    """Return the size field of the mesh's own edges, smoothed over reach edges and calibrated.

    Calibrated: h is scaled so that `expected_triangles` is the number of triangles.

    >>> from bsgplan.mesh import Mesh
    >>> square = Mesh(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]), np.array([[0, 1, 2], [0, 2, 3]]))
    >>> round(size_field(square).expected_triangles, 9)
    2.0
    """
    log_h = fit_edges(mesh, np.log(mesh.edge_lengths), reach)
    return calibrated(SizeField(mesh, np.exp(log_h)), mesh.n_triangles)


def calibrated(size: SizeField, n_triangles: float) -> SizeField:
    """Return a size field scaled so that it expects so many triangles."""
    return SizeField(size.mesh, size.h * np.sqrt(size.expected_triangles / n_triangles), size.source)


def named_size_field(mesh: Mesh, values: Floats, name: str, *, reach: float = REACH) -> SizeField:
    """Return the size field of an array, one edge length a point or a triangle; never calibrated.

    Cell values are averaged to the points by area. Raises InvalidSize unless positive and finite.
    """
    return SizeField(mesh, np.exp(smooth(mesh, log_sizes(mesh, values, name), reach)), name)


def triangles_wanted(mesh: Mesh, values: Floats, name: str) -> float:
    """Return how many triangles the values of `named_size_field` ask for, before they are smoothed."""
    return float(covering(mesh, np.exp(log_sizes(mesh, values, name))).sum())


def log_sizes(mesh: Mesh, values: Floats, name: str) -> Floats:
    """Return the logarithm of sizes, one a point or a triangle, at the points, (n_points,).

    Raises InvalidSize as `named_size_field` does.
    """
    values = np.asarray(values, dtype=np.float64)
    if values.shape not in {(mesh.n_points,), (mesh.n_triangles,)}:
        raise InvalidSize(
            f"size {name!r} has shape {values.shape}; give a scalar a point ({mesh.n_points}) "
            f"or a triangle ({mesh.n_triangles})"
        )
    is_bad = ~(np.isfinite(values) & (values > 0))
    if is_bad.any():
        first = int(np.flatnonzero(is_bad)[0])
        raise InvalidSize(
            f"size {name!r} is {values[first]:g} at index {first} ({np.count_nonzero(is_bad)} such values); "
            "an edge length is positive and finite"
        )
    return np.log(values) if len(values) == mesh.n_points else to_vertices(mesh, np.log(values))
