"""Cut a mesh into monotone transition regions and uniform zones.

Produces one label a triangle. The transition regions are the Morse-Smale cells of the log size, simplified
by persistence: each runs from one fine feature (a coast, a notch, an aerofoil) to one size ridge. Plateaus,
where the size hardly changes, are split off as uniform zones first.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Ints, sums_by
from ..mesh import Mesh
from ..sizing import SizeField
from . import labels
from .borders import AVERAGES, corner_shares, smooth_borders
from .plateau import PLATEAU, plateaus, spread_of
from .watershed import basins

PERSISTENCE = float(np.log(1.3))
"""Default depth in log size below which a fine or coarse spot is noise: sizes that differ by 30 %."""

LEAST_BLOCKS = 4
"""A transition of fewer blocks than this joins a neighbour: 2:2 on two fronts. A uniform zone needs one; a
transition whose sizes differ by less than the persistence joins a neighbour whatever its blocks."""

LEVEL_SHARE = 0.8
"""A region is a uniform zone where so much of it has one size, that of its plateau, to the persistence."""

LEAST_WIDTH = 0.5
"""A region thinner than this many block layers joins a neighbour."""


def segment(
    size: SizeField,
    *,
    tris_per_block: int = 16,
    persistence: float = PERSISTENCE,
    plateau: float = PLATEAU,
    averages: int = AVERAGES,
) -> tuple[Ints, Bools]:
    """Return the region of each triangle, (n_triangles,), and whether each region is a uniform zone.

    Regions are edge-connected and numbered from 0, finest first; persistence is in log size, plateau a
    bound on |grad h|, averages the rings over which borders are smoothed.
    """
    mesh, side = size.mesh, np.sqrt(tris_per_block)
    log_h, weight = size.triangle_log_h, size.triangle_weights
    is_zone = plateaus(size, plateau=plateau, spread=2 * persistence, least=tris_per_block)
    label = labels.connected(mesh, np.where(is_zone, -1, _monotone_cells(mesh, size.log_h, persistence)))

    def merged(label: Ints) -> Ints:
        is_uniform = _zone_share(label, weight, is_zone) > 0.5
        least = np.where(is_uniform, 1.0, LEAST_BLOCKS) * tris_per_block
        least[~is_uniform & (spread_of(label, log_h) < persistence)] = np.inf  # no transition: joins one
        width = LEAST_WIDTH * side
        return labels.merge_small(mesh, label, log_h, weight, kind=is_uniform, least=least, width=width)

    shares = corner_shares(mesh)
    settled = None
    for _ in range(3):
        label = labels.finest_first(merged(label), log_h)
        settled = smooth_borders(mesh, label, shares, rounds=18, averages=averages, settled=settled)
        label = labels.finest_first(labels.connected(mesh, settled), log_h)
    label = labels.finest_first(merged(label), log_h)
    return label, _level_share(label, weight, is_zone, log_h, persistence) >= LEVEL_SHARE


def _zone_share(label: Ints, weight: Floats, is_zone: Bools) -> Floats:
    """Return the share of each region that lies in uniform zones, (n_regions,)."""
    n = int(label.max()) + 1
    return sums_by(label, weight * is_zone, n) / sums_by(label, weight, n)


def _level_share(label: Ints, weight: Floats, is_zone: Bools, log_h: Floats, persistence: float) -> Floats:
    """Return the share of each region whose size is that of its uniform zones, to the persistence."""
    n = int(label.max()) + 1
    in_zone = sums_by(label, weight * is_zone, n)
    level = sums_by(label, weight * is_zone * log_h, n) / np.where(in_zone > 0, in_zone, 1.0)
    is_level = (np.abs(log_h - level[label]) < persistence) & (in_zone > 0)[label]
    return _zone_share(label, weight, is_level)


def _monotone_cells(mesh: Mesh, log_h: Floats, persistence: float) -> Ints:
    edges, lengths = mesh.topology.edges, mesh.edge_lengths
    finest = basins(edges, lengths, log_h, persistence)
    coarsest = basins(edges, lengths, -log_h, persistence)
    corners = np.arange(mesh.n_triangles)
    low = mesh.triangles[corners, np.argmin(log_h[mesh.triangles], axis=1)]
    high = mesh.triangles[corners, np.argmax(log_h[mesh.triangles], axis=1)]
    return labels.compact(finest[low], coarsest[high])
