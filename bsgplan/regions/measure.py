"""Turn labels into regions: profile, kind, rings or strips, monotone or not, charge and quality of each."""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Ints, sums_by
from ..sizing import SizeField
from ..sizing.charge import region_charges
from .plateau import PLATEAU
from .profile import profiles
from .region import TRANSITION, UNIFORM, Region, Regions, inner_irregularity
from .segmentation import PERSISTENCE, segment
from .watershed import basins

PROBES = (0.35, 0.5, 0.65)
"""Shares of the triangles at which the fronts are probed: closed where two of the three are."""


def find_regions(
    size: SizeField, *, tris_per_block: int = 16, persistence: float = PERSISTENCE, plateau: float = PLATEAU
) -> Regions:
    """Return the monotone transition regions and uniform zones of a size field, as `segment` cuts them."""
    label, is_uniform = segment(size, tris_per_block=tris_per_block, persistence=persistence, plateau=plateau)
    weight = sums_by(label, size.triangle_weights, len(is_uniform))
    is_uniform = is_uniform | (weight < tris_per_block)  # a component smaller than a block is no transition
    return measure_regions(size, label, is_uniform, persistence=persistence)


def measure_regions(
    size: SizeField,
    label: Ints,
    is_uniform: Bools,
    *,
    persistence: float = PERSISTENCE,
) -> Regions:
    """Return the regions of given labels, (n_triangles,), -1 for triangles that belong to none."""
    mesh, n = size.mesh, len(is_uniform)
    shown = label >= 0
    inside = np.where(shown, label, n)  # the rest gets a label of its own, dropped below
    measured = profiles(size, inside)
    charges = region_charges(inside, size.fluxes)
    irregularity = inner_irregularity(size, inside, n)
    is_closed = np.sum([_is_ring(size, inside, level) for level in _levels(size, inside, n)], axis=0) >= 2
    is_monotone = _monotone(size, inside, n, persistence)
    order = np.argsort(inside, kind="stable")
    start = np.searchsorted(inside[order], np.arange(n + 1))
    corner_h = size.h[mesh.triangles]
    regions = []
    for k in range(n):
        own = order[start[k] : start[k + 1]]
        regions.append(
            Region(
                id=k,
                kind=UNIFORM if is_uniform[k] else TRANSITION,
                triangles=own,
                weight=float(size.triangle_weights[own].sum()),
                area=float(mesh.areas[own].sum()),
                h_min=float(corner_h[own].min()),
                h_max=float(corner_h[own].max()),
                profile=measured[k],
                is_closed=bool(is_closed[k]),
                is_monotone=bool(is_monotone[k]),
                charge=float(charges[k]),
                q_min=float(mesh.qualities[own].min()),
                irregularity=irregularity[k],
            )
        )
    return Regions(size, label, tuple(regions))


def _levels(size: SizeField, label: Ints, n: int) -> list[Floats]:
    """Return the log sizes below which each share of `PROBES` of a region's triangles lies, (n,) each."""
    middle = size.log_h[size.mesh.triangles].mean(axis=1)
    order = np.lexsort((middle, label))
    count = np.bincount(label, minlength=n)[:n]
    first = np.cumsum(count) - count
    return [middle[order][first + (share * count).astype(np.int64)] for share in PROBES]


def _is_ring(size: SizeField, label: Ints, level: Floats) -> Bools:
    """Return the regions whose front at this log size never meets their rim, (n,)."""
    n, topology = len(level), size.mesh.topology
    first, second = topology.edge_cells.T
    beyond = np.where(second >= 0, label[second], -1)
    is_rim = label[first] != beyond
    low, high = np.sort(size.log_h[topology.edges[is_rim]], axis=1).T
    crossings = np.zeros(n, dtype=np.int64)
    for own in (label[first[is_rim]], beyond[is_rim]):
        inside = (own >= 0) & (own < n)
        cut = level[np.where(inside, own, 0)]
        crossings += np.bincount(own[inside & (low < cut) & (cut <= high)], minlength=n)[:n]
    return np.asarray(crossings == 0)


def _monotone(size: SizeField, label: Ints, n: int, persistence: float) -> Bools:
    """Return the regions with one fine and one coarse spot of this persistence, (n,).

    The size field of each region is taken by itself: corners are split between regions.
    """
    mesh = size.mesh
    node = np.unique(
        np.repeat(label, 3) * np.int64(mesh.n_points) + mesh.triangles.ravel(), return_inverse=True
    )
    owner, vertex = np.divmod(node[0], mesh.n_points)
    corners = node[1].reshape(-1, 3)
    ends = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    lengths = np.linalg.norm(mesh.points[vertex[ends[:, 0]]] - mesh.points[vertex[ends[:, 1]]], axis=1)
    values = size.log_h[vertex]
    is_one = np.ones(n, dtype=bool)
    for field in (values, -values):
        lowest = basins(ends, lengths, field, persistence)
        spots = owner[np.unique(lowest)]
        is_one &= np.bincount(spots, minlength=n + 1)[:n] == 1
    return is_one
