"""Rows in the order of a curve that fills the plane, so that what is near in space is near in memory.

[Hilbert 1891, Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck].
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Floats, Ints
from .kinds import FROZEN
from .placed import PlacedMesh

LEVELS = 16
"""Cells of the curve are the 2^-LEVELS th part of the extent."""


def hilbert(points: Floats) -> Ints:
    """Return the place of each point, (n, 2), along Hilbert's curve over their bounding square, (n,).

    >>> hilbert(np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]])).argsort().tolist()
    [0, 1, 2, 3]
    """
    low, extent = points.min(axis=0), max(float(np.ptp(points, axis=0).max()), 1e-300)
    most = 2**LEVELS - 1
    x, y = ((points - low) / extent * most).astype(np.int64).T.copy()
    place = np.zeros(len(points), dtype=np.int64)
    for level in range(LEVELS - 1, -1, -1):
        right, upper = (x >> level) & 1, (y >> level) & 1
        place = 4 * place + ((3 * right) ^ upper)
        # the lower quarters hold the curve turned: x and y change places, on the right backwards
        is_lower, is_turned = upper == 0, (upper == 0) & (right == 1)
        x, y = np.where(is_turned, most - x, x), np.where(is_turned, most - y, y)
        x, y = np.where(is_lower, y, x), np.where(is_lower, x, y)
    return place


def in_order(mesh: PlacedMesh) -> PlacedMesh:
    """Return the mesh with its rows along the curve; frozen vertices first and as they were for grafts."""
    order = np.argsort(np.where(mesh.kinds == FROZEN, -1, hilbert(mesh.points)), kind="stable")
    new_index = np.empty_like(order)
    new_index[order] = np.arange(len(order))
    middles = mesh.points[mesh.triangles].mean(axis=1)
    rows = np.argsort(hilbert(middles), kind="stable")
    return replace(
        mesh,
        points=mesh.points[order],
        triangles=new_index[mesh.triangles[rows]],
        codes=mesh.codes[rows],
        kinds=mesh.kinds[order],
        curves=mesh.curves[order],
        arcs=mesh.arcs[order],
        goals=mesh.goals[order],
        hints=mesh.hints[order],
    )
