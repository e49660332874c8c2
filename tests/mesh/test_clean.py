"""Clean-up: what it turns, drops and flattens, and what it refuses."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from predicates import assert_is_mesh
from strategies import meshes, rewritings

from bsgplan.errors import InvalidMesh
from bsgplan.mesh import Mesh, clean

SQUARE = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])


def test_clockwise_triangles_are_turned_and_counted():
    cleaned = clean(SQUARE, np.array([[0, 1, 2], [0, 3, 2]]))
    assert cleaned.n_flipped == 1
    assert_is_mesh(cleaned.mesh)


def test_constant_z_is_dropped_and_unused_points_too():
    points = np.column_stack([np.vstack([[[9.0, 9]], SQUARE]), np.full(5, 4.5)])
    cleaned = clean(points, np.array([[1, 2, 3], [1, 3, 4]]))
    assert cleaned.is_flattened
    assert cleaned.n_unused == 1
    assert cleaned.kept_points.tolist() == [1, 2, 3, 4]
    assert cleaned.mesh.is_planar


def test_a_surface_keeps_its_orientation():
    points = np.column_stack([SQUARE, [0.0, 0, 1, 0]])
    triangles = np.array([[0, 2, 1], [0, 3, 2]])
    cleaned = clean(points, triangles)
    assert cleaned.n_flipped == 0
    assert cleaned.mesh.triangles.tolist() == triangles.tolist()


@pytest.mark.parametrize(
    ("points", "triangles", "message"),
    [
        (SQUARE, [[0, 1, 4]], "index outside 0 .. 3"),
        (SQUARE, [[0, 1, -1]], "index outside"),
        (SQUARE, [[0, 1, 1], [0, 1, 2]], "triangle 0 .*zero area"),
        ([[0, 0], [1, 0], [2, 0]], [[0, 1, 2]], "zero area"),
        ([[0, 0], [1, 0], [np.nan, 1]], [[0, 1, 2]], "not finite"),
        (SQUARE, np.empty((0, 3), dtype=int), "no triangles"),
        (SQUARE[:, :1], [[0, 1, 2]], "shape"),
    ],
)
def test_what_is_no_mesh_is_refused_by_name(points, triangles, message):
    with pytest.raises(InvalidMesh, match=message):
        clean(np.asarray(points, dtype=float), np.asarray(triangles))


def test_the_noun_refuses_what_clean_would_mend():
    with pytest.raises(InvalidMesh, match="orient them"):
        Mesh(SQUARE, [[0, 2, 1], [0, 2, 3]])
    with pytest.raises(InvalidMesh, match="drop them"):
        Mesh(SQUARE, [[0, 1, 2]])


@given(st.data())
def test_kept_points_lead_back_to_the_raw_ones(data):
    points, triangles = data.draw(rewritings(data.draw(meshes())))
    cleaned = clean(points, triangles)
    assert_is_mesh(cleaned.mesh)
    assert np.array_equal(points[cleaned.kept_points], cleaned.mesh.points)
    assert cleaned.n_unused == len(points) - cleaned.mesh.n_points
