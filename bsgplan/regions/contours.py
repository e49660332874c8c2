"""Regions as lines and fields for a picture: block fronts as contours, depths, charge at the vertices.

Invariants: every point of a front line lies on its level to rounding; lines of one region stay in its
triangles; vertex charges add up to the charge of the regions.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..arrays import Floats, Ints, frozen_ints, sums_by
from .profile import Profile
from .region import TRANSITION, Regions


def front_levels(profile: Profile, n_fronts: int) -> Floats:
    """Return the log sizes of a pattern's fronts, (n_fronts,): front k of n at depth k layers / (n - 1)."""
    return profile.levels_at(np.linspace(0.0, profile.layers, n_fronts))


def front_lines(
    regions: Regions, levels: Mapping[int, Floats], triangles: Ints | None = None
) -> tuple[Floats, Ints, Ints]:
    """Return the contours of log size in regions: segments (n, 2, 2 or 3), length, region and level (n,).

    levels are log sizes by the id of a region, (n_levels,), in any order; each segment lies in one triangle
    and is told by the index of its level. A vertex exactly on a level counts as above it, so no segment
    is drawn twice. triangles are the ones to walk, (n,), None for all.
    """
    mesh, log_h = regions.size.mesh, regions.size.log_h
    label = regions.label if triangles is None else regions.label[triangles]
    order = np.argsort(label, kind="stable")
    ladder = label[order]
    segments, ids, ranks = [np.empty((0, 2, mesh.points.shape[1]))], [np.empty(0, int)], [np.empty(0, int)]
    for k, wanted in levels.items():
        own = order[slice(*np.searchsorted(ladder, [k, k + 1]))]
        corners = mesh.triangles[own if triangles is None else triangles[own]]
        found, rank = contour_segments(mesh.points[corners], log_h[corners], np.asarray(wanted))
        segments.append(found)
        ids.append(np.full(len(rank), k))
        ranks.append(rank)
    return np.concatenate(segments), np.concatenate(ids), np.concatenate(ranks)


def contour_segments(corners: Floats, values: Floats, levels: Floats) -> tuple[Floats, Ints]:
    """Return the contours of linear triangles: segments (n, 2, d) and the index of the level of each, (n,).

    corners are (n_triangles, 3, d), values (n_triangles, 3).

    >>> corner = np.array([[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]]])
    >>> contour_segments(corner, np.array([[0.0, 2.0, 2.0]]), np.array([1.0]))[0].tolist()
    [[[1.0, 0.0], [0.0, 1.0]]]
    """
    order = np.argsort(levels, kind="stable")
    ladder = levels[order]
    first = np.searchsorted(ladder, values.min(axis=1), side="right")
    last = np.searchsorted(ladder, values.max(axis=1), side="right")
    n_crossed = last - first  # levels in (lowest, highest] of each triangle
    cell = np.repeat(np.arange(len(values)), n_crossed)
    rank = np.arange(len(cell)) - np.repeat(np.cumsum(n_crossed) - n_crossed, n_crossed) + first[cell]
    level = ladder[rank]
    is_above = values[cell] >= level[:, None]
    # the lone corner is the one on its side of the contour: both ends lie on its edges
    lone = np.where(is_above.sum(axis=1) == 1, is_above.argmax(axis=1), is_above.argmin(axis=1))
    is_line = values[cell, lone] != level  # else the contour only touches the corner
    cell, lone, level, rank = cell[is_line], lone[is_line], level[is_line], rank[is_line]
    ends = [_crossing(corners, values, cell, lone, (lone + turn) % 3, level) for turn in (1, 2)]
    return np.stack(ends, axis=1), frozen_ints(order[rank])


def front_coordinate(regions: Regions, side: float) -> tuple[Floats, Floats]:
    """Return the depth in block layers at the points, (n_points,), and the triangles, (n_triangles,).

    side is s, the layers of elements in a block layer. Depth is 0 on the fine end of a transition and in
    uniform zones; a point on a border belongs to the transition with the smallest id around it.
    """
    size, mesh = regions.size, regions.size.mesh
    at_points, at_triangles = np.zeros(mesh.n_points), np.zeros(mesh.n_triangles)
    middle = size.triangle_log_h
    for region in reversed(regions.regions):  # smallest id last, so it has the last word
        if region.kind == TRANSITION:
            corners = mesh.triangles[region.triangles].ravel()
            at_points[corners] = region.profile.depths_at(size.log_h[corners]) / side
            at_triangles[region.triangles] = region.profile.depths_at(middle[region.triangles]) / side
    return at_points, at_triangles


def vertex_charges(regions: Regions) -> Floats:
    """Return the irregularity charge at each vertex, (n_points,), in units of iota.

    What flows out of a triangle is given to its corners by thirds, so the sum is the charge of the regions.
    """
    outflow = np.where(regions.label >= 0, regions.size.fluxes.sum(axis=1), 0.0)
    mesh = regions.size.mesh
    return sums_by(mesh.triangles, np.repeat(outflow / 3, 3), mesh.n_points)


def _crossing(corners: Floats, values: Floats, cell: Ints, a: Ints, b: Ints, level: Floats) -> Floats:
    share = (level - values[cell, a]) / (values[cell, b] - values[cell, a])
    result: Floats = corners[cell, a] + share[:, None] * (corners[cell, b] - corners[cell, a])
    return result
