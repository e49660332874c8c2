"""Size fields: calibrated, refused where invalid, and covariant under motions and scaling."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import disc, jittered, meshes, permuted

from bsgplan.errors import InvalidSize
from bsgplan.mesh import Mesh
from bsgplan.sizing import SizeField, named_size_field, size_field

MESH = jittered(12, 9, 31547)


def moved(mesh: Mesh, scale: float, angle: float, shift: tuple[float, float]) -> Mesh:
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return Mesh(scale * (mesh.points @ turn.T + np.asarray(shift)), mesh.triangles)


@given(meshes())
def test_a_field_read_off_a_mesh_expects_its_triangles(mesh: Mesh) -> None:
    assert size_field(mesh).expected_triangles == pytest.approx(mesh.n_triangles, rel=1e-9)


def test_one_equilateral_triangle_has_its_own_edge() -> None:
    mesh = Mesh(np.array([[0.0, 0], [3, 0], [1.5, 1.5 * np.sqrt(3)]]), np.array([[0, 1, 2]]))
    assert size_field(mesh).h == pytest.approx([3.0, 3.0, 3.0], rel=1e-4)


def test_a_regular_lattice_has_its_edge_everywhere() -> None:
    x, y = (v.ravel().astype(float) for v in np.meshgrid(np.arange(7), np.arange(6)))
    points = np.column_stack([x + y / 2, y * np.sqrt(3) / 2])
    corner = (np.arange(6)[None, :] + 7 * np.arange(5)[:, None]).ravel()
    lower = np.column_stack([corner, corner + 1, corner + 7])
    upper = np.column_stack([corner + 1, corner + 8, corner + 7])
    field = size_field(Mesh(points, np.vstack([lower, upper])))
    assert field.h == pytest.approx(np.ones(len(points)), rel=1e-6)
    assert field.triangle_weights == pytest.approx(np.ones(60), rel=1e-6)


@settings(max_examples=25)
@given(st.floats(-2, 6), st.floats(0, 6.2), st.floats(-90, 90), st.floats(-90, 90))
def test_moving_and_scaling_the_points_scales_sizes_and_nothing_else(
    magnitude: float, angle: float, dx: float, dy: float
) -> None:
    scale = 10.0**magnitude
    mesh = moved(MESH, scale, angle, (dx, dy))
    assert size_field(mesh).h == pytest.approx(scale * size_field(MESH).h, rel=1e-6)
    values = 1.0 + np.arange(mesh.n_points) / 200
    scaled, plain = named_size_field(mesh, scale * values, "a"), named_size_field(MESH, values, "a")
    assert scaled.h == pytest.approx(scale * plain.h, rel=1e-6)
    assert scaled.expected_triangles == pytest.approx(plain.expected_triangles, rel=1e-6)


@pytest.mark.parametrize("seed", [6101, 52711, 777013])
def test_the_order_of_points_and_triangles_does_not_matter(seed: int) -> None:
    other, points, _ = permuted(MESH, seed)
    assert size_field(other).h == pytest.approx(size_field(MESH).h[points], rel=1e-6)


def test_a_surface_in_space_has_the_sizes_of_its_flat_original() -> None:
    """A rectangle bent over a cylinder of large radius: lengths within a thousandth."""
    radius = 40.0
    x, y = MESH.points.T
    bent = np.column_stack([radius * np.sin(x / radius), y, radius * np.cos(x / radius)])
    assert size_field(Mesh(bent, MESH.triangles)).h == pytest.approx(size_field(MESH).h, rel=1e-3)


@pytest.mark.parametrize(
    ("value", "where"), [(0.0, "is 0"), (np.nan, "is nan"), (-2.0, "is -2"), (np.inf, "is inf")]
)
@pytest.mark.parametrize("n", [MESH.n_points, MESH.n_triangles])
def test_a_size_that_is_no_edge_length_is_refused_and_named(value: float, where: str, n: int) -> None:
    values = np.ones(n)
    values[[7, 9]] = value
    with pytest.raises(InvalidSize, match=rf"size 'depth' {where} at index 7 \(2 such values\)"):
        named_size_field(MESH, values, "depth")


@pytest.mark.parametrize("shape", [(3,), (MESH.n_points, 2), (0,), (), (MESH.n_points + 1,)])
def test_an_array_that_is_no_scalar_a_point_or_triangle_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(InvalidSize, match="give a scalar a point"):
        named_size_field(MESH, np.ones(shape), "velocity")


def test_the_noun_refuses_what_is_no_size() -> None:
    for bad in (np.ones(3), np.zeros(MESH.n_points), np.full(MESH.n_points, np.nan)):
        with pytest.raises(InvalidSize):
            SizeField(MESH, bad)


def test_cell_values_that_are_linear_in_log_size_are_read_back_inside() -> None:
    mesh = disc(20)
    log_h = 0.3 * mesh.points[:, 0] - 0.2 * mesh.points[:, 1]
    field = named_size_field(mesh, np.exp(log_h[mesh.triangles].mean(axis=1)), "cells")
    inside = np.hypot(*mesh.points.T) < 0.85
    assert field.log_h[inside] == pytest.approx(log_h[inside], abs=3e-3)
    assert field.source == "cells"


def test_a_named_field_is_taken_at_its_word() -> None:
    """Half the size asks for four times the triangles: nothing is calibrated."""
    ones = named_size_field(MESH, np.ones(MESH.n_points), "a").expected_triangles
    assert named_size_field(MESH, np.full(MESH.n_points, 0.5), "a").expected_triangles == pytest.approx(
        4 * ones
    )


@pytest.mark.parametrize(
    ("path", "least", "most"),
    [("meshes/mesh_NACA0012_inv.su2", 5e3, 2e4), ("meshes/notched_plate_phasefield.msh", 15, 60)],
)
def test_real_meshes_keep_their_range_of_sizes(shared, path: str, least: float, most: float) -> None:
    from bsgplan.io import read

    h = size_field(read(shared / path).mesh).h
    assert least < h.max() / h.min() < most
