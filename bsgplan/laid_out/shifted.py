"""Boundaries of a file on a mesh whose boundary points moved along the boundary, came and went.

Between two points that stay, the boundary of the new mesh stands for that of the old one: a list of nodes,
whose ends stay, gets the new nodes there, and numbers at nodes are interpolated by length.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..io import Boundary
from ..mesh import Mesh
from ..mesh.edges import edge_numbers, loops_of
from .tracks import ISLANDS, changes, find_tracks

Interval = tuple[int, int]
"""Two points of the new mesh that stayed, one after the other with the domain on the left."""


def free_edges(mesh: Mesh, boundaries: tuple[Boundary, ...]) -> tuple[Bools, Ints]:
    """Return the boundary edges whose points may move, (n_edges,), and the points that stay all the same.

    Barriers stay, for their sides are paired; so do the ends of every list, all nodes of a list that is not
    all on the boundary, loops that touch themselves, and one point of each loop.
    """
    topology = mesh.topology
    is_free = topology.is_boundary_edge.copy()
    kept = [changes(mesh, topology.is_boundary_edge, find_tracks(mesh, boundaries))]
    for boundary in boundaries:
        kept.append(boundary.nodes[[0, -1]])
        edges = _edges_of(mesh, boundary)
        is_whole = len(edges) and topology.is_boundary_edge[edges[edges >= 0]].all() and (edges >= 0).all()
        covers = np.isin(boundary.nodes, topology.edges[edges[edges >= 0]]).all()
        if boundary.partners is not None or not (is_whole and covers):
            held = np.isin(topology.edges, boundary.nodes).any(axis=1)
            if boundary.partners is not None:
                held |= np.isin(topology.edges, boundary.partners).any(axis=1)
                kept.append(boundary.partners)
            is_free &= ~held
            kept.append(boundary.nodes)
    rim = np.flatnonzero(topology.is_boundary_edge)
    n_fans = topology.valence - topology.n_cells_at
    pinched = np.unique(topology.edge_loop[(n_fans[topology.edges[rim]] > 1).any(axis=1)])
    is_free[rim[np.isin(topology.edge_loop, pinched)]] = False
    _, first = np.unique(topology.edge_loop, return_index=True)
    kept.append(topology.edges[rim[first], 0])
    return is_free, np.unique(np.concatenate(kept))


def shifted(old: Mesh, new: Mesh, new_index: Ints, boundaries: tuple[Boundary, ...]) -> tuple[Boundary, ...]:
    """Return the boundaries on the new mesh; new_index is the new point of each old one, -1 where gone."""
    before = _intervals(old, new_index)
    after = _intervals(new, np.arange(new.n_points), stays=np.isin(np.arange(new.n_points), new_index))
    interval_of = {
        edge: (interval, at) for interval, path in before.items() for at, edge in enumerate(pairwise(path))
    }
    return tuple(_shifted(old, new, new_index, b, before, after, interval_of) for b in boundaries)


def _shifted(
    old: Mesh,
    new: Mesh,
    new_index: Ints,
    boundary: Boundary,
    before: dict[Interval, list[int]],
    after: dict[Interval, list[int]],
    interval_of: dict[tuple[int, int], tuple[Interval, int]],
) -> Boundary:
    if boundary.partners is not None:
        return boundary.renumbered(new_index)
    if boundary.edges is not None or boundary.kind == "named":
        return _set(old, new_index, boundary, after, interval_of)
    is_joined = boundary.code in ISLANDS and boundary.n_nodes > 2 and boundary.nodes[0] != boundary.nodes[-1]
    listed = np.append(boundary.nodes, boundary.nodes[:1]) if is_joined else boundary.nodes
    nodes, place = [int(new_index[listed[0]])], [0.0]
    length = _lengths(old, listed)
    seen: Interval | None = None
    for at, (a, b) in enumerate(pairwise(listed.tolist())):
        is_along = (a, b) in interval_of
        found = interval_of.get((a, b), interval_of.get((b, a)))
        if found is None:
            nodes.append(int(new_index[b]))
            place.append(float(length[at + 1]))
            seen = None
            continue
        interval, step = found
        n_steps = len(before[interval]) - 1
        if interval != seen:
            path = after[interval] if is_along else after[interval][::-1]
            part = _lengths(new, np.array(path))
            start = length[at - (step if is_along else n_steps - 1 - step)]
            span = length[at - (step if is_along else n_steps - 1 - step) + n_steps] - start
            nodes += path[1:]
            place += (start + part[1:] / part[-1] * span).tolist()
        seen = interval if (step < n_steps - 1 if is_along else step > 0) else None
    if is_joined:
        nodes, place, length = nodes[:-1], place[:-1], length[:-1]
    columns = boundary.columns
    if columns is not None:
        columns = np.column_stack([np.interp(place, length, column) for column in columns.T])
    return replace(boundary, nodes=np.array(nodes), columns=columns)


def _set(
    old: Mesh,
    new_index: Ints,
    boundary: Boundary,
    after: dict[Interval, list[int]],
    interval_of: dict[tuple[int, int], tuple[Interval, int]],
) -> Boundary:
    """Return a boundary that is a set of edges, or of nodes."""
    own = _edges_of(old, boundary)
    ends = old.topology.edges[own[own >= 0]]
    edges: dict[tuple[int, int], None] = {}
    for a, b in ends.tolist():
        found = interval_of.get((a, b), interval_of.get((b, a)))
        if found is None:
            edges[int(new_index[a]), int(new_index[b])] = None
        else:
            edges.update(dict.fromkeys(pairwise(after[found[0]])))
    made = np.array(list(edges), dtype=np.int64).reshape(-1, 2)
    stays = new_index[boundary.nodes]
    nodes = np.unique(np.concatenate([made.ravel(), stays[stays >= 0]]))
    return replace(boundary, nodes=nodes, edges=None if boundary.edges is None else made)


def _edges_of(mesh: Mesh, boundary: Boundary) -> Ints:
    """Return the edges of a boundary, -1 for steps that are none."""
    if boundary.edges is None and boundary.kind == "named":
        is_in = np.zeros(mesh.n_points, dtype=bool)
        is_in[boundary.nodes] = True
        both = is_in[mesh.topology.edges].all(axis=1)
        return np.flatnonzero(both & mesh.topology.is_boundary_edge)
    return edge_numbers(mesh, boundary.segments)


def _lengths(mesh: Mesh, nodes: Ints) -> Floats:
    step = np.linalg.norm(np.diff(mesh.points[nodes], axis=0), axis=1)
    return np.concatenate([[0.0], np.cumsum(step)])


def _intervals(mesh: Mesh, new_index: Ints, *, stays: Bools | None = None) -> dict[Interval, list[int]]:
    """Return the points of a mesh from one that stays to the next along its boundary, domain on the left."""
    stays = new_index >= 0 if stays is None else stays
    result: dict[Interval, list[int]] = {}
    for loop in boundary_loops(mesh):
        kept = np.flatnonzero(stays[loop])
        if not len(kept):
            continue
        round_loop = np.concatenate([loop[kept[0] :], loop[: kept[0] + 1]])
        cuts = np.flatnonzero(stays[round_loop])
        for first, last in pairwise(cuts.tolist()):
            path = round_loop[first : last + 1].tolist()
            result[int(new_index[path[0]]), int(new_index[path[-1]])] = path
    return result


def boundary_loops(mesh: Mesh) -> list[Ints]:
    """Return the points of each boundary loop, domain on the left, a pinch in each loop through it."""
    fans = mesh.topology.boundary_fans
    point = np.empty(int(mesh.topology.corner_fan.max()) + 1, dtype=np.int64)
    point[mesh.topology.corner_fan.ravel()] = mesh.triangles.ravel()
    return [point[loop] for loop in loops_of(fans)]
