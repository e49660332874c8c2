"""The boundaries of a mesh file as directed edges of its mesh: which edge belongs to which, and where on it.

A track is one boundary, or one side of a barrier, which has two. An edge may lie on several tracks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..io import Boundary
from ..mesh import Mesh
from ..mesh.edges import edge_numbers

ISLANDS = (1, 11, 21)
"""IBTYPEs of ADCIRC whose last node is joined to the first."""


@dataclass(frozen=True, eq=False)
class Track:
    """A boundary, or one side of a barrier."""

    boundary: int
    """Index of the boundary in the file."""
    is_partner: bool
    """True for the second side of a barrier."""
    is_ordered: bool
    """True where the file lists the nodes along the boundary."""
    nodes: Ints
    """The nodes in the file's order where it is ordered, closed islands with the first one again, (n,)."""
    length: Floats
    """Length of the track up to each of these nodes, (n,)."""


@dataclass(frozen=True, eq=False)
class Tracks:
    """All tracks of a file, and their edges one after the other."""

    tracks: tuple[Track, ...]
    edge: Ints
    """Edge of `mesh.topology` of each, (n,), sorted."""
    track: Ints
    """Track of each, (n,)."""
    start: Ints
    """The end that the file names first, (n,)."""
    place: Floats
    """Length of the track up to `start`, (n,); 0 where it is not ordered."""
    missing: tuple[int, ...]
    """Steps from node to node that are no edge of the mesh, one number a track."""


def find_tracks(mesh: Mesh, boundaries: Sequence[Boundary]) -> Tracks:
    """Return the boundaries as edges of the mesh.

    A named boundary that is a mere set of nodes has the boundary edges with both ends in it; an edge in
    several sets belongs to the smallest.
    """
    tracks: list[Track] = []
    parts: list[tuple[Ints, Floats]] = []
    owner = _owners(mesh, boundaries)
    for k, boundary in enumerate(boundaries):
        sides = [boundary.nodes] if boundary.partners is None else [boundary.nodes, boundary.partners]
        for is_partner, nodes in enumerate(sides):
            is_ordered = boundary.edges is None and boundary.kind != "named"
            if is_ordered and boundary.code in ISLANDS and len(nodes) > 2 and nodes[0] != nodes[-1]:
                nodes = np.append(nodes, nodes[0])
            ends = np.column_stack([nodes[:-1], nodes[1:]])
            if not is_ordered:
                ends = boundary.edges if boundary.edges is not None else mesh.topology.edges[owner == k]
            step = np.linalg.norm(mesh.points[ends[:, 1]] - mesh.points[ends[:, 0]], axis=1)
            length = np.concatenate([[0.0], np.cumsum(step)]) if is_ordered else np.zeros(len(nodes))
            tracks.append(Track(k, bool(is_partner), is_ordered, nodes, length))
            parts.append((ends, length[:-1] if is_ordered else np.zeros(len(ends))))
    ends = np.concatenate([np.empty((0, 2), dtype=np.int64), *(ends for ends, _ in parts)])
    place = np.concatenate([np.empty(0), *(place for _, place in parts)])
    track = np.repeat(np.arange(len(parts)), [len(ends) for ends, _ in parts])
    edge = edge_numbers(mesh, ends)
    missing = np.bincount(track[edge < 0], minlength=len(parts))
    order = np.lexsort([track, edge])
    order = order[edge[order] >= 0]
    is_new = np.ones(len(order), dtype=bool)
    is_new[1:] = (np.diff(edge[order]) != 0) | (np.diff(track[order]) != 0)
    order = order[is_new]
    return Tracks(
        tuple(tracks), edge[order], track[order], ends[order, 0], place[order], tuple(missing.tolist())
    )


def changes(mesh: Mesh, is_line: Bools, tracks: Tracks) -> Ints:
    """Return the points where tracks begin or end on the marked edges, (k,), sorted.

    is_line marks edges of `mesh.topology`, (n_edges,). A point where one boundary follows another is one of
    them; one where the same go on is not.
    """
    edges = mesh.topology.edges
    n_lines = np.bincount(edges[is_line].ravel(), minlength=mesh.n_points)
    on_line = is_line[tracks.edge]
    point = edges[tracks.edge[on_line]].ravel()
    key, count = np.unique(
        point * max(len(tracks.tracks), 1) + np.repeat(tracks.track[on_line], 2), return_counts=True
    )
    at = key // max(len(tracks.tracks), 1)
    return np.unique(at[count < n_lines[at]])


def _owners(mesh: Mesh, boundaries: Sequence[Boundary]) -> Ints:
    """Return the smallest named set of nodes that has both ends of each boundary edge, (n_edges,), or -1."""
    owner = np.full(len(mesh.topology.edges), -1, dtype=np.int64)
    sets = [k for k, b in enumerate(boundaries) if b.kind == "named" and b.edges is None]
    for k in sorted(sets, key=lambda k: -boundaries[k].n_nodes):
        is_in = np.zeros(mesh.n_points, dtype=bool)
        is_in[boundaries[k].nodes] = True
        owner[is_in[mesh.topology.edges].all(axis=1) & mesh.topology.is_boundary_edge] = k
    return owner
