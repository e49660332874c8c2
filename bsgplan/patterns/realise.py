"""The noun Realised: a pattern as a block triangulation with coordinates, and its irregular vertices.

Open fronts are arcs across the x axis, the first at x = 0, their vertices numbered upwards: vertical lines
where the region is straight, arcs of one common angle where its fronts grow or shrink with the distance.
Closed fronts are circles around the z axis; in the plane where all layers are flat, in space otherwise.
Invariants: blocks come strip by strip in the order of `strip_triangles`, counter-clockwise in the plane
(seen from outside in space); irregularities of a front sum to Eq. 16.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints, frozen_floats, frozen_ints
from ..mesh.irregularity import Irregularity, summed
from ..mesh.topology import topology
from .frustum import rise
from .pattern import Pattern
from .shape import Shape
from .strip import ring_turn, strip_triangles

WIDEST = 1.9 * np.pi
"""Angle of an open region beyond which its drawing would overlap itself, radians."""


@dataclass(frozen=True, eq=False)
class Realised:
    """The blocks of a pattern as a triangulation."""

    points: Floats
    """Block corners, (n, 2) or (n, 3), length, front after front."""
    triangles: Ints
    """Corner indices of each block, (n_blocks, 3)."""
    front: Ints
    """Front of each corner, (n,), numbered from 0."""
    is_closed: bool = False
    """True where fronts are rings."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen_floats(self.points))
        object.__setattr__(self, "triangles", frozen_ints(self.triangles))
        object.__setattr__(self, "front", frozen_ints(self.front))


def realise(pattern: Pattern, shape: Shape, positions: Floats) -> Realised:
    """Return the block triangulation of a pattern with its fronts at these positions, (n_fronts,), length.

    >>> realise(Pattern.parse("2:1"), Shape.rectangle(1.0), np.array([0.0, 1.0])).points.tolist()
    [[0.0, -0.5], [0.0, 0.0], [0.0, 0.5], [1.0, -0.5], [1.0, 0.5]]
    """
    positions = np.asarray(positions, dtype=np.float64)
    n_points = np.array(pattern.counts) + (not pattern.is_closed)
    start = np.concatenate([[0], np.cumsum(n_points)])
    front = np.repeat(np.arange(pattern.n_fronts), n_points)
    share = (np.arange(start[-1]) - start[front]) / np.array(pattern.counts)[front]
    place = _on_rings if pattern.is_closed else _on_arcs
    points = place(pattern, shape, positions, share, front)
    triangles = np.concatenate(
        [
            strip_triangles(m, n, is_closed=pattern.is_closed) + offset
            for (m, n), offset in zip(pattern.strips, start, strict=False)
        ]
    )
    is_outward = points.shape[1] == 2 and shape.lengths[0] < shape.lengths[-1]
    if pattern.is_closed and not is_outward:
        triangles = triangles[:, ::-1]
    return Realised(points, triangles, front, pattern.is_closed)


def relative_irregularity(realised: Realised) -> Ints:
    """Return the irregularity of each corner relative to the unit square, (n,).

    [Zint & Grosso], Definition 4. Valence minus 6 inside and 4 on a boundary; at the corners of an
    open region minus 2 lower left and upper right, 3 upper left and lower right.
    """
    mesh = topology(realised.triangles, len(realised.points))
    regular = np.where(mesh.is_boundary, 4, 6)
    if not realised.is_closed:
        first, last = (
            np.flatnonzero(realised.front == 0),
            np.flatnonzero(realised.front == realised.front[-1]),
        )
        regular[[first[0], first[-1], last[0], last[-1]]] = [2, 3, 3, 2]
    return mesh.valence - regular


def vertex_irregularity_of_fronts(realised: Realised) -> tuple[Irregularity, ...]:
    """Return the positive and negative sums over the corners of each front, Definition 8, Eq. 13 and 14.

    >>> realised = realise(Pattern.parse("4:1"), Shape.rectangle(1.0), np.array([0.0, 1.0]))
    >>> [(i.positive, i.negative) for i in vertex_irregularity_of_fronts(realised)]
    [(0, -3), (3, 0)]
    """
    values = relative_irregularity(realised)
    return tuple(summed(values[realised.front == k]) for k in range(int(realised.front[-1]) + 1))


def _on_arcs(_: Pattern, shape: Shape, positions: Floats, share: Floats, front: Ints) -> Floats:
    lengths = shape.front_lengths(positions)
    slope = np.polyfit(positions - positions.mean(), lengths, 1)[0]
    angle = float(np.clip(slope, -WIDEST, WIDEST)) * (share - 0.5)
    length = lengths[front] * (share - 0.5)
    sag = length * np.sinc(angle / (2 * np.pi)) * np.sin(angle / 2)
    return np.column_stack([positions[front] - sag, length * np.sinc(angle / np.pi)])


def _on_rings(pattern: Pattern, shape: Shape, positions: Floats, share: Floats, front: Ints) -> Floats:
    turns = np.cumsum([0.0, *(float(ring_turn(m, n)) for m, n in pattern.strips)])
    radius = shape.front_lengths(positions) / (2 * np.pi)
    rises = rise(np.diff(positions), np.diff(radius))
    angle = 2 * np.pi * (share + turns[front])
    plane: Floats = radius[front, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    if not rises.any() and abs(np.sign(np.diff(radius)).sum()) == len(rises):
        return plane
    z = np.concatenate([[0.0], np.cumsum(rises)])
    return np.column_stack([plane, z[front]])
