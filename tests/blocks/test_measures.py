"""Measures of layouts: a hexagon in a disc by hand, an exponential size in closed form, real grids."""

from __future__ import annotations

import numpy as np
import pytest
from layouts_by_hand import SIDES, disc, hexagon

from bsgplan.blocks.measures import (
    NODES,
    boundary_deviation,
    edge_ratio,
    grid_measures,
    input_measures,
    layout_measures,
    least_time_step,
    target_conformity,
)
from bsgplan.mesh import Mesh


def test_six_equilateral_blocks_are_perfect_and_their_sides_as_wanted():
    layout = hexagon(0.25, 4, snap=True).layout  # s h is the side of the hexagon
    found = layout_measures(layout)
    assert (found.n_blocks, found.n_triangles) == (6, 96)
    assert found.q_min == pytest.approx(1.0)
    assert found.irregular_interior == 0
    assert found.irregular_boundary == 6  # valence 3 of 4: a hexagon's corners
    assert found.irregular_boundary_fitted == 0  # two triangles for 120 degrees
    assert (found.irregularity.positive, found.irregularity.negative) == (0, -6)
    for ratio in (found.edge_ratio, target_conformity(layout)):
        assert [ratio.p05, ratio.p50, ratio.p95] == pytest.approx([1.0, 1.0, 1.0])
        assert ratio.rms_log == pytest.approx(0.0, abs=1e-12)


def test_blocks_half_as_long_as_wanted_have_ratio_one_half():
    ratio = layout_measures(hexagon(0.5, 4, snap=True).layout).edge_ratio
    assert ratio.p50 == pytest.approx(0.5)
    assert ratio.rms_log == pytest.approx(np.log(2))


def test_straight_blocks_miss_the_circle_by_the_sagitta_and_snapped_ones_by_less():
    h = 0.25
    most, common = boundary_deviation(hexagon(h, 4, snap=False))
    rim = np.cos(np.pi / SIDES)  # middle of a side of the polygon; the hexagon's middle lies at a vertex
    assert most == pytest.approx((1 - np.cos(np.pi / 6)) / h, rel=1e-3)
    assert common <= most
    close, _ = boundary_deviation(hexagon(h, 4, snap=True))
    assert close <= (1 - np.cos(np.pi / 24)) / h + (1 - rim) / h
    assert boundary_deviation(hexagon(h, 16, snap=True))[0] == pytest.approx(0.0, abs=1e-9)


def test_the_five_point_rule_holds_an_exponential_size():
    start, end, slope = np.array([0.0, 1.0]), np.array([1.0, 3.0]), 0.9
    at = (start[:, None] * (1 - NODES) + end[:, None] * (1 + NODES)) / 2
    found = edge_ratio(end - start, slope * at)
    exact = (np.exp(-slope * start) - np.exp(-slope * end)) / slope
    assert found.rms_log == pytest.approx(np.sqrt((np.log(exact) ** 2).mean()), rel=1e-6)


def test_the_measures_of_the_input_are_those_of_info():
    found = input_measures(disc(0.1))
    assert found.n_blocks is None
    assert found.n_triangles == SIDES
    assert found.irregular_interior == 1
    assert found.irregularity.positive == SIDES - 6


def test_the_grid_counts_every_triangle():
    grid = hexagon(0.25, 4, snap=True)
    found = grid_measures(grid)
    assert found.n_triangles == grid.n_triangles == 96
    assert found.n_blocks == 6
    assert 0.8 < found.edge_ratio.p50 < 1.2


def test_the_least_time_step_is_that_of_the_shortest_edge_over_the_deepest_water():
    mesh = Mesh(np.array([[0.0, 0], [3, 0], [0, 4]]), np.array([[0, 1, 2]]))
    depth = np.array([4.0, 1.0, 9.0])
    assert least_time_step(mesh, depth) == pytest.approx(4 / np.sqrt(9.81 * 9))
    assert least_time_step(mesh, depth, np.full(3, 2.0)) == pytest.approx(2 / np.sqrt(9.81 * 9))
    assert least_time_step(mesh, np.array([-1.0, 0.0, -2.0])) is None
