"""Layouts made by hand: a hexagon of six blocks in a many-sided disc, no annealing."""

from __future__ import annotations

import numpy as np

from bsgplan.blocks.domain import domain_of
from bsgplan.blocks.kinds import INTERIOR, SLIDING
from bsgplan.blocks.layout import BlockGrid, BlockLayout
from bsgplan.blocks.placed import PlacedMesh
from bsgplan.blocks.subdivide import subdivide
from bsgplan.blocks.target import Target
from bsgplan.mesh import Mesh
from bsgplan.sizing import SizeField

SIDES = 96


def disc(h: float) -> SizeField:
    """A disc of radius 1 as a fan of SIDES triangles, with one size everywhere."""
    turn = 2 * np.pi * np.arange(SIDES) / SIDES
    points = np.concatenate([[[0.0, 0.0]], np.column_stack([np.cos(turn), np.sin(turn)])])
    rim = 1 + np.arange(SIDES)
    triangles = np.column_stack([np.zeros(SIDES, dtype=int), rim, np.roll(rim, -1)])
    return SizeField(Mesh(points, triangles), np.full(SIDES + 1, h))


def hexagon(h: float, side: int, *, snap: bool) -> BlockGrid:
    """Six blocks around the middle of the disc, their rim nodes on the circle if snapped."""
    size = disc(h)
    domain = domain_of(size.mesh)
    first = 1 + SIDES // 6 * np.arange(6)
    where = np.concatenate([[0], [int(np.flatnonzero(domain.source == p)[0]) for p in first]])
    codes = np.full((6, 3), -1)
    codes[:, 0] = 0
    placed = PlacedMesh(
        points=domain.points[where],
        triangles=np.column_stack([np.zeros(6, dtype=int), 1 + np.arange(6), 1 + (np.arange(6) + 1) % 6]),
        codes=codes,
        kinds=np.array([INTERIOR] + [SLIDING] * 6),
        curves=np.array([-1] + [0] * 6),
        arcs=domain.arc_of_point[where],
        goals=np.array([6.0] + [4.0] * 6),
        hints=np.zeros(7, dtype=int),
    )
    n = domain.n_points
    target = Target(
        side=side,
        length=np.full(n, side * h),
        is_corner=np.zeros(n, dtype=bool),
        turning=np.zeros(n),
        gradient_limit=1.0,
        raggedness=0.0,
        blocks={"resolution": 6.0, "gradient": 6.0, "boundary": 6.0},
    )
    cut = subdivide(
        domain,
        placed,
        side,
        np.full(n, np.log(side * h / domain.scale)),
        bend=np.full(len(placed.topology.edges), float(snap)),
    )
    return BlockGrid(BlockLayout(size, domain, target, placed), cut.mesh, cut.block, cut.i, cut.j, not snap)
