"""Quads: split along the better diagonal, areas kept, angles measured."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.mesh import clean
from bsgplan.mesh.quads import quad_angles, split_quads
from bsgplan.mesh.quality import corner_edge_lengths, mean_ratio, signed_areas


def test_the_short_diagonal_of_a_leaning_quad():
    points = np.array([[0.0, 0], [1, 0], [2, 1], [1, 1]])
    triangles, quad = split_quads(points, np.array([[0, 1, 2, 3]]))
    assert triangles.tolist() == [[0, 1, 3], [1, 2, 3]]
    assert quad.tolist() == [0, 0]


@pytest.mark.parametrize("corners", [[0, 1, 2, 2], [0, 0, 1, 2], [0, 1, 1, 2], [0, 1, 2, 0]])
def test_a_quad_that_names_a_corner_twice_is_one_triangle(corners):
    points = np.array([[0.0, 0], [1, 0], [0, 1]])
    triangles, _ = split_quads(points, np.array([corners]))
    assert [sorted(t) for t in triangles.tolist()] == [[0, 1, 2]]


@given(st.integers(0, 2**32 - 1), st.booleans(), st.booleans())
def test_area_is_kept_and_no_other_split_is_better(seed, is_clockwise, is_in_space):
    random = np.random.default_rng(seed)
    angle = np.sort(random.uniform(0, 2 * np.pi, 4))
    corners = random.uniform(0.2, 1, 4)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    quad = np.array([[3, 2, 1, 0]] if is_clockwise else [[0, 1, 2, 3]])
    x, y = corners.T
    area = 0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum()
    sign = np.sign(area) * (-1 if is_clockwise else 1)
    points = corners
    if is_in_space:
        turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
        points = np.column_stack([corners, np.zeros(4)]) @ turn
    triangles, _ = split_quads(points, quad)
    assert sign * signed_areas(corners, triangles).sum() == pytest.approx(abs(area))
    ways = [quad[0, [[0, 1, 2], [0, 2, 3]]], quad[0, [[0, 1, 3], [1, 2, 3]]]]
    worst = []
    for way in ways:
        signed = sign * signed_areas(corners, way)
        worst.append(float(mean_ratio(signed, corner_edge_lengths(corners, way)).min()))
    mine = sign * signed_areas(corners, triangles)
    q = float(mean_ratio(mine, corner_edge_lengths(corners, triangles)).min())
    assert q == pytest.approx(max(worst), abs=1e-12)


@given(st.integers(1, 8), st.integers(1, 8))
def test_a_grid_of_squares_becomes_a_mesh_of_twice_as_many(n_x, n_y):
    x, y = np.meshgrid(np.arange(n_x + 1.0), np.arange(n_y + 1.0))
    points = np.column_stack([x.ravel(), y.ravel()])
    first = (np.arange(n_y)[:, None] * (n_x + 1) + np.arange(n_x)).ravel()
    quads = np.column_stack([first, first + 1, first + n_x + 2, first + n_x + 1])
    mesh = clean(points, split_quads(points, quads)[0]).mesh
    assert mesh.n_triangles == 2 * n_x * n_y
    assert mesh.area == pytest.approx(n_x * n_y)
    assert mesh.topology.n_boundary_loops == 1
    assert np.allclose(quad_angles(points, quads), np.pi / 2)
