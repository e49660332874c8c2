"""Boundaries carried over: the segments of the input as sides of the blocks, or of the grid's triangles.

Every side on a curve takes the tracks of the input's edge under its middle. Points where tracks change are
corners of blocks (`features`), so no side lies on two. A barrier keeps its pairs where both its sides are cut
alike; else it becomes two land segments without partners, which `export` refuses to write as fort.14.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..blocks.curve_places import side_arcs
from ..blocks.domain import Domain
from ..blocks.placed import PlacedMesh
from ..io import Boundary
from ..mesh import Mesh
from ..mesh.edges import edge_numbers
from .tracks import Track, Tracks

WHOLE = 1e-6
"""A vertex so near to a node, in steps from node to node, stands on it: far over the roundings."""


@dataclass(frozen=True, eq=False)
class _Sides:
    """Sides on tracks, in the direction of the file."""

    track: Ints
    ends: Ints
    """(n, 2)."""
    place: Floats
    """Length of the track at both ends, (n, 2); beyond a closed one's length where it goes round."""
    order: Floats
    """Length of the track, else of the curve, at the middle, (n,)."""
    curve: Ints


@dataclass(frozen=True, eq=False)
class _Path:
    """Sides of one track from end to end."""

    nodes: Ints
    place: Floats
    """Length of the track at each node, (n,)."""

    @property
    def is_closed(self) -> bool:
        return len(self.nodes) > 2 and self.nodes[0] == self.nodes[-1]


def carried(
    mesh: Mesh, boundaries: tuple[Boundary, ...], tracks: Tracks, domain: Domain, placed: PlacedMesh
) -> tuple[Boundary, ...]:
    """Return the boundaries of a file, on `mesh`, as boundaries of a mesh placed on its domain.

    In the file's order and direction, numbers at nodes interpolated by length. A segment of ADCIRC that falls
    apart becomes several with the same code.
    """
    sides = _sides(mesh, tracks, domain, placed)
    paths = [_paths(sides, sides.track == k, track) for k, track in enumerate(tracks.tracks)]
    result: list[Boundary] = []
    for k, track in enumerate(tracks.tracks):
        boundary = boundaries[track.boundary]
        if boundary.partners is not None:
            if track.is_partner:
                continue
            pair = _paired(boundary, domain, (track, tracks.tracks[k + 1]), (paths[k], paths[k + 1]))
            result += [pair] if pair is not None else [
                Boundary(boundary.kind, path.nodes, boundary.code, boundary.name)
                for path in (*paths[k], *paths[k + 1])
            ]  # fmt: skip
        elif track.is_ordered:
            own = paths[k]
            if len(own) == tracks.missing[k] + 1:  # the file steps from end to end where there is no edge
                own = [
                    _Path(*(np.concatenate(p) for p in zip(*((x.nodes, x.place) for x in own), strict=True)))
                ]
            result += [_segment(boundary, track, path) for path in own]
        else:
            edges = sides.ends[sides.track == k]
            if len(edges):
                result.append(
                    Boundary(boundary.kind, np.unique(edges), boundary.code, boundary.name, edges=edges)
                )
    return tuple(result)


def _sides(mesh: Mesh, tracks: Tracks, domain: Domain, placed: PlacedMesh) -> _Sides:
    triangle, at = np.nonzero((placed.codes >= 0) & (placed.codes % 2 == 0))
    curve, start, end = side_arcs(domain, placed, triangle, at)
    ends = np.column_stack(
        [placed.triangles[triangle, (at + 1) % 3], placed.triangles[triangle, (at + 2) % 3]]
    )
    row = _rows(domain, curve, 0.5 * (start + end))
    nodes = domain.source[np.column_stack([domain.curve_nodes[row], domain.curve_nodes[row + 1]])]
    edge = edge_numbers(mesh, nodes)
    first = np.searchsorted(tracks.edge, edge)
    n_tracks = np.searchsorted(tracks.edge, edge, side="right") - first
    side = np.repeat(np.arange(len(edge)), n_tracks)
    found = np.repeat(first - np.cumsum(n_tracks) + n_tracks, n_tracks) + np.arange(len(side))
    is_along = tracks.start[found] == nodes[side, 0]
    half = 0.5 * domain.scale * (end - start)[side]
    length = domain.curve_lengths[curve]
    middle = 0.5 * (start + end)
    middle = np.where(domain.lines.is_closed[curve], np.mod(middle, length), middle)
    arcs = domain.curve_points[:, 2]
    gone = np.where(is_along, (middle - arcs[row])[side], (arcs[row + 1] - middle)[side])
    place = tracks.place[found] + domain.scale * gone
    is_ordered = np.array([track.is_ordered for track in tracks.tracks], dtype=bool)[tracks.track[found]]
    return _Sides(
        tracks.track[found],
        np.where((is_along | ~is_ordered)[:, None], ends[side], ends[side][:, ::-1]),
        np.column_stack([place - half, place + half]),
        np.where(is_ordered, place, middle[side]),
        np.where(is_ordered, 0, curve[side]),
    )


def _rows(domain: Domain, curve: Ints, arc: Floats) -> Ints:
    """Return the row of the curves' points before each arc length, (n,)."""
    lengths, lines = domain.curve_lengths, domain.lines
    base = np.concatenate([[0.0], np.cumsum(lengths + 1.0)[:-1]])
    axis = np.repeat(base, np.diff(lines.first)) + domain.curve_points[:, 2]
    inside = np.where(lines.is_closed[curve], np.mod(arc, lengths[curve]), arc)
    row = np.searchsorted(axis, base[curve] + inside, side="right") - 1
    return np.asarray(np.clip(row, lines.first[curve], lines.first[curve + 1] - 2))


def _paths(sides: _Sides, is_own: Bools, track: Track) -> list[_Path]:
    """Return the sides of a track joined end to end, in its direction."""
    own = np.flatnonzero(is_own)
    if not len(own) or not track.is_ordered:
        return []
    own = own[np.lexsort([sides.order[own], sides.curve[own]])]
    ends = sides.ends[own]
    is_break = np.flatnonzero(ends[1:, 0] != ends[:-1, 1]) + 1
    parts = [part for part in np.split(np.arange(len(own)), is_break) if len(part)]
    if (
        len(parts) > 1
        and ends[parts[-1][-1], 1] == ends[parts[0][0], 0]
        and track.nodes[0] == track.nodes[-1]
    ):
        parts = [np.concatenate([parts[-1], parts[0]]), *parts[1:-1]]
    place = sides.place[own]
    return [
        _Path(np.append(ends[part, 0], ends[part[-1], 1]), np.append(place[part, 0], place[part[-1], 1]))
        for part in parts
    ]


def _segment(boundary: Boundary, track: Track, path: _Path) -> Boundary:
    nodes, place = path.nodes, path.place
    is_repeated = boundary.nodes[0] == boundary.nodes[-1]
    if path.is_closed and not is_repeated:
        nodes, place = nodes[:-1], place[:-1]
    return Boundary(
        boundary.kind, nodes, boundary.code, boundary.name, columns=_columns(boundary, track, place)
    )


def _columns(boundary: Boundary, track: Track, place: Floats) -> Floats | None:
    """Return the numbers at the boundary's nodes interpolated to lengths along it."""
    if boundary.columns is None:
        return None
    values = boundary.columns[np.arange(len(track.nodes)) % boundary.n_nodes]
    return np.column_stack([np.interp(place, track.length, column) for column in values.T])


def _paired(
    boundary: Boundary, domain: Domain, tracks: tuple[Track, Track], paths: tuple[list[_Path], list[_Path]]
) -> Boundary | None:
    """Return a barrier with its pairs; None where its sides are not cut alike.

    As many nodes on both, those that were kept paired as in the file, no other off by a whole step.
    """
    here, across = paths
    if len(here) != 1 or len(across) != 1 or len(here[0].nodes) != len(across[0].nodes):
        return None
    a, b = (_numbers(path[0], track) for path, track in zip(paths, tracks, strict=True))
    kept = np.flatnonzero(np.isin(boundary.nodes, domain.source[domain.is_kept]))
    is_kept = (np.abs(a[:, None] - kept) < WHOLE).any(axis=1)
    step = np.diff(b)
    room = np.maximum(np.append(step, 0.0), np.insert(step, 0, 0.0))
    if (np.abs(a - b) >= np.where(is_kept, WHOLE, room)).any():
        return None
    return Boundary(
        boundary.kind, here[0].nodes, boundary.code, boundary.name,
        partners=across[0].nodes, columns=_columns(boundary, tracks[0], here[0].place),
    )  # fmt: skip


def _numbers(path: _Path, track: Track) -> Floats:
    """Return where the nodes of a path lie between the nodes of its track, counted from 0, (n,)."""
    return np.asarray(np.interp(path.place, track.length, np.arange(len(track.nodes))))


def unpaired_nodes(
    mesh: Mesh, boundaries: tuple[Boundary, ...], tracks: Tracks, domain: Domain, placed: PlacedMesh
) -> Ints:
    """Return nodes of the barriers whose sides are not cut alike, where either is cut, both sides, (k,)."""
    sides = _sides(mesh, tracks, domain, placed)
    result = [np.empty(0, dtype=np.int64)]
    for k, track in enumerate(tracks.tracks):
        boundary = boundaries[track.boundary]
        if boundary.partners is None or track.is_partner:
            continue
        both = (track, tracks.tracks[k + 1])
        paths = [_paths(sides, sides.track == k + j, both[j]) for j in (0, 1)]
        if _paired(boundary, domain, both, (paths[0], paths[1])) is None:
            cuts = np.concatenate(
                [_numbers(path, both[j]) for j in (0, 1) for path in paths[j]] or [np.empty(0)]
            )
            nodes = np.unique(np.rint(cuts).astype(np.int64))
            result += [boundary.nodes[nodes], boundary.partners[nodes]]
    return np.unique(np.concatenate(result))
