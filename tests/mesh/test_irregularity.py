"""Irregularity of the squares of the paper's Figure 1, and of boundaries fitted to their angles."""

from __future__ import annotations

import numpy as np
import pytest

from bsgplan.mesh import Mesh
from bsgplan.mesh.irregularity import Irregularity, fitted_boundary_irregularity
from bsgplan.mesh.quality import angles


def square(turned: tuple[int, ...] = ()) -> Mesh:
    """A square of 2 x 2 cells, each cut from lower left to upper right, or the other way where turned.

    6---7---8
    | / | / |
    3---4---5
    | / | / |
    0---1---2
    """
    x, y = np.meshgrid(np.arange(3.0), np.arange(3.0))
    triangles = []
    for cell, a in enumerate((0, 1, 3, 4)):
        b, c, d = a + 1, a + 4, a + 3
        triangles += [[a, b, d], [b, c, d]] if cell in turned else [[a, b, c], [a, c, d]]
    return Mesh(np.column_stack([x.ravel(), y.ravel()]), triangles)


def test_a_square_of_one_cell():
    """Figure 1: two triangles, iota_m = -6."""
    mesh = Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    assert mesh.vertex_irregularity.tolist() == [-1, -2, -1, -2]
    assert mesh.irregularity == Irregularity(0, -6)


def test_a_regular_square():
    """Figure 1: +0 / -6, no irregular vertex inside."""
    mesh = square()
    assert mesh.vertex_irregularity[4] == 0
    assert mesh.irregularity == Irregularity(0, -6)


def test_a_square_with_an_irregular_vertex():
    """Figure 1: +1 / -7, and -6 in total all the same."""
    mesh = square(turned=(1,))
    assert mesh.vertex_irregularity[4] == 1
    assert mesh.irregularity == Irregularity(1, -7)
    assert mesh.irregularity.total == -6


@pytest.mark.parametrize(("n", "expected"), [(6, 0), (3, 0), (5, 0), (7, 0)])
def test_a_fan_of_fitting_triangles_is_regular_on_its_boundary(n, expected):
    """A wheel's rim has two triangles at about 120 degrees: it fits, whatever its valence."""
    angle = 2 * np.pi * np.arange(n) / n
    points = np.vstack([[0.0, 0.0], np.column_stack([np.cos(angle), np.sin(angle)])])
    i = np.arange(n)
    mesh = Mesh(points, np.column_stack([np.zeros(n, int), 1 + i, 1 + (i + 1) % n]))
    fitted = fitted_boundary_irregularity(mesh.topology, angles(mesh.corner_edge_lengths))
    if n == 3:  # 60 degrees ask for one triangle, there are two
        assert fitted.tolist() == [0, 1, 1, 1]
    else:
        assert np.count_nonzero(fitted) == expected


@pytest.mark.parametrize("shift", [-1e-9, 0.0, 1e-9])
def test_a_right_angle_fits_one_triangle_and_two(shift):
    """90 degrees lie halfway between one and two; rounding of the coordinates has no say."""
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0 + shift, 1.0 - shift], [0.0, 1.0]])
    mesh = Mesh(points, np.array([[0, 1, 2], [0, 2, 3]]))
    assert mesh.topology.n_cells_at.tolist() == [2, 1, 2, 1]
    assert not fitted_boundary_irregularity(mesh.topology, angles(mesh.corner_edge_lengths)).any()


def test_an_angle_past_the_middle_fits_one_number_only():
    """100 degrees want two triangles."""
    tip = np.array([np.cos(np.radians(100)), np.sin(np.radians(100))])
    mesh = Mesh(np.array([[0.0, 0.0], [1.0, 0.0], tip]), np.array([[0, 1, 2]]))
    fitted = fitted_boundary_irregularity(mesh.topology, angles(mesh.corner_edge_lengths))
    assert fitted.tolist() == [-1, 0, 0]
