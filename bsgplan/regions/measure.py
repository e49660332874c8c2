"""Turn labels into regions: profile, kind, rings or strips, monotone or not, charge and quality of each."""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Ints, grouped, sums_by
from ..mesh import Mesh
from ..sizing import SizeField
from ..sizing.charge import region_charges
from .bins import by_level
from .borders import AVERAGES
from .plateau import PLATEAU
from .profile import profiles
from .region import TRANSITION, UNIFORM, Region, Regions, inner_irregularity
from .segmentation import PERSISTENCE, segment
from .watershed import basins

PROBES = (0.35, 0.5, 0.65)
"""Shares of the triangles at which the fronts are probed: closed where two of the three are."""


def find_regions(
    size: SizeField,
    *,
    tris_per_block: int = 16,
    persistence: float = PERSISTENCE,
    plateau: float = PLATEAU,
    averages: int = AVERAGES,
) -> Regions:
    """Return the monotone transition regions and uniform zones of a size field, as `segment` cuts them."""
    label, is_uniform = segment(
        size, tris_per_block=tris_per_block, persistence=persistence, plateau=plateau, averages=averages
    )
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
    irregularity = inner_irregularity(mesh, inside, n)
    is_closed = np.sum(_are_rings(size, inside, _levels(size, inside, n)), axis=0) >= 2
    is_monotone = _monotone(size, inside, n, persistence)
    order, start = grouped(inside, n + 1)
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
    order, start = by_level(size, label)
    first, count = start[:n], np.diff(start)[:n]
    return [size.triangle_log_h[order[first + (share * count).astype(np.int64)]] for share in PROBES]


def _are_rings(size: SizeField, label: Ints, levels: list[Floats]) -> list[Bools]:
    """Return the regions whose front at each of the log sizes never meets their rim, (n,) each."""
    n, topology = len(levels[0]), size.mesh.topology
    first, second = topology.edge_cells.T
    beyond = np.where(second >= 0, label[second], -1)
    rim = np.flatnonzero(label[first] != beyond)
    ends = size.log_h[topology.edges[rim]].T
    low, high = np.minimum(*ends), np.maximum(*ends)
    crossings = np.zeros((len(levels), n), dtype=np.int64)
    for own in (label[first[rim]], beyond[rim]):
        inside = np.flatnonzero((own >= 0) & (own < n))
        own, least, most = own[inside], low[inside], high[inside]
        for count, level in zip(crossings, levels, strict=True):
            count += np.bincount(own[(least < level[own]) & (level[own] <= most)], minlength=n)
    return list(crossings == 0)


def _monotone(size: SizeField, label: Ints, n: int, persistence: float) -> Bools:
    """Return the regions with one fine and one coarse spot of this persistence, (n,).

    The size field of each region is taken by itself: corners are split between regions.
    """
    ends, lengths, vertex, owner = _cut_apart(size.mesh, label)
    values = size.log_h[vertex]
    is_one = np.ones(n, dtype=bool)
    for field in (values, -values):
        lowest = basins(ends, lengths, field, persistence)
        spots = owner[np.unique(lowest)]
        is_one &= np.bincount(spots, minlength=n + 1)[:n] == 1
    return is_one


def _cut_apart(mesh: Mesh, label: Ints) -> tuple[Ints, Floats, Ints, Ints]:
    """Return the edges of a mesh cut along the borders of its labels, (n, 2), and their lengths.

    Also the vertex and the label of each node: a vertex is as many nodes as there are labels around it.
    """
    topology, n = mesh.topology, mesh.n_points
    first, second = topology.edge_cells.T
    on_border = np.flatnonzero((second >= 0) & (label[first] != label[second]))
    edge = np.concatenate([np.arange(len(first)), on_border])
    side = label[np.concatenate([first, second[on_border]])]
    ends = topology.edges.take(edge, axis=0)
    owner = np.empty(n, dtype=np.int64)
    owner[mesh.triangles.ravel()] = np.repeat(label, 3)  # any of its labels: the node of the others is new
    is_other = owner[ends] != side[:, None]
    keys = (side[:, None] * n + ends)[is_other]
    others, at = np.unique(keys, return_inverse=True)
    ends[is_other] = n + at
    vertex, owners = np.concatenate([np.arange(n), others % n]), np.concatenate([owner, others // n])
    return ends, mesh.edge_lengths[edge], vertex, owners
