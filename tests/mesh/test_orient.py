"""Orientation: of the plane by area, of surfaces by propagation over each component."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import meshes

import bsgplan
from bsgplan.errors import InvalidMesh
from bsgplan.mesh import clean
from bsgplan.mesh.orient import turned_in_plane, turned_in_space
from bsgplan.mesh.topology import topology

TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


def strip(n: int, *, is_twisted: bool) -> tuple[np.ndarray, np.ndarray]:
    """A band of 2 n triangles closed on itself, or a Moebius strip, as points in space and triangles."""
    angle = 2 * np.pi * np.arange(n) / n
    lean = angle / 2 if is_twisted else np.full(n, np.pi / 2)
    away = np.concatenate([np.full(n, -0.2), np.full(n, 0.2)])
    angle, lean = np.tile(angle, 2), np.tile(lean, 2)
    radius = 1 + away * np.cos(lean)
    points = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), away * np.sin(lean)])
    low, high = np.arange(n), np.arange(n, 2 * n)
    next_low, next_high = np.roll(low, -1), np.roll(high, -1)
    if is_twisted:
        next_low[-1], next_high[-1] = n, 0
    return points, np.concatenate(
        [np.column_stack([low, next_low, high]), np.column_stack([high, next_low, next_high])]
    )


def test_one_triangle_of_a_tetrahedron_is_turned_back():
    for k in range(4):
        triangles = TETRAHEDRON.copy()
        triangles[k] = triangles[k, ::-1]
        assert turned_in_space(triangles, 4).tolist() == [i == k for i in range(4)]


@given(st.data())
def test_surfaces_come_out_all_one_way_and_whole_components_stay(data):
    mesh = data.draw(meshes())
    random = np.random.default_rng(data.draw(st.integers(0, 2**32 - 1)))
    is_turned = random.random(mesh.n_triangles) < data.draw(st.sampled_from([0.0, 0.1, 0.3]))
    mixed = np.where(is_turned[:, None], mesh.triangles[:, ::-1], mesh.triangles)
    found = turned_in_space(mixed, mesh.n_points)
    now_turned = is_turned ^ found
    for piece in range(mesh.topology.n_components):
        inside = mesh.topology.component == piece
        assert len(set(now_turned[inside].tolist())) == 1
        assert 2 * np.count_nonzero(found[inside]) <= np.count_nonzero(inside)
    assert not topology(np.where(found[:, None], mixed[:, ::-1], mixed), mesh.n_points).runs_alike.any()
    assert np.array_equal(turned_in_plane(mesh.points, mixed), is_turned)


def test_a_moebius_strip_is_refused_and_a_band_is_not():
    assert clean(*strip(20, is_twisted=False)).mesh.topology.n_boundary_loops == 2
    points, triangles = strip(20, is_twisted=True)
    with pytest.raises(InvalidMesh, match="one side only"):
        clean(points, triangles)
    assert clean(points, triangles[1:]).n_flipped == 0  # cut open


def test_a_fold_shows_where_both_triangles_lie_on_one_side():
    points = np.array([[0.0, 0], [1, 0], [0, 1], [0.2, 0.9]])
    mesh = clean(points, np.array([[0, 1, 2], [0, 1, 3]])).mesh
    assert np.count_nonzero(mesh.topology.runs_alike) == 1


def test_the_bunny_is_turned_back_to_what_it_was(shared):
    mesh = bsgplan.read(shared / "meshes/bunny_adaptive.off").mesh
    random = np.random.default_rng(20240611)
    is_turned = random.random(mesh.n_triangles) < 0.4
    mixed = np.where(is_turned[:, None], mesh.triangles[:, ::-1], mesh.triangles)
    cleaned = clean(mesh.points, mixed)
    assert cleaned.n_flipped == np.count_nonzero(is_turned)
    assert not cleaned.mesh.topology.runs_alike.any()
