"""The fine grid smoothed: every triangle positive, sizes graded inside the blocks, its topology untouched."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Floats
from .domain import Domain
from .ease import eased
from .kinds import CORNER, SLIDING
from .lack import merit
from .placed import PlacedMesh
from .weights import TRIANGLES, Weights

SWEEPS = 7
"""Relaxations of every node at each exponent of the polish."""


def smooth(domain: Domain, mesh: PlacedMesh, log_size: Floats) -> PlacedMesh:
    """Return the mesh with its nodes moved, those on curves fixed unless triangles there are poor.

    log_size is the log of the wanted edge length of this mesh at the domain's points. The mesh is never worse
    than before by its `merit`: where sizes would cost quality, quality alone is asked for.
    """
    best = mesh
    fixed = replace(mesh, kinds=np.where(mesh.kinds == SLIDING, CORNER, mesh.kinds))
    for size_weight in (TRIANGLES.size, 0.0):
        moved = _relaxed(domain, fixed, log_size, replace(TRIANGLES, size=size_weight, bend=0.0))
        if merit(moved) >= merit(best):
            best = replace(mesh, points=moved.points)
        if merit(moved) >= merit(mesh):
            break
    return eased(domain, best, log_size)


def _relaxed(domain: Domain, mesh: PlacedMesh, log_size: Floats, weights: Weights) -> PlacedMesh:
    from .kernel.exchange import load, unload
    from .kernel.schedule import polish

    state = load(domain, mesh, log_size, room=1.0, weights=weights)
    polish(state, SWEEPS)
    return unload(state)
