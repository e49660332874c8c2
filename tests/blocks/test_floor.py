"""The floor under irregular vertices, and the levels that a multigrid user plans by."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from layouts_by_hand import hexagon

from bsgplan.blocks.floor import floor_of
from bsgplan.blocks.kinds import CORNER
from bsgplan.blocks.levels import level, levels, ranks, sides
from bsgplan.mesh.topology import topology


def with_corners(goals: list[float]):
    layout = hexagon(0.25, 4, snap=True).layout
    placed = layout.placed
    n = len(goals)
    kinds, wanted = placed.kinds.copy(), placed.goals.copy()
    kinds[1 : n + 1], wanted[1 : n + 1] = CORNER, goals
    return floor_of(replace(layout, placed=replace(placed, kinds=kinds, goals=wanted)))


def test_a_smooth_disc_needs_six_irregular_vertices():
    floor = with_corners([])
    assert (floor.irregularity, floor.n_corners, floor.irregular) == (-6, 0, 6)


def test_corners_carry_what_fits_their_angle():
    assert with_corners([3.0] * 6).irregular == 0  # a hexagon: 120 degrees each, three edges
    square = with_corners([2.5] * 4)
    assert (square.corners, square.irregular) == ((-8, -4), 0)
    triangle = with_corners([2.0] * 3)
    assert (triangle.corners, triangle.irregular) == ((-6, -6), 0)
    slit = with_corners([7.0])  # 360 degrees
    assert (slit.corners, slit.irregular) == ((3, 3), 9)


@given(st.lists(st.floats(1.1, 7.0), max_size=6))
def test_the_floor_is_the_least_over_all_choices_of_the_corners(goals):
    floor = with_corners(goals)
    ways = [0]
    for goal in goals:
        fitting = [max(n, 2) - 4 for n in range(1, 9) if abs(n - goal) <= 0.51]
        ways = [total + v for total in ways for v in fitting]
    assert floor.irregular == min(abs(-6 - total) for total in ways)


def test_levels_count_what_the_grid_has():
    for side in (1, 2, 3, 4, 6):
        grid = hexagon(0.25, side, snap=True)
        blocks = grid.layout.placed.topology
        found = level(blocks, side)
        fine = topology(grid.placed.triangles, len(grid.placed.points))
        assert found.n_triangles == grid.n_triangles
        assert found.p1 == fine.n_points
        assert found.p2 == fine.n_points + len(fine.edges)
        between = grid.block[fine.edge_cells[~fine.is_boundary_edge]]
        assert found.interface_edges == np.count_nonzero(between[:, 0] != between[:, 1])


@pytest.mark.parametrize("side", range(1, 40))
def test_levels_run_from_blocks_to_triangles_by_whole_steps(side):
    found = sides(side)
    assert (found[0], found[-1]) == (1, side)
    assert all(b % a == 0 and b > a for a, b in pairwise(found))
    blocks = hexagon(0.25, 1, snap=True).layout.placed.topology
    assert tuple(x.side for x in levels(blocks, side)) == found


@given(st.integers(1, 10_000), st.integers(1, 5_000))
def test_ranks_share_out_every_block(n_blocks, n_ranks):
    found = ranks(n_blocks, n_ranks)
    n_most = n_blocks - found.blocks_least * n_ranks
    assert 0 <= n_most <= n_ranks
    assert found.blocks_most == found.blocks_least + (n_most > 0)
    assert found.imbalance == pytest.approx(found.blocks_most / (n_blocks / n_ranks))
