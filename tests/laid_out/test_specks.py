"""Components too small for a block are left out, and said to be."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
import pytest

from bsgplan.io import read_lonlat
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


def test_degrees_of_a_projected_file_follow_its_points(tmp_path: Path) -> None:
    """Without specks the degrees kept the rows of the whole file: more than there were points."""
    path = tmp_path / "coast.14"
    square = [(i, j) for j in range(5) for i in range(5)]
    cells = [(5 * j + i, 5 * j + i + 1, 5 * j + i + 6, 5 * j + i + 5) for j in range(4) for i in range(4)]
    triangles = [(25, 26, 27), *(t for a, b, c, d in cells for t in ((a, b, c), (a, c, d)))]
    points = [(10 + x / 10, 20 + y / 10) for x, y in square] + [(12, 20), (12.1, 20), (12, 20.1)]
    rows = [f"{k + 1} {x} {y} 1" for k, (x, y) in enumerate(points)]
    rows += [f"{k + 1} 3 {a + 1} {b + 1} {c + 1}" for k, (a, b, c) in enumerate(triangles)]
    path.write_text(f"coast\n{len(triangles)} {len(points)}\n" + "\n".join(rows) + "\n0\n0\n0\n0\n")
    mesh_file = read_lonlat(path)
    cut, _ = without_specks(mesh_file, size_field(mesh_file.mesh), side=2)
    assert cut.mesh.n_triangles == 32
    assert cut.degrees.shape == cut.mesh.points.shape
    assert cut.file_points[-1].tolist() == [10.4, 20.4]
    assert cut.kept_points.tolist() == list(range(25))
