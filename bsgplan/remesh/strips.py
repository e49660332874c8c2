"""The start that the paper has: strips of fronts between the fine and the coarse side of a part.

Counts come from the pattern search, those of the two ends from the rim. Fronts carry vertices at equal
lengths in wanted edges; the strips between them are the closed form of `patterns.strip`. What collides with
the rim, or with each other, is left out, and the gaps are closed by constrained Delaunay triangles.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import Floats, Ints
from ..blocks.kinds import INTERIOR
from ..blocks.outline import crossings, outline
from ..blocks.placed import PlacedMesh
from ..mesh.edges import edge_keys
from ..mesh.quality import corner_edge_lengths, mean_ratio, signed_areas
from ..patterns.strip import ring_turn, strip_triangles
from ..planning.fit import followed, misfit, searched, sequences
from .fronts import Front, Fronts, fronts_of
from .gaps import closed, within
from .rim import rim_of

CLEARANCE = 0.55
"""A vertex of a front nearer to the rim than this, in wanted edges, is left out."""

POOR = 0.3
"""A triangle of a strip under this mean ratio is left out."""

FEWEST_LAYERS = 3
"""A transition of fewer layers has no front inside that the rim leaves free."""

MOST_SEARCHED = 16
"""Sides of an end up to which the pattern search is asked; beyond it takes longer than the annealing."""


def stripped(part: PlacedMesh, log_size: Floats, *, is_searched: bool = True) -> PlacedMesh | None:
    """Return a part as strips of fronts inside its own rim; log_size is given at its vertices.

    is_searched lets the pattern search propose counts beside those that follow the profile.

    None where it has no clear transition, vertices inside that stay, or strips that do not fit.
    """
    is_rim = part.topology.is_boundary
    if (part.kinds[~is_rim] != INTERIOR).any():
        return None
    rim = rim_of(part, log_size)
    if rim is None:
        return None
    fronts = fronts_of(part, log_size, rim)
    if not FEWEST_LAYERS <= fronts.layers < np.inf:
        return None
    found = [
        _filled(fronts, part, log_size, ends, met, is_searched=is_searched)
        for ends, met in ((fronts.imposed(), (rim.fine, rim.coarse)), (fronts.unimposed(), None))
    ]
    there = [mesh for mesh in found if mesh is not None]
    return min(there, key=lambda mesh: int(np.count_nonzero(mesh.is_irregular)), default=None)


def counts_of(
    fronts: Fronts, wanted_ends: tuple[float, float], *, is_searched: bool = True
) -> tuple[int, ...]:
    """Return the elements of each front, fine end first, the ends those that are wanted, rounded.

    Of the sequences that the profile suggests and of those that the search finds best, the nearest in size
    and number.
    """
    rim, profile = fronts.rim, fronts.profile(wanted_ends)
    least = 3 if rim.is_closed else 1
    fine, coarse = (max(least, round(end)) for end in wanted_ends)
    ends = fine, coarse
    found = [*sequences(profile, 1.0, least=least), *followed(profile, *ends, least=least)]
    if is_searched and max(ends) <= MOST_SEARCHED:
        found += searched(profile, 1.0, is_closed=rim.is_closed)
    fitting = [counts for counts in found if (counts[0], counts[-1]) == ends]
    wanted = float((np.diff(profile.depths) * (profile.counts[1:] + profile.counts[:-1])).sum())

    def strays(counts: tuple[int, ...]) -> tuple[float, tuple[int, ...]]:
        n = sum(counts) + sum(counts[1:-1])
        return misfit(counts, profile, 1.0) + abs(float(np.log(n / wanted))), counts

    return min(fitting, key=strays)


def _filled(
    fronts: Fronts,
    part: PlacedMesh,
    log_size: Floats,
    wanted_ends: tuple[float, float],
    met: tuple[Ints, Ints] | None,
    *,
    is_searched: bool,
) -> PlacedMesh | None:
    """Return a part in strips; met are the vertices of the ends, None where no front may meet these."""
    counts = counts_of(fronts, wanted_ends, is_searched=is_searched)
    made = _vertices(fronts, counts, met)
    if made is None:
        return None
    points, numbers = made
    strips = _strips(numbers, counts, points, is_closed=fronts.rim.is_closed)
    triangles = _kept(points, strips, part, log_size)
    filled = closed(points, triangles, outline(part)) if len(triangles) else None
    return None if filled is None else within(part, points, filled)


def _vertices(
    fronts: Fronts, counts: tuple[int, ...], met: tuple[Ints, Ints] | None
) -> tuple[Floats, list[Ints]] | None:
    """Return the rim's and the fronts' points, and the number of each front's vertices, -1 left out."""
    rim, mesh, n_layers = fronts.rim, fronts.mesh, len(counts) - 1
    depth, below, above = fronts.met(n_layers)
    none = [np.full(n + (not rim.is_closed), -1) for n in (counts[0], counts[-1])]
    first, last = (none[0], none[1]) if met is None else met
    points, numbers = [mesh.points], [first]
    n, start, turn = mesh.n_points, mesh.points[rim.fine[0]], 0.0
    for k in range(1, n_layers):
        front = fronts.front(depth, k)
        if front is None:
            return None
        if rim.is_closed:
            front = _round(front, mesh.points[rim.fine])
            start = front.at(np.array([_nearest(front, start)]))[0]
            turn = _nearest(front, start) / front.edges + float(ring_turn(counts[k - 1], counts[k]))
            share = np.mod(np.arange(counts[k]) / counts[k] + turn, 1.0)
            start = front.at(share[:1] * front.edges)[0]
        else:
            share = np.linspace(0.0, 1.0, counts[k] + 1)
        number = n + np.arange(len(share))
        if not rim.is_closed:
            number[0], number[-1] = below[k], above[k]
        points.append(front.at(share * front.edges))
        numbers.append(number)
        n += len(share)
    if rim.is_closed and met is not None:
        away = np.linalg.norm(mesh.points[last] - start, axis=1)
        last = np.roll(last, -int(np.argmin(away)))
    return np.concatenate(points), [*numbers, last]


def _round(front: Front, fine: Floats) -> Front:
    """Return a closed front in the sense of rotation of the fine end."""
    if _area(front.points) * _area(fine) > 0:
        return front
    return Front(front.points[::-1], front.edges - front.place[::-1])


def _area(points: Floats) -> float:
    after = np.roll(points, -1, axis=0)
    return float((points[:, 0] * after[:, 1] - after[:, 0] * points[:, 1]).sum())


def _nearest(front: Front, point: Floats) -> float:
    """Return where on a front the vertex of its polyline nearest to a point lies, in wanted edges."""
    return float(front.place[np.argmin(((front.points - point) ** 2).sum(axis=1))])


def _strips(numbers: list[Ints], counts: tuple[int, ...], points: Floats, *, is_closed: bool) -> Ints:
    """Return the triangles of all strips with all corners, counter-clockwise, (m, 3)."""
    made = []
    for k, (first, second) in enumerate(pairwise(numbers)):
        own = np.concatenate([first, second])[strip_triangles(counts[k], counts[k + 1], is_closed=is_closed)]
        own = own[(own >= 0).all(axis=1)]
        if signed_areas(points, own).sum() < 0:
            own = own[:, ::-1]
        made.append(own)
    return np.concatenate(made)


def _kept(points: Floats, triangles: Ints, part: PlacedMesh, log_size: Floats) -> Ints:
    """Return the triangles that are good, clear of the rim and cut no rim vertex off."""
    n = len(part.points)
    is_rim = np.zeros(len(points), dtype=bool)
    is_rim[:n] = part.topology.is_boundary
    rim = np.flatnonzero(is_rim)
    inner = np.arange(n, len(points))
    away, nearest = cKDTree(points[rim]).query(points[inner])
    is_clear = np.ones(len(points), dtype=bool)
    is_clear[inner] = away > CLEARANCE * np.exp(log_size[rim[nearest]])
    areas = signed_areas(points, triangles)
    quality = mean_ratio(np.maximum(areas, 0.0), corner_edge_lengths(points, triangles))
    sides = outline(part)
    ends = triangles[:, [[0, 1], [1, 2], [2, 0]]]
    is_side = np.isin(edge_keys(ends.reshape(-1, 2), len(points)), edge_keys(sides, len(points)))
    is_chord = is_rim[ends].all(axis=2) & ~is_side.reshape(-1, 3)
    kept = (quality > POOR) & is_clear[triangles].all(axis=1) & ~is_chord.any(axis=1)
    return _apart(points, triangles[kept], sides)


def _apart(points: Floats, triangles: Ints, rim: Ints) -> Ints:
    """Return the triangles none of whose sides crosses that of another, or the rim."""
    n = len(points)
    edges = edge_keys(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), n)
    known = np.unique(np.concatenate([edges, edge_keys(rim, n)]))
    segments = np.column_stack(np.divmod(known, n))
    bad = known[np.unique(crossings(points, segments))]
    return triangles[~np.isin(edges, bad).reshape(-1, 3).any(axis=1)]
