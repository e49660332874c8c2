"""Barriers with two sides: pairs of nodes to keep, so that a layout cuts both sides alike.

Ends, corners that either side has, and between them pairs about a wanted block edge apart. The annealing has
no reason to cut such a stretch, nor may it close one; `carried` looks whether it did.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..blocks.domain import domain_of
from ..blocks.target import target_of
from ..io import Boundary
from ..sizing import SizeField

ROUNDS = 4
"""Kept nodes shorten the wanted edges beside them, which can make more corners: looked for so many times."""


def barrier_pairs(
    boundaries: tuple[Boundary, ...], size: SizeField, side: int, interfaces: Bools, kept: Ints
) -> Ints:
    """Return nodes of the paired barriers to keep, both sides, (k,); kept are points that stay anyway."""
    mesh = size.mesh
    pairs = [np.stack([b.nodes, b.partners]) for b in boundaries if b.partners is not None and b.n_nodes > 1]
    if not pairs:
        return np.empty(0, dtype=np.int64)
    is_kept: list[Bools] = [np.asarray(np.isin(pair, kept).any(axis=0)) for pair in pairs]
    for own in is_kept:
        own[[0, -1]] = True
    for k in range(ROUNDS):
        held = [pair[:, own].ravel() for pair, own in zip(pairs, is_kept, strict=True)]
        domain = domain_of(mesh, interfaces=interfaces, kept=np.concatenate([kept, *held]))
        target = target_of(domain, size, side)
        is_corner, edge = np.zeros(mesh.n_points, dtype=bool), np.full(mesh.n_points, np.inf)
        is_corner[domain.source[target.is_corner]] = True
        np.minimum.at(edge, domain.source, target.length)
        fresh = [
            np.asarray(own | is_corner[pair].any(axis=0)) for pair, own in zip(pairs, is_kept, strict=True)
        ]
        if k == 0:
            fresh = [
                _filled(mesh.points[pair].mean(axis=0), edge[pair].min(axis=0), own)
                for pair, own in zip(pairs, fresh, strict=True)
            ]
        is_same = all((a == b).all() for a, b in zip(is_kept, fresh, strict=True))
        is_kept = fresh
        if is_same:
            break
    return np.concatenate([pair[:, own].ravel() for pair, own in zip(pairs, is_kept, strict=True)])


def _filled(points: Floats, edge: Floats, is_kept: Bools) -> Bools:
    """Return the kept nodes of a line with others between them, about a wanted edge apart, (n,).

    >>> line = np.column_stack([np.arange(9.0), np.zeros(9)])
    >>> _filled(line, np.full(9, 4.0), np.isin(np.arange(9), (0, 8))).nonzero()[0].tolist()
    [0, 4, 8]
    """
    step = np.linalg.norm(np.diff(points, axis=0), axis=1) * 2 / (edge[1:] + edge[:-1])
    total = np.concatenate([[0.0], np.cumsum(step)])
    result = is_kept.copy()
    ends = np.flatnonzero(is_kept)
    for first, last in pairwise(ends):
        n_blocks = min(max(round(float(total[last] - total[first])), 1), int(last - first))
        wanted = np.linspace(total[first], total[last], n_blocks + 1)
        nearest = np.abs(total[first : last + 1, None] - wanted).argmin(axis=0)
        result[first + nearest] = True
    return result
