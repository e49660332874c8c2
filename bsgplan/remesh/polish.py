"""Vertices of an annealed mesh moved, more and more for its worst triangle; the topology as it is."""

from __future__ import annotations

from dataclasses import replace

from ..arrays import Floats
from ..blocks.anneal import POLISH
from ..blocks.domain import Domain
from ..blocks.lack import qualities
from ..blocks.placed import PlacedMesh
from ..blocks.weights import TRIANGLES


def polished(
    domain: Domain, mesh: PlacedMesh, log_size: Floats, *, size_weight: float, offset: float
) -> PlacedMesh:
    """Return the mesh with its vertices moved, sizes as they weigh; as it was where that is no better.

    log_size is the log of the wanted edge at the domain's points, offset what is added to it.
    """
    from ..blocks.kernel.exchange import load, unload
    from ..blocks.kernel.schedule import polish

    weights = replace(TRIANGLES, size=size_weight)
    state = load(domain, mesh, log_size, room=1.0, weights=weights, offset=offset)
    polish(state, POLISH)
    moved = unload(state)
    return moved if qualities(moved).min() > qualities(mesh).min() else mesh
