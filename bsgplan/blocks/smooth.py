"""The fine grid smoothed: every triangle positive, sizes graded inside the blocks, its topology untouched."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Floats
from ..mesh.quality import corner_edge_lengths, mean_ratio, signed_areas
from .domain import Domain
from .kinds import CORNER, SLIDING
from .placed import PlacedMesh, grown

SWEEPS = 7
"""Relaxations of every node at each exponent of the polish."""

POOR = 0.3
"""Triangles under this mean ratio are mended with the boundary nodes beside them free to slide."""

RINGS = 4
"""How many triangles from a poor one nodes slide."""


def qualities(mesh: PlacedMesh) -> Floats:
    """Return the mean ratio of each triangle, negative where inverted, (n_triangles,)."""
    return mean_ratio(
        signed_areas(mesh.points, mesh.triangles), corner_edge_lengths(mesh.points, mesh.triangles)
    )


def smooth(domain: Domain, mesh: PlacedMesh, log_size: Floats) -> PlacedMesh:
    """Return the mesh with its nodes moved, those on curves fixed unless triangles there are poor.

    log_size is the log of the wanted edge length of this mesh at the domain's points. The worst triangle
    is never worse than before: where sizes would cost quality, quality alone is asked for.
    """
    best = mesh
    fixed = replace(mesh, kinds=np.where(mesh.kinds == SLIDING, CORNER, mesh.kinds))
    for size_weight in (0.5, 0.0):
        moved = _relaxed(domain, fixed, log_size, size_weight)
        if qualities(moved).min() > qualities(best).min():
            best = replace(mesh, points=moved.points)
        if qualities(moved).min() >= qualities(mesh).min():
            break
    if qualities(best).min() < POOR:
        near = np.zeros(len(best.points), dtype=bool)
        near[best.triangles[grown(best, qualities(best) < POOR, RINGS)]] = True
        loose = replace(best, kinds=np.where((best.kinds == SLIDING) & ~near, CORNER, best.kinds))
        moved = _relaxed(domain, loose, log_size, 0.1)
        if qualities(moved).min() > qualities(best).min():
            best = replace(mesh, points=moved.points, arcs=moved.arcs)
    return best


def _relaxed(domain: Domain, mesh: PlacedMesh, log_size: Floats, size_weight: float) -> PlacedMesh:
    from .kernel.exchange import load, unload
    from .kernel.schedule import polish

    state = load(domain, mesh, log_size, room=1.0, size_weight=size_weight, bend_weight=0.0)
    polish(state, SWEEPS)
    return unload(state)
