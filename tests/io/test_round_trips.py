"""Every format that is written is read again: the same points, the same triangles, what it keeps."""

from __future__ import annotations

import logging

import numpy as np
import pytest
from hypothesis import given, settings
from predicates import assert_is_mesh_file
from strategies import meshes as random_meshes

from bsgplan.errors import InvalidOption, OutputError
from bsgplan.io import Boundary, MeshFile, read, write
from bsgplan.io.file import RawMesh, assemble
from bsgplan.io.formats import BY_NAME, FORMATS
from bsgplan.mesh import Mesh

WRITTEN = [found.name for found in FORMATS if found.writer is not None]
SUFFIX = {"gmsh41": ".msh", "jigsaw": ".msh", "ansys": ".msh", "mfem": ".mesh"}
ROUNDED = ("selafin",)
"""Formats of single precision."""
TRIANGLES_ONLY = ("triangle", "off", "tecplot", "avsucd", "dolfin", "selafin")
MIXED = [name for name in WRITTEN if name not in TRIANGLES_ONLY]
"""Formats with a place for quads."""
SPATIAL = ("gmsh", "gmsh41", "jigsaw", "medit", "vtk", "vtu", "off", "obj", "ply", "abaqus", "netgen", "xdmf")
NO_QUADS = np.empty((0, 4), dtype=np.int64)


def written_and_read(mesh_file: MeshFile, folder, name: str) -> MeshFile:
    pytest.importorskip(BY_NAME[name].extra or "numpy")
    path = folder / f"mesh{(BY_NAME[name].suffixes or (SUFFIX.get(name),))[0]}"
    write(mesh_file, path, format=name)
    assert not [p for p in folder.iterdir() if p.name.startswith(".")]
    again = read(path)
    assert_is_mesh_file(again)
    assert again.format == ("gmsh" if name == "gmsh41" else name)
    return again


def of_mesh(mesh: Mesh, **more) -> MeshFile:
    return MeshFile("made", "made", mesh, NO_QUADS, np.empty((0, 2)), **more)


def corners_of(mesh: Mesh) -> set[tuple[tuple[float, ...], ...]]:
    """Return the triangles by the coordinates of their corners, the smallest first."""
    rows = mesh.points[mesh.triangles].tolist()
    turned = [min(r[k:] + r[:k] for k in range(3)) for r in rows]
    return {tuple(map(tuple, row)) for row in turned}


@pytest.mark.parametrize("name", WRITTEN)
@settings(max_examples=10)
@given(mesh=random_meshes())
def test_points_and_triangles_to_the_last_bit(tmp_path, name, mesh):
    again = written_and_read(of_mesh(mesh), tmp_path, name).mesh
    if name in ROUNDED:
        assert np.allclose(again.points, mesh.points, rtol=1e-6, atol=1e-6)
        return
    if name in ("obj", "abaqus", "tecplot", "netgen", "mdpa", "permas", "ansys", "avsucd", "ply", "dolfin"):
        assert np.allclose(again.points, mesh.points, rtol=1e-14)
    else:
        assert np.array_equal(again.points, mesh.points)
        assert corners_of(again) == corners_of(mesh)
    order = np.lexsort(np.sort(again.triangles).T), np.lexsort(np.sort(mesh.triangles).T)
    assert np.array_equal(np.sort(again.triangles)[order[0]], np.sort(mesh.triangles)[order[1]])


@pytest.fixture
def mixed():
    """Two triangles, a quad beside them with two points of its own, a coast over all, data."""
    points = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1], [2, 0], [2, 1]])
    raw = RawMesh(
        points=points,
        triangles=np.array([[0, 1, 2], [0, 2, 3]]),
        quads=np.array([[1, 4, 5, 2]]),
        point_data={"depth": np.arange(6.0)},
        boundaries=(Boundary("land", [0, 1, 4, 5], 20), Boundary("open", [5, 2, 3])),
    )
    return assemble("made", "made", raw)


@pytest.mark.parametrize("name", MIXED)
def test_quads_with_points_of_their_own(tmp_path, name, mixed):
    again = written_and_read(mixed, tmp_path, name)
    assert again.mesh.n_triangles == 2
    assert again.ignored.get("quad") == 1
    assert sorted(again.quad_points[again.quads[0]].tolist()) == [[1, 0], [1, 1], [2, 0], [2, 1]]
    if name in ("2dm", "fort.14", "gmsh", "gmsh41", "vtu", "vtk"):
        depth = dict(zip(map(tuple, again.quad_points.tolist()), again.quad_point_data["depth"], strict=True))
        assert depth[2, 0] == 4
        assert depth[2, 1] == 5


@pytest.mark.parametrize("name", ["gmsh", "gmsh41", "jigsaw", "2dm", "fort.14", "medit"])
def test_boundaries_over_triangles_and_quads(tmp_path, name, mixed):
    land, opened = sorted(
        written_and_read(mixed, tmp_path, name).all_boundaries, key=lambda b: b.n_nodes, reverse=True
    )
    coordinates = [[0, 0], [1, 0], [2, 0], [2, 1]]
    whole = np.concatenate([mixed.mesh.points, mixed.quad_points[mixed.quad_nodes < 0]])
    assert sorted(whole[land.nodes].tolist()) == coordinates
    assert len(land.segments) == 3
    assert len(opened.segments) == 2


@pytest.mark.parametrize("name", ["triangle", "off", "tecplot", "avsucd", "dolfin"])
def test_quads_without_a_place_are_refused(tmp_path, name, mixed):
    with pytest.raises(OutputError, match="1 quads"):
        written_and_read(mixed, tmp_path, name)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", WRITTEN)
def test_a_surface_in_space_is_kept_or_refused(tmp_path, name):
    points = np.array([[0.0, 0, 0], [1, 0, 0.25], [0, 1, 0.5], [0, 0, 1]])
    mesh_file = of_mesh(Mesh(points, np.array([[0, 1, 2], [0, 2, 3]])))
    if name in SPATIAL:
        again = written_and_read(mesh_file, tmp_path, name)
        assert again.mesh.points.tolist() == points.tolist()
        assert again.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    elif name in ("fort.14", "2dm", "triangle"):
        with pytest.raises(OutputError, match="planar"):
            write(mesh_file, tmp_path / "x", format=name)


@pytest.mark.parametrize("name", ["gmsh", "gmsh41", "vtk", "vtu", "xdmf", "triangle", "2dm", "medit"])
def test_regions_are_numbers_at_the_triangles_in_their_order(tmp_path, name):
    points = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1], [-1, 0]])
    mesh = Mesh(points, np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]]))
    found = of_mesh(mesh, cell_data={"material": np.array([7.0, 3.0, 7.0])})
    again = written_and_read(found, tmp_path, name)
    (values,) = [v for n, v in again.cell_data.items() if n != "gmsh:geometrical"]
    at = {tuple(p): v for p, v in zip(again.mesh.centroids.tolist(), values.tolist(), strict=True)}
    assert at == dict(zip(map(tuple, mesh.centroids.tolist()), [7, 3, 7], strict=True))


def test_what_has_no_place_is_named_once(tmp_path, caplog):
    mesh = Mesh(np.array([[0.0, 0], [1, 0], [0, 1]]), np.array([[0, 1, 2]]))
    found = of_mesh(
        mesh,
        point_data={"depth": np.ones(3), "wind": np.ones((3, 2))},
        cell_data={"zone": np.ones(1)},
        boundaries=(Boundary("named", [0, 1], 5, "wall"), Boundary("named", [1, 2], 6)),
    )
    with caplog.at_level(logging.WARNING, "bsgplan"):
        write(found, tmp_path / "x.14")
    (record,) = caplog.records
    assert record.getMessage().endswith("no place for point array wind, cell array zone, 2 named boundaries")


@pytest.mark.parametrize(
    ("path", "name", "message"),
    [
        ("x.xyz", None, "suffix '.xyz'"),
        ("x.stl", None, "stl files are not written"),
        ("x.msh", "gmsh1", "format 'gmsh1' is not written"),
        ("x.msh", "no such", "choose one of gmsh"),
    ],
)
def test_a_format_that_is_not_written_is_wrong_usage(tmp_path, path, name, message):
    with pytest.raises(InvalidOption, match=message):
        write(of_mesh(Mesh(np.eye(3)[:, :2], np.array([[2, 0, 1]]))), tmp_path / path, format=name)
