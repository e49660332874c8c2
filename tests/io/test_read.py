"""`read` through meshio: data follow their points, other cells are counted, errors are one line."""

from __future__ import annotations

import re

import meshio
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from predicates import assert_is_mesh_file

from bsgplan.errors import InvalidMesh, MeshReadError
from bsgplan.io import read, write
from bsgplan.io.file import RawMesh, _n_coincident, assemble
from bsgplan.io.sniff import format_of

POINTS = np.array([[9.0, 9, 0], [0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]])
CELLS = [
    ("triangle", np.array([[1, 2, 3]])),
    ("line", np.array([[1, 2], [2, 5]])),
    ("quad", np.array([[2, 5, 6, 3]])),
    ("triangle", np.array([[1, 4, 3]])),
]


@pytest.fixture
def mixed(tmp_path):
    """A file of two triangle blocks around lines and a quad, with an unused point and data."""
    path = tmp_path / "mixed.vtu"
    mesh = meshio.Mesh(
        POINTS,
        CELLS,
        point_data={"depth": np.arange(7.0), "velocity": np.arange(14.0).reshape(7, 2)},
        cell_data={"material": [[10], [20, 21], [30], [40]]},
    )
    meshio.vtu.write(str(path), mesh)
    return path


def test_data_follow_blocks_and_dropped_points(mixed):
    found = read(mixed)
    assert_is_mesh_file(found)
    assert found.format == "vtu"
    assert found.point_data["depth"].tolist() == [1, 2, 3, 4]
    assert found.point_data["velocity"][:, 0].tolist() == [2, 4, 6, 8]
    assert found.cell_data["material"].tolist() == [10, 40]
    assert found.ignored == {"line": 2, "quad": 1}
    assert found.quads.tolist() == [[0, 2, 3, 1]]
    assert found.quad_points.shape == (4, 2)
    assert found.notes == (
        "1 clockwise triangle turned counter-clockwise",
        "1 point of no cell dropped",
        "constant third coordinate dropped",
        "1 quad measured apart; --split-quads makes them triangles",
    )


@pytest.mark.parametrize("binary", [True, False])
@pytest.mark.parametrize("version", ["2.2", "4.1"])
def test_gmsh_in_both_versions_ascii_and_binary(tmp_path, version, binary, capfd):
    path = tmp_path / "g.msh"
    cells = [("triangle", np.array([[1, 2, 3], [1, 3, 4]])), ("line", np.array([[1, 2], [2, 3]]))]
    data = {
        "gmsh:physical": [np.array([7, 7]), np.array([5, 6])],
        "gmsh:geometrical": [np.array([1, 1]), np.array([1, 2])],
    }
    names = {"wall": np.array([5, 1]), "sea": np.array([7, 2])}
    mesh = meshio.Mesh(POINTS[:5], cells, cell_data=data, field_data=names)
    if version == "4.1":
        mesh = meshio.Mesh(POINTS[:5], cells[:1])
    meshio.gmsh.write(str(path), mesh, version, binary=binary)
    capfd.readouterr()
    found = read(path)
    assert capfd.readouterr() == ("", "")
    assert_is_mesh_file(found)
    assert (found.format, found.mesh.n_triangles) == ("gmsh", 2)
    assert found.ignored == ({"line": 2} if version == "2.2" else {})
    if version == "2.2":
        assert [(b.name, b.code, b.nodes.tolist()) for b in found.boundaries] == [
            ("wall", 5, [0, 1]),
            ("", 6, [1, 2]),
        ]


def test_six_node_triangles_are_taken_by_their_corners(meshes):
    found = read(meshes / "quadratic_tri.msh")
    assert found.mesh.n_triangles == 119
    assert "cells of higher order are taken by their corners" in found.notes
    assert not any("dropped" in note and "point" in note for note in found.notes)  # 190 mid-side nodes


@pytest.mark.parametrize(
    ("cells", "message"),
    [
        ([("quad", [[1, 2, 3, 4]])], "no triangles, it holds 7 points, 1 quad cells"),
        ([("triangle", [[1, 2, 3], [3, 1, 2]])], "twice"),
        ([("triangle", [[1, 2, 2]])], "zero area"),
        ([("triangle", [[1, 2, 3], [1, 2, 4], [1, 2, 6]])], "non-manifold"),
    ],
)
def test_what_is_no_mesh_is_refused_with_the_path(tmp_path, cells, message):
    path = tmp_path / "bad.vtk"
    meshio.vtk.write(str(path), meshio.Mesh(POINTS, [(kind, np.array(c)) for kind, c in cells]))
    with pytest.raises((InvalidMesh, MeshReadError), match=message) as caught:
        read(path)
    assert str(path) in str(caught.value)


def test_missing_empty_directory_and_garbage_are_one_line_each(tmp_path):
    (tmp_path / "empty.msh").write_bytes(b" \n\n")
    (tmp_path / "garbage.xyz").write_bytes(bytes(range(256)))
    (tmp_path / "garbage.msh").write_bytes(bytes(range(128, 256)))
    expected = {
        "missing.msh": "no such file",
        "empty.msh": "is empty",
        "garbage.xyz": "format not recognised",
        "garbage.msh": "no gmsh file",
        ".": "is a directory",
        "nul\0.msh": "not a file name",
    }
    for name, message in expected.items():
        with pytest.raises(MeshReadError, match=message) as caught:
            read(tmp_path / name)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "suffix",
    [
        "msh",
        "vtk",
        "vtu",
        "su2",
        "mesh",
        "off",
        "stl",
        "ply",
        "obj",
        "inp",
        "bdf",
        "vol",
        "xml",
        "dat",
        "xdmf",
        "e",
        "med",
    ],
)
def test_garbage_under_any_suffix_is_a_mesh_read_error(tmp_path, suffix, capfd):
    path = tmp_path / f"garbage.{suffix}"
    path.write_bytes(np.random.default_rng(5021).bytes(3000))
    with pytest.raises(MeshReadError):
        read(path)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("head", "name", "expected"),
    [
        (b"$MeshFormat\n4.1 0 8\n", "x.dat", "gmsh"),
        (b"$NOD\n3\n", "x.msh", "gmsh1"),
        (b"# a comment\nmshid=3\n", "x.msh", "jigsaw"),
        (b'(0 "exported by")\n', "x.msh", "ansys"),
        (b"MFEM mesh v1.0\n", "x.mesh", "mfem"),
        (b"MeshVersionFormatted 2\n", "x.mesh", "medit"),
        (b"% comment\nNDIME= 2\n", "x.txt", "su2"),
        (b"# vtk DataFile Version 5.1\n", "x", "vtk"),
        (b'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid">', "x", "vtu"),
        (b'<VTKFile type="PolyData">', "x.vtu", "polydata"),
        (b"\x89HDF\r\n\x1a\n", "x.nc", "netcdf"),
        (b"\x89HDF\r\n\x1a\n", "x.med", "med"),
        (b"CDF\x01", "x.nc", "netcdf"),
        (b"\x00\x00\x00\x50" + b"T" * 72 + b"SERAFIN \x00\x00\x00\x50", "x.bin", "selafin"),
        (b"MESH2D\nE3T", "x.14", "2dm"),
        (b"title\n2 4\n1 0.0 0.0 0.0\n", "hgrid.txt2", "fort.14"),
        (b"title\n2 4\n1 0.0 0.0 -1.0D+01 ! x\n", "fort.14", "fort.14"),
        (b"1 3 0\n1 2 3\n1 0 0 0\n", "x.ele", "triangle"),
        (b"hello\n", "notes.txt", None),
    ],
)
def test_content_decides_before_the_suffix(head, name, expected):
    assert format_of(head, name) == expected


PARTIAL = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
2 7 "sea"
$EndPhysicalNames
$Entities
0 0 2 0
1 0 0 0 1 1 0 1 7 0
2 0 0 0 1 1 0 0 0
$EndEntities
$Nodes
1 4 1 4
2 1 0 4
1
2
3
4
0 0 0
1 0 0
1 1 0
0 1 0
$EndNodes
$Elements
2 2 1 2
2 1 2 1
1 1 2 3
2 2 2 1
2 1 3 4
$EndElements
"""


def test_physical_groups_on_a_part_of_the_cells_do_not_stop_the_reader(tmp_path):
    """Meshio raises ValueError there; the tags are kept, 0 where there is none, and a note tells."""
    path = tmp_path / "partial.msh"
    path.write_text(PARTIAL)
    found = read(path)
    assert found.mesh.n_triangles == 2
    assert found.cell_data["gmsh:physical"].tolist() == [7, 0]
    assert found.cell_names == {"gmsh:physical": {7: "sea"}}
    assert "a part of the cells only" in found.notes[0]


@given(places=st.lists(st.tuples(*[st.sampled_from([-1.0, -0.0, 0.0, 2.5])] * 3), min_size=1, max_size=20))
@pytest.mark.parametrize("dimension", [2, 3])
def test_points_that_coincide_are_counted_as_a_set_counts_them(dimension, places):
    points = np.array(places)[:, :dimension]
    assert _n_coincident(points) == len(points) - len(set(map(tuple, points.tolist())))


@given(data=st.data())
def test_triangles_that_stand_twice_are_counted(data):
    """Triangles apart from each other in space, some again, turned or not; each thrice is not manifold."""
    n = data.draw(st.integers(1, 6))
    again = data.draw(st.sets(st.integers(0, n - 1)))
    once = np.arange(3 * n).reshape(n, 3)
    twins = [once[k][data.draw(st.permutations([0, 1, 2]))] for k in sorted(again)]
    triangles = np.array([*once, *twins])[data.draw(st.permutations(range(n + len(twins))))]
    points = np.random.default_rng(3).random((3 * n, 3))
    raw = RawMesh(points, triangles, np.empty((0, 4), dtype=np.int64))
    if not again:
        assert assemble("t", "made", raw).mesh.n_triangles == n
        return
    message = rf"^t: {len(again)} triangles? stands? in the file twice, the first (\d+) and (\d+);"
    with pytest.raises(InvalidMesh, match=message) as caught:
        assemble("t", "made", raw)
    first, second = map(int, re.match(message, str(caught.value)).groups())
    assert first < second
    assert sorted(triangles[first]) == sorted(triangles[second])


@pytest.mark.parametrize("suffix", [".msh", ".vtu"])
def test_a_file_cut_short_is_told_as_such(tmp_path, suffix):
    """By where it ends, not by what the reader stumbled over."""
    whole = tmp_path / f"whole{suffix}"
    write(read("cases/plate/mesh.msh"), whole)
    content = whole.read_bytes()
    for share in (0.3, 0.6, 0.9):
        cut = tmp_path / f"cut{suffix}"
        n = int(share * len(content))
        cut.write_bytes(content[:n])
        told = rf"cut{suffix}: the \w+ file ends early, after {n} bytes, with '.*'; fetch or save it again"
        with pytest.raises(MeshReadError, match=told):
            read(cut)


@pytest.mark.parametrize("suffix", ["msh", "vtu", "vtk"])
def test_what_is_no_file_of_its_suffix_is_told_by_how_it_begins(tmp_path, suffix):
    path = tmp_path / f"garbage.{suffix}"
    path.write_bytes(bytes(range(167, 255)))
    with pytest.raises(
        MeshReadError, match=r"no \w+ file, it begins with '\\xa7\\xa8.*; give one, or a suffix"
    ):
        read(path)


def test_one_is_no_plural():
    """One triangle twice, one point that coincides."""
    none = np.empty((0, 4), dtype=np.int64)
    points = np.array([[0.0, 0], [1, 0], [0, 1], [1, 1], [0, 1], [1, 1.5]])
    with pytest.raises(InvalidMesh, match="1 triangle stands in the file twice"):
        assemble("t", "made", RawMesh(points, np.array([[0, 1, 2], [0, 1, 2]]), none))
    notes = assemble("t", "made", RawMesh(points, np.array([[0, 1, 2], [3, 4, 5]]), none)).notes
    assert any(note.startswith("1 point coincides with another point; they stay apart") for note in notes)
