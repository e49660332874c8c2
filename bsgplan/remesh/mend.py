"""Poor spots of an annealed part annealed again, each by itself, its rim frozen: what chance left there.

The same mesh comes back but for the patches around triangles under the least quality wanted where they are,
and a patch is exchanged only for one whose worst triangle is better.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..blocks.anneal import POLISH
from ..blocks.domain import Domain
from ..blocks.kinds import FROZEN, FROZEN_SIDE
from ..blocks.lack import qualities
from ..blocks.placed import PlacedMesh, grown
from ..blocks.weights import TRIANGLES
from ..mesh.components import connected_labels
from ..mesh.edges import edge_keys
from ..mesh.topology import topology

TURNS = ((3, 0.6), (4, 0.2), (4, 0.05), (6, 0.2))
"""Rings of triangles around a poor one that are annealed, and the weight of irregular vertices there."""

POWER_OF_PATCHES = 4.0
"""Exponent of 1/q while a patch is annealed: the worst triangle counts."""

HOT, COLD, SWEEPS, MOVES = 0.25, 0.03, 80, 2
"""First and last temperature, sweeps, moves a triangle and sweep."""

MOST_SPOTS = 60
"""Spots mended in a turn at most, the worst ones."""


@dataclass(frozen=True, eq=False)
class Patch:
    """Some triangles of a placed mesh, apart."""

    inside: Bools
    """Its triangles, (n_triangles,)."""
    mesh: PlacedMesh
    """They alone, the rim frozen, one vertex a fan."""
    source: Ints
    """Vertex of the whole that each of its vertices is."""


def mended(
    domain: Domain, mesh: PlacedMesh, log_size: Floats, least: Floats, *, seed: int, offset: float
) -> PlacedMesh:
    """Return a mesh whose triangles under a mean ratio were tried to be made better.

    least is that ratio in each triangle of the domain, (n_domain_triangles,). log_size is the log of the
    wanted edge at the domain's points, offset what is added to it.
    """
    for turn, (n_rings, weight) in enumerate(TURNS):
        better = []
        for number, centre in enumerate(spots(mesh, lacks(domain, mesh, least), n_rings)):
            patch = patch_of(mesh, around(mesh, centre, n_rings))
            made = annealed(domain, patch.mesh, log_size, seed + 1000 * turn + number, offset, weight)
            if worst_lack(domain, made, least) < worst_lack(domain, patch.mesh, least):
                better.append((patch, made))
        mesh = spliced(mesh, better)
    return mesh


def lacks(domain: Domain, mesh: PlacedMesh, least: Floats) -> Floats:
    """Return how far each triangle is under the mean ratio wanted where it lies, (n_triangles,)."""
    return np.asarray(least[holders(domain, mesh)] - qualities(mesh))


def worst_lack(domain: Domain, mesh: PlacedMesh, least: Floats) -> float:
    """Return how far the worst triangle is under what is wanted there; negative where none is."""
    return float(lacks(domain, mesh, least).max())


def holders(domain: Domain, mesh: PlacedMesh) -> Ints:
    """Return the triangle of the domain that holds the centroid of each triangle, (n_triangles,)."""
    from ..blocks.kernel.walk import locate

    centroids = mesh.points[mesh.triangles].mean(axis=1)
    return locate(domain.points, domain.triangles, centroids, mesh.hints[mesh.triangles[:, 0]])[0]


def patch_of(mesh: PlacedMesh, inside: Bools) -> Patch:
    """Return some triangles of a mesh apart, frozen where they meet the others."""
    corners = mesh.triangles[inside]
    whole, codes = mesh.topology, mesh.codes[inside]
    used, local = np.unique(corners, return_inverse=True)
    fan = topology(local.reshape(-1, 3), len(used)).corner_fan
    source = np.empty(int(fan.max()) + 1, dtype=np.int64)
    source[fan] = corners
    meets = np.zeros(len(mesh.points), dtype=bool)
    meets[mesh.triangles[~inside]] = True
    own = topology(fan, len(source))
    is_rim = own.is_boundary_edge[own.cell_edges[:, [1, 2, 0]]] & (mesh.neighbours[inside] >= 0)
    apart = PlacedMesh(
        points=mesh.points[source],
        triangles=fan,
        codes=np.where(is_rim, FROZEN_SIDE, codes),
        kinds=np.where(meets[source], FROZEN, mesh.kinds[source]),
        curves=mesh.curves[source],
        arcs=mesh.arcs[source],
        goals=mesh.goals[source] - (whole.valence[source] - own.valence),
        hints=mesh.hints[source],
    )
    return Patch(inside, apart, source)


def spliced(mesh: PlacedMesh, parts: Sequence[tuple[Patch, PlacedMesh]]) -> PlacedMesh:
    """Return the mesh with patches replaced by what was made of them; vertices that stay keep their order.

    No two patches have a triangle in common.
    """
    if not parts:
        return mesh
    outside = ~np.any([patch.inside for patch, _ in parts], axis=0)
    stays = np.zeros(len(mesh.points), dtype=bool)
    stays[mesh.triangles[outside]] = True
    for patch, _ in parts:
        stays[patch.source[patch.mesh.kinds == FROZEN]] = True
    number = np.where(stays, np.cumsum(stays) - 1, -1)
    n = int(np.count_nonzero(stays))
    triangles, codes, new = [number[mesh.triangles[outside]]], [mesh.codes[outside]], []
    for patch, made in parts:
        is_new = made.kinds != FROZEN
        index = np.empty(len(made.points), dtype=np.int64)
        index[~is_new] = number[patch.source[patch.mesh.kinds == FROZEN]]
        index[is_new] = n + np.arange(np.count_nonzero(is_new))
        n += int(np.count_nonzero(is_new))
        triangles.append(index[made.triangles])
        codes.append(np.where(made.codes == FROZEN_SIDE, -1, made.codes))
        new.append(is_new)

    def joined(name: str) -> np.ndarray:
        own = [getattr(made, name)[is_new] for (_, made), is_new in zip(parts, new, strict=True)]
        return np.concatenate([getattr(mesh, name)[stays], *own])

    whole = PlacedMesh(
        points=joined("points"),
        triangles=np.concatenate(triangles),
        codes=np.concatenate(codes),
        kinds=joined("kinds"),
        curves=joined("curves"),
        arcs=joined("arcs"),
        goals=joined("goals"),
        hints=joined("hints"),
    )
    return _with_codes(mesh, whole, number)


def _with_codes(old: PlacedMesh, new: PlacedMesh, number: Ints) -> PlacedMesh:
    """Return the new mesh with the codes of the old one's frozen sides, whose ends both stay."""
    triangle, side = np.nonzero(old.codes == FROZEN_SIDE)
    ends = np.column_stack([number[old.triangles[triangle, (side + step) % 3]] for step in (1, 2)])
    n, sides = len(new.points), new.triangles[:, [[1, 2], [2, 0], [0, 1]]]
    is_frozen = np.isin(edge_keys(sides.reshape(-1, 2), n), edge_keys(ends, n)).reshape(-1, 3)
    return replace(new, codes=np.where(is_frozen, FROZEN_SIDE, new.codes))


def annealed(
    domain: Domain, mesh: PlacedMesh, log_size: Floats, seed: int, offset: float, valence_weight: float
) -> PlacedMesh:
    """Return a patch annealed by itself, for its worst triangle more than for its valences."""
    from ..blocks.kernel.exchange import load, unload
    from ..blocks.kernel.schedule import cool, falling, polish
    from ..blocks.kernel.state import POWER
    from ..blocks.kernel.sweeps import renew

    weights = replace(TRIANGLES, valence=valence_weight)
    state = load(domain, mesh, log_size, room=3.0, seed=seed, weights=weights, offset=offset)
    state.scalar[POWER] = POWER_OF_PATCHES
    renew(state)
    cool(state, falling(HOT, COLD, SWEEPS), MOVES * len(mesh.triangles))
    polish(state, POLISH)
    return unload(state)


def spots(mesh: PlacedMesh, lack: Floats, n_rings: int) -> Floats:
    """Return the centroid of the worst triangle of each patch to be mended, the worst first, (k, 2).

    lack is how far each triangle is under what is wanted, (n_triangles,).
    """
    poor = np.flatnonzero(lack > 0)
    if not len(poor):
        return np.empty((0, 2))
    near = grown(mesh, lack > 0, n_rings)
    chosen = np.flatnonzero(near)
    place = np.full(len(near), -1)
    place[chosen] = np.arange(len(chosen))
    pair = mesh.topology.neighbours
    pair = place[pair[near[pair].all(axis=1)]]
    spot = connected_labels(pair, len(chosen))[place[poor]]
    order = np.argsort(-lack[poor], kind="stable")
    _, first = np.unique(spot[order], return_index=True)
    worst = poor[order[np.sort(first)]][:MOST_SPOTS]
    return np.asarray(mesh.points[mesh.triangles[worst]].mean(axis=1))


def around(mesh: PlacedMesh, centre: Floats, n_rings: int) -> Bools:
    """Return the triangles within so many rings of the one nearest to a place."""
    middles = mesh.points[mesh.triangles].mean(axis=1)
    start = np.zeros(len(middles), dtype=bool)
    start[np.argmin(((middles - centre) ** 2).sum(axis=1))] = True
    return grown(mesh, start, n_rings)
