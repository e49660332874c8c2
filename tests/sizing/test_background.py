"""Backgrounds: what is linear in the logarithm comes back exactly, what is not covered is told."""

from __future__ import annotations

import numpy as np
import pytest
import reference
from hypothesis import given
from hypothesis import strategies as st
from strategies import jittered, meshes

import bsgplan
from bsgplan.errors import InvalidSize
from bsgplan.sizing.background import ROUNDING, Background, locate
from bsgplan.sizing.grid import GridBackground, around_the_globe


def exponential(points: np.ndarray) -> np.ndarray:
    """A size whose logarithm is linear in space."""
    return np.exp(0.3 * points[..., 0] - 0.2 * points[..., 1])


@given(meshes(), st.integers(0, 2**32 - 1))
def test_every_point_is_found_in_a_triangle_that_holds_it(mesh, seed):
    random = np.random.default_rng(seed)
    weights = random.dirichlet([1, 1, 1], mesh.n_triangles)
    inside = np.einsum("tc,tci->ti", weights, mesh.points[mesh.triangles])
    points = np.concatenate([mesh.points, inside])
    corners = mesh.points[mesh.triangles]
    found = Background(corners, exponential(corners)).at(points)
    assert np.allclose(found, exponential(points), rtol=1e-9)


@given(meshes(), st.integers(0, 2**32 - 1))
def test_covered_is_what_the_slow_twin_says(mesh, seed):
    points = np.random.default_rng(seed).uniform(-1, 9, (20, 2))
    corners = mesh.points[mesh.triangles]
    _, weights, is_covered = locate(corners, points)
    expected = [any(reference.holds(triangle, point) for triangle in corners) for point in points]
    assert is_covered.tolist() == expected
    assert np.allclose(weights[is_covered].sum(axis=1), 1)


def test_what_is_not_covered_is_counted_and_placed():
    corners = np.array([[[0.0, 0], [2, 0], [0, 2]]])
    background = Background(corners, np.ones((1, 3)))
    with pytest.raises(
        InvalidSize, match=r"no size at 2 of 3 points, the first at \(3, 0\), all within 3 .. 3"
    ):
        background.at(np.array([[0.5, 0.5], [3, 0], [3, 1]]))


@pytest.mark.parametrize(("beyond", "is_covered"), [(0.5 * ROUNDING, True), (5 * ROUNDING, False)])
def test_a_boundary_may_be_rounded_and_no_more(beyond, is_covered):
    corners = np.array([[[0.0, 0], [1, 0], [0, 1]]])
    assert locate(corners, np.array([[0.5, -beyond]]))[2].tolist() == [is_covered]


@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf])
def test_a_size_that_is_no_length_is_told_only_where_it_is_used(value):
    background = Background(np.array([[[0.0, 0], [1, 0], [0, 1]]]), np.array([[1.0, 1.0, value]]))
    assert background.at(np.array([[0.5, 0.0]])).tolist() == [1.0]
    with pytest.raises(InvalidSize, match=r"the size at \(0.2, 0.5\) is no length \(1 such"):
        background.at(np.array([[0.2, 0.5]]))


def test_a_mesh_reads_its_own_sizes_back_also_in_space():
    mesh = jittered(12, 9, 1711)
    turn = np.linalg.qr(np.random.default_rng(1712).normal(size=(3, 3)))[0]
    for lift in (np.eye(2, 3), turn[:2]):
        corners = (mesh.points @ lift)[mesh.triangles]
        h = exponential(mesh.points)
        assert np.allclose(Background(corners, h[mesh.triangles]).at(mesh.points @ lift), h)


def test_a_background_in_the_plane_has_nothing_for_a_surface():
    with pytest.raises(InvalidSize, match="in space"):
        Background(np.zeros((1, 3, 2)), np.ones((1, 3))).at(np.zeros((1, 3)))


def test_the_bunny_reads_sizes_off_another_triangulation_of_itself(shared):
    mesh = bsgplan.read(shared / "meshes/bunny_adaptive.off").mesh
    h = bsgplan.size_field(mesh).h
    corners, sizes = mesh.points[mesh.triangles], h[mesh.triangles]
    fine = mesh.points[mesh.topology.edges].mean(axis=1) + 1e-3 * h.min()
    found = Background(corners, sizes).at(fine)
    expected = np.sqrt(h[mesh.topology.edges].prod(axis=1))
    assert np.allclose(found, expected, rtol=0.01)
    with pytest.raises(InvalidSize, match="no size at"):
        Background(corners, sizes).at(mesh.points * 1.1)


@given(st.integers(2, 6), st.integers(2, 6), st.integers(0, 2**32 - 1), st.booleans())
def test_a_grid_gives_back_what_is_linear_in_the_logarithm(n_x, n_y, seed, is_descending):
    random = np.random.default_rng(seed)
    x, y = np.cumsum(random.uniform(0.1, 1, n_x)), np.cumsum(random.uniform(0.1, 1, n_y))
    points = np.column_stack([random.uniform(x[0], x[-1], 30), random.uniform(y[0], y[-1], 30)])
    if is_descending:
        y = y[::-1]
    grid = GridBackground(x, y, exponential(np.stack(np.meshgrid(x, y), axis=-1)))
    assert np.allclose(grid.at(points), exponential(points), rtol=1e-9)
    with pytest.raises(InvalidSize, match="no size at 1 of 1"):
        grid.at(np.array([[x[-1] + 1, y[0]]]))


@pytest.mark.parametrize(("x", "shape"), [([0.0, 0.0], (2, 2)), ([0.0, 2, 1], (2, 3)), ([0.0, 1], (3, 2))])
def test_a_grid_that_is_none_is_refused(x, shape):
    with pytest.raises(InvalidSize):
        GridBackground(np.array(x), np.array([0.0, 1]), np.ones(shape))


def test_a_grid_around_the_globe_closes_and_a_part_of_it_does_not():
    whole = GridBackground(np.arange(0.0, 360, 90), np.array([0.0, 1]), np.array([[1.0, 2, 3, 4]] * 2))
    assert around_the_globe(whole).x.tolist() == [0, 90, 180, 270, 360]
    assert around_the_globe(whole).sizes[0].tolist() == [1, 2, 3, 4, 1]
    part = GridBackground(np.arange(0.0, 270, 90), np.array([0.0, 1]), np.ones((2, 3)))
    assert around_the_globe(part) is part
