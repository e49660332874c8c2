"""A thinned mesh covers the same domain; what each triangle of it stands for is connected."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from bsgplan.mesh import Mesh, clean
from bsgplan.mesh.collapse import LEAST_QUALITY, LONGEST
from bsgplan.mesh.components import connected_labels
from bsgplan.mesh.thinned import Thinned, thinned
from tests.predicates import assert_identity_holds, assert_is_mesh
from tests.strategies import jittered, meshes


def assert_is_thinning(thin: Thinned) -> None:
    whole, mesh = thin.whole, thin.mesh
    assert_is_mesh(mesh)
    assert_identity_holds(mesh)
    assert np.array_equal(mesh.points, whole.points[thin.kept])
    assert np.array_equal(thin.point[thin.kept], np.arange(mesh.n_points))
    assert mesh.area == pytest.approx(whole.area, rel=1e-12)
    assert boundary_of(mesh, thin.kept) == boundary_of(whole, np.arange(whole.n_points))
    for name in ("n_components", "n_boundary_loops", "n_pinches", "euler_characteristic"):
        assert getattr(mesh.topology, name) == getattr(whole.topology, name)
    assert set(thin.triangle.tolist()) == set(range(mesh.n_triangles))
    assert_are_connected(whole, thin.triangle)


def boundary_of(mesh: Mesh, names: np.ndarray) -> set[tuple[int, int]]:
    return {(int(names[a]), int(names[b])) for a, b in mesh.topology.outline}


def assert_are_connected(mesh: Mesh, label: np.ndarray) -> None:
    pairs = mesh.topology.neighbours
    inside = pairs[label[pairs[:, 0]] == label[pairs[:, 1]]]
    assert connected_labels(inside, mesh.n_triangles).max() == label.max()


@given(meshes(14))
@settings(max_examples=150)
def test_any_mesh_is_thinned_to_one_of_the_same_domain(mesh: Mesh) -> None:
    assert_is_thinning(thinned(mesh))


def test_a_fifth_of_a_regular_mesh_is_left_and_its_triangles_are_good() -> None:
    mesh = jittered(80, 80, 4)
    thin = thinned(mesh)
    assert_is_thinning(thin)
    assert 3.5 < mesh.n_triangles / thin.mesh.n_triangles < 7
    is_new = thin.mesh.edge_lengths > mesh.edge_lengths.max()
    assert thin.mesh.edge_lengths.max() <= LONGEST * mesh.edge_lengths.max()
    assert is_new.mean() > 0.5
    assert thin.mesh.qualities.min() >= min(LEAST_QUALITY, mesh.qualities.min())


def test_a_size_step_keeps_its_fine_triangles() -> None:
    """New edges are measured by the finer end: coarse triangles beside fine ones swallow none of them."""
    fine, coarse = np.arange(0, 10, 0.25), np.arange(10, 31, 1.0)
    x, y = (v.ravel() for v in np.meshgrid(np.concatenate([fine, coarse]), np.arange(0, 20, 0.25)))
    is_coarse = (x >= 10) & (y % 1 != 0)
    points = np.column_stack([x, y])[~is_coarse]
    mesh = clean(
        points + np.random.default_rng(2).uniform(-0.01, 0.01, points.shape), Delaunay(points).simplices
    )
    thin = thinned(mesh.mesh)
    inner = thin.mesh.edge_lengths[(thin.mesh.points[thin.mesh.topology.edges, 0] < 9).all(axis=1)]
    assert inner.max() < LONGEST * 0.5


def test_a_fold_and_what_lies_over_it_stay() -> None:
    """A mesh that runs back over itself: two sheets glued along one side, both counter-clockwise."""
    sheet = jittered(9, 9, 3)
    n = sheet.n_points
    mirrored = sheet.points * [-1, 1] + [16, 0]  # the right side, x = 8, stays in place
    other = np.arange(n) + n
    on_side = np.flatnonzero(sheet.points[:, 0] == 8)
    other[on_side] = on_side
    folded_back = np.vstack([sheet.points, mirrored * [-1, 1] + [16, 0]])
    triangles = np.vstack([sheet.triangles, other[sheet.triangles]])
    mesh = clean(folded_back, triangles).mesh
    assert mesh.topology.runs_alike.any()
    thin = thinned(mesh)
    assert mesh.topology.runs_alike.sum() == thin.mesh.topology.runs_alike.sum()
    assert thin.mesh.area == pytest.approx(mesh.area)
    assert thin.mesh.n_triangles < mesh.n_triangles


def test_a_second_thinning_goes_on_from_the_first() -> None:
    mesh = jittered(60, 60, 9)
    once = thinned(mesh).mesh
    assert once.n_triangles > thinned(once).mesh.n_triangles


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=10)
def test_numbering_changes_which_points_stay_but_not_how_many(seed: int) -> None:
    mesh = jittered(40, 40, 1)
    order = np.random.default_rng(seed).permutation(mesh.n_points)
    points = np.empty_like(mesh.points)
    points[order] = mesh.points
    again = thinned(Mesh(points, order[mesh.triangles]))
    assert again.mesh.n_triangles == pytest.approx(thinned(mesh).mesh.n_triangles, rel=0.25)


@given(st.integers(0, 2**32 - 1), st.integers(1, 3))
@settings(max_examples=60)
def test_any_pile_of_sheets_glued_at_points_and_sides_is_thinned(seed: int, n_glued: int) -> None:
    """Sheets over one another that share some boundary points or all of one side: pinches and folds."""
    random = np.random.default_rng(seed)
    sheet = jittered(9, 9, 3)
    n = sheet.n_points
    side = np.flatnonzero(sheet.points[:, 0] == 8)
    glued = side if n_glued == 3 else random.choice(np.unique(sheet.topology.outline), n_glued, replace=False)
    other = np.arange(n) + n
    other[glued] = glued
    mesh = clean(
        np.vstack([sheet.points, sheet.points]), np.vstack([sheet.triangles, other[sheet.triangles]])
    ).mesh
    thin = thinned(mesh)
    assert_is_mesh(thin.mesh)
    assert thin.mesh.area == pytest.approx(mesh.area)
    assert thin.mesh.topology.n_pinches == mesh.topology.n_pinches
    assert_are_connected(mesh, thin.triangle)
