"""Find the plateaus of a size field: connected pieces where the size hardly changes.

Produces a mask of triangles. A plateau ends where the size begins to change, also in a short or blurred
one: the slope counts as small where it is small at all, or small beside the slope two edges away.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Ints, sums_by
from ..mesh import Mesh
from ..mesh.quality import lengths
from ..sizing import SizeField
from . import labels

PLATEAU = 0.05
"""Default |grad h| under which the size counts as constant: 5 % from one element to the next."""

DROP = 0.4
"""A slope under this share of the slope two edges away is the blurred edge of a plateau: a mesh generator
needs an edge or two to stop growing. Where log h is linear the share is e^(-2 |grad h|), above 0.4 up to
|grad h| = 0.46; steeper fields are kept whole by the bound on the spread of a zone."""


BLUR = 0.6
"""Beside a plateau, a slope under this share of the slope three edges away is blur, and belongs to it .."""

NEARLY = 0.08
""".. where the size is within 8 % of the plateau's .."""

ROUNDS = 4
""".. and within so many triangles of it, two layers."""


def plateaus(size: SizeField, *, plateau: float, spread: float, least: float) -> Bools:
    """Return the triangles of uniform zones, (n_triangles,).

    A zone is connected, covers least triangles of its size, and spans less than spread in log size; a
    piece whose size drifts further is tried again with half and a quarter of the slope.
    """
    mesh, log_h = size.mesh, size.triangle_log_h
    steepness = lengths(size.slope) * size.h
    beside = _largest_beside(mesh, _largest_beside(mesh, steepness))
    is_zone = np.zeros(mesh.n_triangles, dtype=bool)
    for share in (1.0, 0.5, 0.25):
        is_low = (steepness < share * plateau) | (steepness < share * DROP * beside)
        is_flat = (_at_two_corners(mesh, is_low)) & ~is_zone
        flat, piece = labels.pieces(mesh, is_flat)
        if not len(flat):
            continue
        is_large = sums_by(piece, size.triangle_weights[flat], int(piece.max()) + 1) >= least
        is_zone[flat] = (is_large & (spread_of(piece, log_h[flat]) < spread))[piece]
    is_blurred = steepness < BLUR * _largest_beside(mesh, beside)
    return _grown(mesh, is_zone, _at_two_corners(mesh, is_blurred), log_h)


def _grown(mesh: Mesh, is_zone: Bools, is_blurred: Bools, log_h: Floats) -> Bools:
    """Return the zones with the blurred triangles beside them whose size is nearly theirs, (n_triangles,)."""
    inside, piece = labels.pieces(mesh, is_zone)
    if not len(inside):
        return is_zone
    level = sums_by(piece, log_h[inside], int(piece.max()) + 1) / np.bincount(piece)
    zone = np.full(mesh.n_triangles + 1, -1)  # the last is that of no triangle
    zone[inside] = piece
    rest = np.flatnonzero(is_blurred & ~is_zone)
    for _ in range(ROUNDS):
        found = np.full(len(rest), -1)
        for beside in zone[mesh.topology.across.take(rest, axis=0)].T:
            is_near = np.abs(log_h[rest] - level[beside]) < NEARLY
            found = np.where((beside >= 0) & is_near, beside, found)
        joins = found >= 0
        zone[rest[joins]] = found[joins]
        rest = rest[~joins]
    return np.asarray(zone[:-1] >= 0)


def _largest_beside(mesh: Mesh, values: Floats) -> Floats:
    """Return the largest value at each vertex and its neighbours, (n_points,)."""
    i, j = mesh.topology.edges.T
    result = values.copy()
    np.maximum.at(result, i, values[j])
    np.maximum.at(result, j, values[i])
    return result


def _at_two_corners(mesh: Mesh, mask: Bools) -> Bools:
    """Return the triangles with two corners or three in the mask, (n_triangles,)."""
    a, b, c = (mask[corner] for corner in mesh.triangles.T)
    return np.asarray((a & b) | (b & c) | (c & a))


def spread_of(label: Ints, log_h: Floats) -> Floats:
    """Return the span of log size of each label, (n,): of a uniform distribution of the same variance."""
    n = int(label.max()) + 1
    count = np.bincount(label, minlength=n)
    mean = sums_by(label, log_h, n) / count
    return np.sqrt(12 * sums_by(label, (log_h - mean[label]) ** 2, n) / count)
