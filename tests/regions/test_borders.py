"""Straight borders: two moments tell the other label as indicators of all labels do; settled ones stay."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import jittered

from bsgplan.arrays import Floats, Ints
from bsgplan.mesh import Mesh
from bsgplan.regions.borders import AVERAGES, _Patch, _strongest, corner_shares, smooth_borders


def shares_of_labels(mesh: Mesh, label: Ints) -> Floats:
    """The share of each label around each triangle, (n_triangles, n_labels): dense, walk by walk."""
    to_vertices = np.zeros((mesh.n_points, mesh.n_triangles))
    to_triangles = np.zeros((mesh.n_triangles, mesh.n_points))
    weights = corner_shares(mesh)
    for t, corners in enumerate(mesh.triangles):
        for k, corner in enumerate(corners):
            to_vertices[corner, t] += weights[t, k]
            to_triangles[t, corner] += 1.0
    share = np.eye(int(label.max()) + 1)[label]
    for _ in range(AVERAGES):
        share = to_triangles @ (to_vertices @ share)
    return share


@given(st.integers(0, 2**32 - 1), st.integers(1, 6), st.floats(0.3, 5.0))
@settings(max_examples=30, deadline=None)
def test_the_strongest_label_is_that_of_the_slow_twin(seed: int, n_labels: int, width: float) -> None:
    mesh = jittered(9, 8, seed)
    random = np.random.default_rng(seed)
    seats = random.uniform([0, 0], [8, 7], (n_labels, 2))
    noise = random.normal(0.0, width, (mesh.n_triangles, n_labels))
    away = np.linalg.norm(mesh.centroids[:, None] - seats, axis=2)
    label = np.argmin(away + noise, axis=1)
    share = shares_of_labels(mesh, label)
    shares = corner_shares(mesh)
    patch = _Patch.around(mesh, np.arange(mesh.n_triangles), 0, shares, AVERAGES)
    found = _strongest(mesh, label, patch, shares)
    best = share.max(axis=1)
    assert share[np.arange(len(found)), found] == pytest.approx(best, abs=1e-8)
    is_tie = (share > best[:, None] - 1e-12).sum(axis=1) > 1
    assert np.array_equal(found[~is_tie], share.argmax(axis=1)[~is_tie])


def test_shares_around_each_triangle_add_up_to_one() -> None:
    mesh = jittered(7, 6, 3)
    label = np.arange(mesh.n_triangles) % 3
    assert shares_of_labels(mesh, label).sum(axis=1) == pytest.approx(1.0)


def test_a_saw_becomes_straight_and_stays_so() -> None:
    """A border of teeth is cut to within an edge of its mean line; a second turn changes nothing."""
    mesh = jittered(30, 20, 5, jitter=0.15)
    x, y = mesh.centroids.T
    label = (x > 14 + 2 * ((y % 3) > 1.5)).astype(np.int64)
    shares = corner_shares(mesh)
    once = smooth_borders(mesh, label, shares, rounds=30)
    assert np.all(once[x < 13.5] == 0)
    assert np.all(once[x > 16.5] == 1)
    assert np.array_equal(smooth_borders(mesh, once, shares, rounds=30), once)


def test_borders_that_have_settled_are_left_alone() -> None:
    """Two saws; the one that was there before is settled: only the new one is straightened."""
    mesh = jittered(40, 12, 8, jitter=0.15)
    x, y = mesh.centroids.T
    tooth = 2 * ((y % 3) > 1.5)
    before = (x > 10 + tooth).astype(np.int64)
    now = before + (x > 28 + tooth)
    result, only_teeth = (
        smooth_borders(mesh, now, corner_shares(mesh), rounds=30, settled=settled)
        for settled in (before, now)
    )
    left = x < 20
    assert np.array_equal(result[left], only_teeth[left])
    assert not np.array_equal(result[~left], only_teeth[~left])
