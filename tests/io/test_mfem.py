"""MFEM: what it reads agrees with MFEM itself, MFEM reads what it writes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from predicates import assert_is_mesh_file
from strategies import meshes as random_meshes

from bsgplan.errors import MeshReadError
from bsgplan.io import Boundary, MeshFile, read
from bsgplan.io.mfem_write import write_mfem

SMALL = """MFEM mesh v1.3

# a comment
dimension
2

elements
3
4 2 0 1 2
5 2 0 2 3
1 3 1 4 5 2

attribute_sets
1
"all of it" 2 4 5

boundary
3
1 1 0 1
2 1 3 0
1 1 1 4

bdr_attribute_sets
2
"wet
wall"
1
1
"walls"
2
1
2

vertices
6
2
0 0
1 0
1 1
0 1
2 0
2 1

mfem_mesh_end
trailing words
""".replace('"wet\nwall"', '"wet wall"')


@pytest.fixture
def small(reading):
    """A function that writes a text as MFEM mesh and reads it."""
    return reading("small.mesh")


def test_a_small_file_by_hand(small):
    found = small(SMALL)
    assert_is_mesh_file(found)
    assert found.format == "mfem"
    assert found.mesh.points.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert found.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert found.cell_data["attribute"].tolist() == [4, 5]
    assert found.quad_points[found.quads[0]].tolist() == [[1, 0], [2, 0], [2, 1], [1, 1]]
    assert [(b.name, b.code, b.nodes.tolist()) for b in found.boundaries] == [
        ("wet wall", 1, [0, 1]),
        ("walls", 2, [0, 3]),
    ]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("v1.3", "v1.1", "only conforming meshes"),
        ("MFEM mesh", "MFEM NC mesh", "only conforming meshes"),
        ("MFEM mesh", "MFEM NURBS mesh", "only conforming meshes"),
        ("v1.3", "v7", "version .* is not known"),
        ("elements\n3", "elements\n1000000000000", "line 13: an element has 'attribute_sets'"),
        ("elements\n3", "elements\n2", "line 11: .* where a section begins"),
        ("vertices\n6", "vertices\n1000000000000", "line 43: a vertex has 'mfem_mesh_end'"),
        ("vertices\n6", "vertices\n5", "line 41: .* where a section begins"),
        ("vertices\n6", "vertices\nsix", "line 34: needs the number of vertices, got 'six'"),
        ("dimension\n2", "dimension\n1", "dimension 1"),
        ("5 2 0 2 3", "5 2 0 2 6", "triangle 1 names point 6"),
        ("1 1 1 4", "1 1 1 44", "boundary line 2 names point 44"),
        ("5 2 0 2 3", "5 2 0 2", "line 10: an element needs 5 numbers, got 4"),
        ("5 2 0 2 3", "5 9 0 2 3", "line 10: an element of unknown type 9"),
        ('"walls"\n2', '"walls"\n3', "needs a set"),
        ("vertices\n", "points\n", "'points' where a section begins"),
        ("1 0\n1 1\n", "1 0\n1 inf\n", "line 38: a vertex has 'inf'"),
    ],
)
def test_what_is_refused_names_the_line(small, old, new, message):
    assert old in SMALL
    with pytest.raises(MeshReadError, match=message):
        small(SMALL.replace(old, new, 1))


def test_a_file_without_vertices_is_refused(small):
    with pytest.raises(MeshReadError, match="no section 'vertices'"):
        small(SMALL.partition("vertices")[0])


def mfem_mesh(kind: str = "TRIANGLE"):
    mfem = pytest.importorskip("mfem.ser")
    return mfem, mfem.Mesh(3, 2, kind, True, 2.0, 1.0)


def test_curved_meshes_are_taken_by_their_corners(tmp_path):
    mfem, straight = mfem_mesh()
    straight.Print(str(tmp_path / "straight.mesh"))
    expected = read(tmp_path / "straight.mesh")
    for order in (1, 2, 3):
        for ordering in (mfem.Ordering.byNODES, mfem.Ordering.byVDIM):
            _, curved = mfem_mesh()
            curved.SetCurvature(order, False, 2, ordering)
            path = tmp_path / f"curved_{order}_{ordering}.mesh"
            curved.Print(str(path))
            found = read(path)
            assert found.mesh.points == pytest.approx(expected.mesh.points, abs=1e-14)
            assert np.array_equal(found.mesh.triangles, expected.mesh.triangles)


def test_discontinuous_and_nonconforming_meshes_are_refused(tmp_path):
    _, periodic = mfem_mesh()
    periodic.SetCurvature(1, True)
    periodic.Print(str(tmp_path / "periodic.mesh"))
    with pytest.raises(MeshReadError, match="no continuous points"):
        read(tmp_path / "periodic.mesh")
    mfem, squares = mfem_mesh("QUADRILATERAL")
    squares.EnsureNCMesh(True)
    squares.GeneralRefinement(mfem.intArray([0]))
    squares.Print(str(tmp_path / "hanging.mesh"))
    with pytest.raises(MeshReadError, match="only conforming meshes"):
        read(tmp_path / "hanging.mesh")


def test_attribute_sets_as_mfem_writes_them(tmp_path):
    mfem, mesh = mfem_mesh()
    mesh.bdr_attribute_sets.SetAttributeSet("wall side", mfem.intArray([1, 3]))
    mesh.bdr_attribute_sets.SetAttributeSet("out", mfem.intArray([2]))
    mesh.attribute_sets.SetAttributeSet("all", mfem.intArray([1]))
    mesh.Print(str(tmp_path / "sets.mesh"))
    found = read(tmp_path / "sets.mesh")
    assert {b.code: b.name for b in found.boundaries} == {1: "wall side", 2: "out", 3: "wall side", 4: ""}


def test_mfem_reads_what_is_written(small, tmp_path):
    found = small(SMALL)
    path = tmp_path / "again.mesh"
    write_mfem(found, path)
    mfem = pytest.importorskip("mfem.ser")
    mesh = mfem.Mesh(str(path), 0, 0)  # neither edges generated nor refinement marked: as it stands
    assert (mesh.GetNV(), mesh.GetNE(), mesh.GetNBE()) == (6, 3, 6)
    assert [mesh.GetAttribute(k) for k in range(3)] == [4, 5, 1]
    assert sorted(mesh.GetBdrAttribute(k) for k in range(6)) == [1, 1, 2, 3, 3, 3]
    again = read(path)
    assert np.array_equal(again.mesh.triangles, found.mesh.triangles)
    assert [(b.name, b.code) for b in again.all_boundaries] == [
        ("wet_wall", 1),
        ("walls", 2),
        ("unmarked", 3),
    ]


@given(mesh=random_meshes())
def test_random_meshes_survive_to_the_last_bit(tmp_path, mesh):
    rim = np.flatnonzero(mesh.topology.is_boundary)
    written = MeshFile(
        "x", "test", mesh, np.empty((0, 4), int), np.empty((0, 2)), boundaries=(Boundary("open", rim),)
    )
    write_mfem(written, tmp_path / "random.mesh")
    found = read(tmp_path / "random.mesh")
    assert np.array_equal(found.mesh.points, mesh.points)
    assert np.array_equal(found.mesh.triangles, mesh.triangles)
    assert [(b.name, b.nodes.tolist()) for b in found.boundaries] == [("open", rim.tolist())]


def test_mfem_solves_on_a_real_coast(meshes, tmp_path):
    """The area by MFEM's own quadrature is ours."""
    mfem = pytest.importorskip("mfem.ser")
    found = read(meshes / "bahamas_bight_of_abaco.fort.14")
    write_mfem(found, tmp_path / "coast.mesh")
    mesh = mfem.Mesh(str(tmp_path / "coast.mesh"), 1, 0)
    assert mesh.GetNE() == 1696
    assert sum(mesh.GetElementVolume(k) for k in range(mesh.GetNE())) == pytest.approx(
        found.mesh.area, rel=1e-12
    )
    assert mesh.GetNBE() == found.mesh.topology.is_boundary_edge.sum()
