"""Size fields that blocks can follow: limited in gradient, or capped at a multiple of the finest size."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from ..arrays import Bools, Floats, Ints
from ..mesh import Mesh
from .field import EQUILATERAL, SizeField


def limit_gradient(mesh: Mesh, size: Floats, slope: float) -> Floats:
    """Return the largest field below size whose gradient nowhere exceeds slope, (n_points,), length.

    min over y of size(y) + slope * distance(x, y), by Dijkstra from all points at once. Distances run along
    edges and across pairs of triangles, at most 4 % longer than straight ones on regular meshes.

    >>> mesh = Mesh(np.array([[0.0, 0], [1, 0], [0, 1]]), np.array([[0, 1, 2]]))
    >>> limit_gradient(mesh, np.array([1.0, 5.0, 1.2]), 0.5)
    array([1. , 1.5, 1.2])
    """
    links, lengths = _links(mesh)
    first, second = links.T
    is_steep = np.abs(size[first] - size[second]) > slope * lengths
    if not is_steep.any():
        return size.copy()
    n = mesh.n_points
    source = np.full(n, n)
    weights = np.concatenate([slope * lengths, size])
    graph = coo_array(
        (weights, (np.r_[first, source], np.r_[second, np.arange(n)])), shape=(n + 1, n + 1)
    ).tocsr()
    reached = dijkstra(graph + graph.T, indices=n)
    return np.minimum(size, np.asarray(reached[:n], dtype=np.float64))


def gradient_limited_blocks(size: SizeField, side: float, slope: float, inside: Bools) -> float:
    """Return the blocks of a layout whose block size s h is limited in gradient: integral of 1 / block area.

    side is s; H is s h where |grad H| <= slope allows it. Counted over the triangles inside, (n_triangles,).
    """
    limited = limit_gradient(size.mesh, side * size.h, slope)
    return _count(size, np.exp(np.log(limited)[size.mesh.triangles].mean(axis=1)), inside)


def capped_triangles(size: SizeField, cap: Floats, inside: Bools) -> float:
    """Return the triangles of a mesh of size min(h, cap) inside; cap and inside are one value a triangle."""
    return _count(size, np.minimum(size.triangle_h, cap), inside)


def _count(size: SizeField, triangle_size: Floats, inside: Bools) -> float:
    return float((size.mesh.areas / (EQUILATERAL * triangle_size**2))[inside].sum())


@lru_cache(maxsize=1)
def _links(mesh: Mesh) -> tuple[Ints, Floats]:
    """Return edges and the diagonals of pairs of triangles, (n, 2), and their lengths."""
    topology = mesh.topology
    inner = np.flatnonzero(~topology.is_boundary_edge)
    sides = topology.edge_cells[inner]
    ends = topology.edges[inner].sum(axis=1)
    tips = mesh.triangles[sides].sum(axis=2) - ends[:, None]
    start, end = mesh.points[tips].swapaxes(0, 1)
    across = np.linalg.norm(end - start, axis=1)
    a, b = mesh.points[topology.edges[inner]].swapaxes(0, 1)
    # the straight line must cross the edge itself; elsewhere the way round over an end point is the shortest
    over = [np.linalg.norm(start - p, axis=1) + np.linalg.norm(end - p, axis=1) for p in (a, b)]
    is_convex = _crosses(start, end, a, b)
    across = np.where(is_convex, across, np.minimum(*over))
    links = np.concatenate([topology.edges, tips])
    return links, np.concatenate([mesh.edge_lengths, across])


def _crosses(start: Floats, end: Floats, a: Floats, b: Floats) -> Bools:
    along = b - a
    square = (along**2).sum(axis=1)
    near, far = (((p - a) * along).sum(axis=1) / square for p in (start, end))
    d_near = np.linalg.norm(start - a - near[:, None] * along, axis=1)
    d_far = np.linalg.norm(end - a - far[:, None] * along, axis=1)
    where = (near * d_far + far * d_near) / (d_near + d_far)
    return np.asarray((where > 0) & (where < 1))
