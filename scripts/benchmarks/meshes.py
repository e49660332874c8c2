"""Large graded meshes, made in a second and never stored: a mesh of cases/, mirrored over and over.

A case on a rectangle and its mirror images fit together edge by edge, so columns x rows of them are one
conforming mesh, unstructured within each tile; every point is moved a little, so that no two tiles are equal.
"""

from __future__ import annotations

import functools
from pathlib import Path

import numpy as np

import bsgplan
from bsgplan.arrays import Floats, Ints
from bsgplan.mesh import clean
from bsgplan.mesh.mesh import Mesh

CASES = Path(__file__).parents[2] / "cases"

STRIPES = 6
"""Columns of `stripes`: each is one transition, whatever the number of triangles."""

JITTER = 0.02
"""Standard deviation of the moves, in local edges: enough that no two tiles are equal."""


def stripes(n_triangles: int) -> Mesh:
    """Return about so many triangles in a few long transitions: cases/rectangle, six columns, many rows."""
    tile = _case("rectangle")
    return mirrored(tile, STRIPES, max(1, round(n_triangles / STRIPES / tile.n_triangles)))


def archipelago(n_triangles: int) -> Mesh:
    """Return about so many triangles around islands, five a tile: cases/islands in a square of tiles."""
    tile = _case("islands")
    n_tiles = max(1, round(n_triangles / tile.n_triangles))
    columns = max(1, round(n_tiles**0.5))
    return mirrored(tile, columns, max(1, round(n_tiles / columns)))


def mirrored(tile: Mesh, columns: int, rows: int) -> Mesh:
    """Return a rectangular tile and its mirror images side by side, joined along their sides."""
    low, high = tile.points.min(axis=0), tile.points.max(axis=0)
    unit = (tile.points - low) / (high - low)
    points, triangles = [], []
    for k in range(columns * rows):
        column, row = k % columns, k // columns
        turned = np.column_stack([_mirror(unit[:, 0], column), _mirror(unit[:, 1], row)])
        points.append(turned + np.array([column, row]))
        triangles.append(tile.triangles + k * tile.n_points)
    joined, index = _joined(np.concatenate(points), np.concatenate(triangles))
    size = (high - low) * joined
    return clean(_moved(size, index, (high - low) * (columns, rows)), index).mesh


def _mirror(share: Floats, k: int) -> Floats:
    return 1 - share if k % 2 else share


def _joined(points: Floats, triangles: Ints) -> tuple[Floats, Ints]:
    """Return points with those at one place made one; places are told apart to a millionth of a tile."""
    is_side = (np.abs(points - np.rint(points)) < 1e-6).any(axis=1)
    sides = np.flatnonzero(is_side)
    _, first, inverse = np.unique(
        np.rint(points[sides] * 1e6), axis=0, return_index=True, return_inverse=True
    )
    target = np.arange(len(points))
    target[sides] = sides[first[inverse.ravel()]]
    is_kept = target == np.arange(len(points))
    return points[is_kept], (np.cumsum(is_kept) - 1)[target][triangles]


def _moved(points: Floats, triangles: Ints, extent: Floats) -> Floats:
    """Return points moved at random, by a share of the shortest edge there; the outline stays in place."""
    shortest = np.full(len(points), np.inf)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        length = np.linalg.norm(points[triangles[:, a]] - points[triangles[:, b]], axis=1)
        np.minimum.at(shortest, triangles[:, a], length)
        np.minimum.at(shortest, triangles[:, b], length)
    step = np.random.default_rng(7).normal(0.0, JITTER, points.shape) * shortest[:, None]
    is_outline = (points < 1e-6 * extent) | (points > (1 - 1e-6) * extent)
    return np.asarray(np.where(is_outline, points, points + step))


@functools.cache
def _case(name: str) -> Mesh:
    return bsgplan.read(CASES / name / "mesh.msh").mesh
