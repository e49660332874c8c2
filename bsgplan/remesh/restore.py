"""Old triangles put back where nothing better was found: into the new mesh, gaps closed around them.

The old triangles round a poor spot were good enough. They are set into the annealed mesh, what lies between
them and the rim of a patch is closed by constrained Delaunay triangles, and the patch annealed by itself.
"""

from __future__ import annotations

from operator import itemgetter

import numpy as np

from ..arrays import Bools, Floats
from ..blocks.domain import Domain
from ..blocks.kinds import FROZEN, INTERIOR
from ..blocks.outline import outline
from ..blocks.placed import PlacedMesh, grown
from .gaps import closed, within
from .mend import Patch, annealed, around, holders, lacks, patch_of, spliced, spots, worst_lack

RINGS = ((2, 3), (4, 2), (3, 2), (6, 3), (2, 3), (4, 2), (3, 3), (10, 4))
"""Rings of old triangles that are put back, and rings round them in which the gap is closed, turn by turn:
chance decides whether a gap ends well, and only spots that are left are tried again."""

WEIGHT = 0.2
"""Weight of irregular vertices while a patch is annealed."""


def restored(
    domain: Domain,
    start: PlacedMesh,
    mesh: PlacedMesh,
    log_size: Floats,
    least: Floats,
    *,
    seed: int,
    offset: float,
) -> PlacedMesh:
    """Return a mesh with triangles of start put back round those under a mean ratio, where that helps.

    start is the domain's own triangulation; least that ratio in each of its triangles; see `mend.mended`.
    """
    for turn, (n_rings, n_beyond) in enumerate(RINGS):
        better = []
        for number, centre in enumerate(spots(mesh, lacks(domain, mesh, least), n_rings + n_beyond + 1)):
            old = around(start, centre, n_rings)
            inside = grown(start, old, n_beyond)[holders(domain, mesh)]
            patch = patch_of(mesh, inside)
            begun = put_back(start, mesh, patch, old)
            if begun is None:
                continue
            made = annealed(domain, begun, log_size, seed + 1000 * turn + number, offset, WEIGHT)
            tried = [(worst_lack(domain, one, least), one) for one in (made, begun)]
            lack, made = min(tried, key=itemgetter(0))
            if lack < worst_lack(domain, patch.mesh, least):
                better.append((patch, made))
        mesh = spliced(mesh, better)
    return mesh


def put_back(start: PlacedMesh, mesh: PlacedMesh, patch: Patch, old: Bools) -> PlacedMesh | None:
    """Return a patch of a mesh with old triangles of start in it, and the gaps closed; None where none fit.

    Vertices that stay are the same in both, in one order.
    """
    part = patch.mesh
    corners = start.triangles[old]
    used = np.unique(corners)
    stays = start.kinds[used] == FROZEN
    is_inner = ~part.topology.is_boundary
    if (part.kinds[is_inner] != INTERIOR).any() or (start.kinds[used[~stays]] != INTERIOR).any():
        return None
    in_mesh = np.full(len(start.points), -1)
    in_mesh[start.kinds == FROZEN] = np.flatnonzero(mesh.kinds == FROZEN)
    in_patch = np.full(len(mesh.points), -1)
    in_patch[patch.source] = np.arange(len(patch.source))
    number = np.full(len(start.points), -1)
    number[used[stays]] = in_patch[in_mesh[used[stays]]]
    number[used[~stays]] = len(part.points) + np.arange(np.count_nonzero(~stays))
    if (number[used] < 0).any():
        return None
    points = np.concatenate([part.points, start.points[used[~stays]]])
    filled = closed(points, number[corners], outline(part))
    return None if filled is None else within(part, points, filled)
