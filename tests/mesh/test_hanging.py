"""Hanging nodes: those of refined grids, whatever the refinement, and none where a mesh conforms."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import meshes as random_meshes

from bsgplan.cli import main
from bsgplan.io import read
from bsgplan.mesh import clean
from bsgplan.mesh.hanging import hanging_points
from bsgplan.mesh.mesh import Mesh
from bsgplan.mesh.quads import split_quads


def adaptive(n: int, parts: np.ndarray, turn: float) -> Mesh:
    """Return an n x n grid of squares, square k cut into parts[k]**2, quads split, all turned by an angle."""
    corners = []
    for k, m in enumerate(parts):
        step = np.arange(m * m)
        low = np.column_stack([k % n + step % m / m, k // n + step // m / m])
        corners.append(low[:, None] + np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) / m)
    points, index = np.unique(np.concatenate(corners).reshape(-1, 2).round(12), axis=0, return_inverse=True)
    triangles, _ = split_quads(points, index.reshape(-1, 4))
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    return clean(points @ rotation.T, triangles).mesh


def slow_hanging(mesh: Mesh) -> list[int]:
    """Every point of the boundary against every edge of it."""
    ends = mesh.points[mesh.topology.edges[mesh.topology.is_boundary_edge]]
    found = []
    for point in np.flatnonzero(mesh.topology.is_boundary):
        a, b = mesh.points[point] - ends[:, 0], ends[:, 1] - ends[:, 0]
        along = (a * b).sum(axis=1) / (b * b).sum(axis=1)
        off = np.linalg.norm(a - along[:, None] * b, axis=1)
        if ((along > 1e-9) & (along < 1 - 1e-9) & (off < 1e-9)).any():
            found.append(int(point))
    return found


@given(n=st.integers(1, 4), data=st.data(), turn=st.floats(0, 6))
def test_halved_squares_hang_where_every_point_against_every_edge_says(n, data, turn):
    parts = np.array(data.draw(st.lists(st.sampled_from([1, 2]), min_size=n * n, max_size=n * n)))
    mesh = adaptive(n, parts, turn)
    assert hanging_points(mesh.points, mesh.topology).tolist() == slow_hanging(mesh)


@given(coarse=st.integers(1, 3), times=st.integers(2, 6))
def test_of_many_on_one_edge_those_beside_its_ends_are_named(coarse, times):
    mesh = adaptive(2, np.array([coarse, coarse * times] * 2), 0.3)
    found, all_of_them = hanging_points(mesh.points, mesh.topology), slow_hanging(mesh)
    assert set(found.tolist()) <= set(all_of_them)
    assert len(all_of_them) == 2 * coarse * (times - 1)
    assert len(found) == 2 * coarse * min(2, times - 1)


@given(mesh=random_meshes())
def test_a_mesh_that_conforms_has_none(mesh):
    assert hanging_points(mesh.points, mesh.topology).tolist() == slow_hanging(mesh) == []


@pytest.mark.parametrize("name", ["mesh_RAE2822_turb.su2", "wnat_test_18578.fort.14", "bunny_adaptive.off"])
def test_real_meshes_that_conform_have_none(meshes, name):
    mesh = read(meshes / name, split_quads=True).mesh
    assert not len(hanging_points(mesh.points, mesh.topology))


def test_the_real_grid_with_hanging_nodes_is_told(meshes, capsys):
    """By eye: its points 12, 14, 16 and 18 from 0 lie at x = 0.2, in two edges of height 0.15."""
    path = meshes / "hanging_nodes.mesh"
    assert main(["estimate", str(path), "--split-quads", "--tris-per-block", "4"]) == 0
    assert "4 hanging nodes (12, 14, 16, 18, from 0) in the middle of an edge" in capsys.readouterr().err
    assert any("hanging" in note for note in read(path, split_quads=True).notes)


def test_degrees_are_straight_in_the_file_also_across_the_date_line(tmp_path, capsys):
    """An adaptive grid, three degrees a square: its edges are bent by the projection."""
    mesh = adaptive(2, np.array([1, 2, 1, 1]), 0.0)
    for west in (10.0, 178.0):
        x, y = (mesh.points * 3 + [west, 40.0]).T
        points = np.column_stack([np.where(x > 180, x - 360, x), y])
        lines = [f"{k} {x!r} {y!r} 1\n" for k, (x, y) in enumerate(points.tolist(), 1)]
        lines += [f"{k} 3 {a} {b} {c}\n" for k, (a, b, c) in enumerate((mesh.triangles + 1).tolist(), 1)]
        path = tmp_path / "grid.14"
        path.write_text(f"t\n{mesh.n_triangles} {mesh.n_points}\n" + "".join(lines))
        assert main(["info", str(path), "--lonlat"]) == 0
        named = ", ".join(map(str, slow_hanging(mesh)))
        assert f"2 hanging nodes ({named}, from 0)" in capsys.readouterr().err
