"""Poor spots of a fine grid eased: nodes near them move for quality alone, those on curves along them.

Every spot is judged by itself. At the tip of a sharp bay one triangle takes the ear, the others of its block
draw back to where the bay is wide.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Bools, Floats, Ints, sums_by
from ..mesh.components import connected_labels
from .domain import Domain
from .kinds import CORNER, INTERIOR, JUNCTION, SLIDING
from .lack import POOR, lacks, qualities
from .placed import PlacedMesh, grown
from .weights import TRIANGLES

RINGS = 4
"""How many triangles from a poor one nodes move."""

POWERS = ((1.0, 2.0, 4.0, 8.0), (1.0,), (1.0,), (1.0,), (1.0, 2.0))
"""Exponents of 1/q, a tuple a round: high ones raise the worst triangle, 1 gives up on it for all others."""

SWEEPS = 80
"""Relaxations of every such node in a round."""

QUALITY = replace(TRIANGLES, size=0.0, bend=0.0)
"""Weights of quality alone."""

FINER = -1.0
"""Added to the log of the wanted edge: steps are short, and thin triangles tell inverted ones from flat."""


def eased(domain: Domain, mesh: PlacedMesh, log_size: Floats) -> PlacedMesh:
    """Return the mesh with its poor spots better: fewer inverted, else a lesser sum of lacks.

    log_size is the log of the wanted edge length of this mesh at the domain's points. No spot gets worse.
    """
    for powers in POWERS:
        if not (qualities(mesh) < POOR).any():
            break
        mesh = _eased_once(domain, mesh, log_size, powers)
    return mesh


def _eased_once(domain: Domain, mesh: PlacedMesh, log_size: Floats, powers: tuple[float, ...]) -> PlacedMesh:
    before = qualities(mesh)
    moves = np.zeros(len(mesh.points), dtype=bool)
    moves[mesh.triangles[grown(mesh, before < POOR, RINGS)]] = True
    moves &= (mesh.kinds == INTERIOR) | (mesh.kinds == SLIDING)
    moved = _relaxed(domain, mesh, log_size, moves, powers)
    spot = _spots(mesh, moves)
    n_spots = int(spot.max()) + 1
    spot_of_triangle = np.where(moves[mesh.triangles], spot[mesh.triangles], -1).max(axis=1)
    near = spot_of_triangle >= 0
    after = qualities(moved)

    def summed(values: Floats | Bools) -> Floats:
        return sums_by(spot_of_triangle[near], values[near], n_spots)

    inverted = summed(after <= 0) - summed(before <= 0)
    is_better = (inverted < 0) | ((inverted == 0) & (summed(lacks(after)) < summed(lacks(before))))
    takes = moves & is_better[spot]
    return replace(
        mesh,
        points=np.where(takes[:, None], moved.points, mesh.points),
        arcs=np.where(takes, moved.arcs, mesh.arcs),
    )


def _relaxed(
    domain: Domain, mesh: PlacedMesh, log_size: Floats, moves: Bools, powers: tuple[float, ...]
) -> PlacedMesh:
    from .kernel.exchange import load, unload
    from .kernel.schedule import polish

    held = replace(mesh, kinds=np.where(~moves & (mesh.kinds != JUNCTION), CORNER, mesh.kinds))
    state = load(domain, held, log_size, room=1.0, weights=QUALITY, offset=FINER)
    polish(state, SWEEPS // len(powers), powers)
    return unload(state)


def _spots(mesh: PlacedMesh, moves: Bools) -> Ints:
    """Return the spot of each point that moves, (n_points,): points joined by edges."""
    edges = mesh.topology.edges
    return connected_labels(edges[moves[edges].all(axis=1)], len(moves))
