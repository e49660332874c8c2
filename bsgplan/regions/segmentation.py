"""Cut a mesh into monotone transition regions and uniform zones.

Produces one label a triangle. The transition regions are the Morse-Smale cells of the log size, simplified
by persistence: each runs from one fine feature (a coast, a notch, an aerofoil) to one size ridge. Plateaus,
where the size hardly changes, are split off as uniform zones first.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..mesh import Mesh
from ..mesh.operators import gradient
from ..sizing import SizeField
from ..sizing.smoothing import smooth_gradient
from . import labels
from .watershed import basins

PERSISTENCE = float(np.log(1.3))
"""Default depth in log size below which a fine or coarse spot is noise: sizes that differ by 30 %."""

PLATEAU = 0.03
"""Default |grad h| under which the size counts as constant: 3 % from one element to the next."""

LEAST_BLOCKS = 4
"""A region of fewer blocks than this joins a neighbour: one block each way, from 2 fronts of 2."""

LEAST_WIDTH = 0.5
"""A region thinner than this many block layers joins a neighbour."""


def segment(
    size: SizeField, *, tris_per_block: int = 16, persistence: float = PERSISTENCE, plateau: float = PLATEAU
) -> tuple[Ints, Bools]:
    """Return the region of each triangle, (n_triangles,), and whether each region is a uniform zone.

    Regions are edge-connected and numbered from 0, finest first; persistence is in log size, plateau a
    bound on |grad h|.
    """
    mesh, side = size.mesh, np.sqrt(tris_per_block)
    log_h, weight = np.log(size.triangle_h), size.triangle_weights
    least, width = LEAST_BLOCKS * tris_per_block, LEAST_WIDTH * side
    is_zone = _plateaus(size, plateau, persistence, least)
    label = labels.connected(mesh, np.where(is_zone, -1, _monotone_cells(mesh, size.log_h, persistence)))
    for _ in range(3):
        label = labels.merge_small(mesh, label, log_h, weight, least=least, width=width)
        label = labels.smooth_borders(mesh, labels.finest_first(label, log_h), rounds=6)
        label = labels.finest_first(labels.connected(mesh, label), log_h)
    label = labels.merge_small(mesh, label, log_h, weight, least=least, width=width)
    label = labels.finest_first(label, log_h)
    share = np.bincount(label, weight * is_zone) / np.bincount(label, weight)
    return label, share > 0.5


def _plateaus(size: SizeField, plateau: float, persistence: float, least: float) -> Bools:
    """Return the triangles of uniform zones: connected, flat, and of one size to the persistence.

    A flat piece whose size drifts further is tried again with half and a quarter of the slope.
    """
    mesh, log_h = size.mesh, np.log(size.triangle_h)
    slope = smooth_gradient(mesh, gradient(mesh, size.log_h), 1.5 * size.triangle_h)
    steepness = np.linalg.norm(slope[mesh.triangles].mean(axis=1), axis=1) * size.triangle_h
    is_zone = np.zeros(mesh.n_triangles, dtype=bool)
    for limit in (plateau, plateau / 2, plateau / 4):
        is_flat = (steepness < limit) & ~is_zone
        piece = labels.connected(mesh, is_flat.astype(np.int64))
        is_large = np.bincount(piece, size.triangle_weights) >= least
        is_level = _spread(piece, log_h) < 2 * persistence
        is_zone |= is_flat & (is_large & is_level)[piece]
    return is_zone


def _monotone_cells(mesh: Mesh, log_h: Floats, persistence: float) -> Ints:
    edges, lengths = mesh.topology.edges, mesh.edge_lengths
    finest = basins(edges, lengths, log_h, persistence)
    coarsest = basins(edges, lengths, -log_h, persistence)
    corners = np.arange(mesh.n_triangles)
    low = mesh.triangles[corners, np.argmin(log_h[mesh.triangles], axis=1)]
    high = mesh.triangles[corners, np.argmax(log_h[mesh.triangles], axis=1)]
    return labels.compact(finest[low], coarsest[high])


def _spread(label: Ints, log_h: Floats) -> Floats:
    n = int(label.max()) + 1
    count = np.bincount(label, minlength=n)
    mean = np.bincount(label, log_h, n) / count
    variance = np.bincount(label, (log_h - mean[label]) ** 2, n) / count
    return np.sqrt(12 * variance)  # the width of a uniform distribution of this variance
