"""Blocks cut into s x s triangles, boundary nodes on the true boundary, the inside following smoothly."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..arrays import Floats, Ints
from .curve_places import CurvePlaces, side_arcs
from .domain import Domain
from .kinds import CORNER, INTERIOR, JUNCTION, SLIDING
from .placed import PlacedMesh


@dataclass(frozen=True, eq=False)
class Subdivision:
    """A mesh of blocks cut into triangles."""

    mesh: PlacedMesh
    """The fine mesh; its nodes on curves know their places."""
    block: Ints
    """Block of each triangle, (n_triangles,)."""
    i: Ints
    """Steps from the block's corner 0 towards corner 1, (n_triangles,)."""
    j: Ints
    """Steps from the block's corner 0 towards corner 2, (n_triangles,)."""


def subdivide(
    domain: Domain, blocks: PlacedMesh, side: int, log_size: Floats, *, bend: Floats
) -> Subdivision:
    """Return blocks cut into side x side triangles each, (n_blocks * side^2).

    log_size is the log of the wanted block edge at the domain's points. bend is 1 for each edge, (n_edges,),
    whose nodes lie on its curve, halfway between equal arc lengths and equal lengths in the size field, 0
    for straight ones, and between for a share of the way. The nodes inside follow by (1 - lambda)^2, lambda
    the barycentric coordinate of the corner opposite.
    """
    lattice = _lattice(side)
    topology = blocks.topology
    n_vertices, n_edges, n_blocks = len(blocks.points), len(topology.edges), len(blocks.triangles)
    numbers = _numbers(blocks, side)
    corners = blocks.points[blocks.triangles]
    points = np.einsum("nc,tcx->tnx", lattice.weights, corners)
    n_nodes = n_vertices + n_edges * (side - 1) + n_blocks * lattice.n_inside
    xy, kinds = np.empty((n_nodes, 2)), np.full(n_nodes, INTERIOR)
    curves, arcs = np.full(n_nodes, -1), np.zeros(n_nodes)
    triangle, at = np.nonzero(blocks.codes >= 0)
    bows = np.zeros((n_blocks, 3, side + 1, 2))
    if len(triangle) and side > 1:
        curve, arc, bow = _bows(domain, blocks, triangle, at, side, log_size)
        nodes = numbers[triangle[:, None], lattice.sides[at]][:, 1:-1]
        share = bend[topology.cell_edges[triangle, (at + 1) % 3]]
        kinds[nodes] = np.where(share < 1, CORNER, SLIDING)[:, None]
        curves[nodes], arcs[nodes] = curve[:, None], _on_curve(domain, curve, arc[:, 1:-1])
        bows[triangle, at] = share[:, None, None] * bow
        if share.any():
            points += _displacement(lattice, bows)
    xy[numbers] = points
    if len(triangle) and side > 1:
        snapped = share == 1
        xy[nodes[snapped]] = CurvePlaces(domain, log_size).points(curve[snapped, None], arc[snapped, 1:-1])
    kinds[:n_vertices], curves[:n_vertices] = blocks.kinds, blocks.curves
    arcs[:n_vertices], xy[:n_vertices] = blocks.arcs, blocks.points
    kinds[:n_vertices][blocks.kinds == CORNER] = CORNER
    hints = np.empty(n_nodes, dtype=np.int64)
    hints[numbers] = blocks.hints[blocks.triangles[:, :1]]
    codes = np.full((n_blocks, side * side, 3), -1)
    for k in range(3):
        codes[:, lattice.along[k], lattice.own_side[k]] = blocks.codes[:, k, None]
    fine = PlacedMesh(
        points=xy,
        triangles=numbers[:, lattice.triangles].reshape(-1, 3),
        codes=codes.reshape(-1, 3),
        kinds=kinds,
        curves=np.where(kinds == JUNCTION, -1, curves),
        arcs=arcs,
        goals=np.where(kinds == INTERIOR, 6.0, 4.0),
        hints=hints,
    )
    block = np.repeat(np.arange(n_blocks), side * side)
    return Subdivision(fine, block, np.tile(lattice.i, n_blocks), np.tile(lattice.j, n_blocks))


@dataclass(frozen=True, eq=False)
class _Lattice:
    weights: Floats
    """Barycentric coordinates of each node, (n, 3)."""
    triangles: Ints
    i: Ints
    j: Ints
    sides: Ints
    """Nodes along the side opposite each corner, from corner + 1 to corner + 2, (3, side + 1)."""
    inside: Ints
    along: tuple[Ints, ...]
    """Triangles at the side opposite each corner."""
    own_side: tuple[int, ...]
    """Which of its own sides those have there."""

    @property
    def n_inside(self) -> int:
        return len(self.inside)


@lru_cache(maxsize=16)
def _lattice(side: int) -> _Lattice:
    nodes = [(i, j) for i in range(side + 1) for j in range(side + 1 - i)]
    number = {node: k for k, node in enumerate(nodes)}
    ij = np.array(nodes)
    weights = np.column_stack([side - ij.sum(axis=1), ij]) / side
    cells = [(i, j, False) for i in range(side) for j in range(side - i)]
    cells += [(i, j, True) for i in range(side) for j in range(side - 1 - i)]
    triangles = [
        (number[i + 1, j], number[i + 1, j + 1], number[i, j + 1])
        if down
        else (number[i, j], number[i + 1, j], number[i, j + 1])
        for i, j, down in cells
    ]
    sides = np.array(
        [
            [number[side - k, k] for k in range(side + 1)],  # corner 1 to corner 2
            [number[0, side - k] for k in range(side + 1)],  # corner 2 to corner 0
            [number[k, 0] for k in range(side + 1)],  # corner 0 to corner 1
        ]
    )
    inside = np.flatnonzero((weights > 0.5 / side).all(axis=1))
    cell = np.array([(i, j) for i, j, _ in cells])
    is_up = np.array([not down for _, _, down in cells])
    along = (
        np.flatnonzero(is_up & (cell.sum(axis=1) == side - 1)),
        np.flatnonzero(is_up & (cell[:, 0] == 0)),
        np.flatnonzero(is_up & (cell[:, 1] == 0)),
    )
    return _Lattice(weights, np.array(triangles), cell[:, 0], cell[:, 1], sides, inside, along, (0, 1, 2))


def _numbers(blocks: PlacedMesh, side: int) -> Ints:
    """Return the number of each lattice node of each block, (n_blocks, n_lattice_nodes)."""
    lattice, topology = _lattice(side), blocks.topology
    n_vertices, n_blocks = len(blocks.points), len(blocks.triangles)
    result = np.empty((n_blocks, len(lattice.weights)), dtype=np.int64)
    steps = np.arange(1, side)
    for k in range(3):
        a = (k + 1) % 3
        edge = topology.cell_edges[:, a]
        is_forward = blocks.triangles[:, a] == topology.edges[edge, 0]
        place = np.where(is_forward[:, None], steps, side - steps)
        result[:, lattice.sides[k, 1:-1]] = n_vertices + edge[:, None] * (side - 1) + place - 1
    for k, node in enumerate((lattice.sides[1, -1], lattice.sides[2, -1], lattice.sides[0, -1])):
        result[:, node] = blocks.triangles[:, k]
    start = n_vertices + len(topology.edges) * (side - 1)
    result[:, lattice.inside] = start + np.arange(n_blocks * lattice.n_inside).reshape(n_blocks, -1)
    return result


def _bows(
    domain: Domain, blocks: PlacedMesh, triangle: Ints, at: Ints, side: int, log_size: Floats
) -> tuple[Ints, Floats, Floats]:
    """Return curve, arcs (n, side + 1) and how far from the chord the nodes of sides on curves lie."""
    places = CurvePlaces(domain, log_size)
    curve, start, end = side_arcs(domain, blocks, triangle, at)
    share = np.linspace(0.0, 1.0, side + 1)
    metric_start, metric_end = places.metric(curve, start), places.metric(curve, end)
    metric = metric_start[:, None] + share * (metric_end - metric_start)[:, None]
    even = start[:, None] + share * (end - start)[:, None]
    arc = 0.5 * (even + places.arc_at(curve[:, None], metric))
    arc[:, 0], arc[:, -1] = start, end
    ends = blocks.points[blocks.triangles[triangle[:, None], np.stack([(at + 1) % 3, (at + 2) % 3], axis=1)]]
    chord = ends[:, :1] + share[:, None] * (ends[:, 1:] - ends[:, :1])
    bow = places.points(curve[:, None], arc) - chord
    bow[:, [0, -1]] = 0.0
    return curve, arc, bow


def _on_curve(domain: Domain, curve: Ints, arc: Floats) -> Floats:
    """Return arc lengths, (n, m), that may lie beyond the end of a closed curve, within the curve."""
    length = domain.curve_lengths[curve][:, None]
    return np.where(domain.lines.is_closed[curve][:, None] & (arc >= length), arc - length, arc)


def _displacement(lattice: _Lattice, bows: Floats) -> Floats:
    """Return how far the nodes of each block follow its bowed sides, (n_blocks, n_lattice_nodes, 2)."""
    side = bows.shape[2] - 1
    total = np.zeros((len(bows), len(lattice.weights), 2))
    for k in range(3):
        a, b = lattice.weights[:, (k + 1) % 3], lattice.weights[:, (k + 2) % 3]
        rest = a + b
        along = np.where(rest > 0, b / np.where(rest > 0, rest, 1.0), 0.0) * side
        low = np.minimum(along.astype(np.int64), side - 1)
        part = (along - low)[:, None]
        total += (rest**2)[:, None] * ((1 - part) * bows[:, k, low] + part * bows[:, k, low + 1])
    return total
