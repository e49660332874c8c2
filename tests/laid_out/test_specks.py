"""Components too small for a block are left out, and said to be."""

from __future__ import annotations

import logging

import numpy as np
import pytest

from bsgplan.io.file import RawMesh, assemble
from bsgplan.laid_out.specks import without_specks
from bsgplan.sizing import size_field


def test_a_lone_triangle_off_a_square_is_left_out(caplog: pytest.LogCaptureFixture) -> None:
    i, j = (v.ravel() for v in np.meshgrid(np.arange(8), np.arange(8)))
    at = (9 * j + i)[:, None]
    square = (at[:, None] + np.array([[0, 1, 10], [0, 10, 9]])).reshape(-1, 3)
    points = np.column_stack([np.tile(np.arange(9.0), 9), np.repeat(np.arange(9.0), 9)])
    speck = np.array([[20.0, 0.0], [21.0, 0.0], [20.0, 1.0]])
    raw = RawMesh(
        points=np.concatenate([speck, points]),
        triangles=np.concatenate([[[0, 1, 2]], square + 3]),
        quads=np.empty((0, 4), dtype=np.int64),
        point_data={"depth": np.arange(84.0)},
    )
    mesh_file = assemble("coast.14", "fort.14", raw)
    with caplog.at_level(logging.WARNING, logger="bsgplan"):
        cut, size = without_specks(mesh_file, size_field(mesh_file.mesh), side=4)
    assert cut.mesh.n_triangles == 128
    assert cut.point_data["depth"].tolist() == list(range(3, 84))
    assert len(size.h) == 81
    assert "1 components of less than one block left out, 1 triangles" in caplog.text


def test_nothing_is_left_out_of_a_mesh_without_specks() -> None:
    points = np.array([[0.0, 0], [1, 0], [0, 1]])
    mesh_file = assemble("one.off", "off", RawMesh(points, np.array([[0, 1, 2]]), np.empty((0, 4), int)))
    assert without_specks(mesh_file, size_field(mesh_file.mesh), side=4)[0] is mesh_file
