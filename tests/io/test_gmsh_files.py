"""Gmsh 1.0 by hand; written again as 2.2 and 4.1, which gmsh itself and meshio read."""

from __future__ import annotations

import meshio
import numpy as np
import pytest

from bsgplan.errors import MeshReadError
from bsgplan.io import Boundary, MeshFile, read, write
from bsgplan.mesh import Mesh

SMALL = """$NOD
6
1 0 0 0
2 1 0 0
7 1 1 0
4 0 1 0
5 0.5 0.5 0
6 2 1 0
$ENDNOD
$ELM
6
1 15 0 1 1 1
2 1 5 1 2 1 2
3 1 5 1 2 2 7
4 2 8 1 3 1 2 7
5 9 9 1 6 1 7 4 5 5 5
6 3 0 1 4 2 6 7 5
$ENDELM
"""


@pytest.fixture
def small(reading):
    """A function that writes a text as .msh and reads it."""
    return reading("mesh.msh")


def test_a_small_file_by_hand(small):
    found = small(SMALL)
    assert found.format == "gmsh1"
    assert found.mesh.points.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert found.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert found.cell_data["gmsh:physical"].tolist() == [8, 9]
    assert found.ignored == {"line": 2, "quad": 1, "vertex": 1}
    (wall,) = found.boundaries
    assert (wall.code, wall.edges.tolist()) == (5, [[0, 1], [1, 2]])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("$ELM\n6", "$ELM\n7", "line 18: an element has '.ENDELM', not a finite number"),
        ("$ELM\n6", "$ELM\n5", "line 17: needs .ENDELM"),
        ("$NOD\n6", "$NOD\n999999999999", "not a finite number"),
        ("4 2 8 1 3 1 2 7", "4 2 8 1 3 1 2", "line 15: an element needs 8 numbers, got 7"),
        ("4 2 8 1 3 1 2 7", "4 2 8 1 3 1 2 3", "line 15: names point 3"),
        ("4 2 8 1 3 1 2 7", "4 77 8 1 3 1 2 7", "line 15: an element of type 77"),
        ("$ENDELM\n", "", "needs .ENDELM, got the end of the file"),
    ],
)
def test_an_error_names_line_value_and_remedy(small, old, new, message):
    assert old in SMALL
    with pytest.raises(MeshReadError, match=message) as caught:
        small(SMALL.replace(old, new))
    assert ";" in str(caught.value)


@pytest.fixture
def named():
    """Three triangles in two regions, two walls with names, data at points and cells."""
    points = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1], [-1, 0]])
    return MeshFile(
        "made", "made", Mesh(points, np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]])),
        np.empty((0, 4), dtype=np.int64), np.empty((0, 2)),
        point_data={"depth": np.arange(5.0), "wind": np.arange(10.0).reshape(5, 2)},
        cell_data={"material": np.array([0.0, 3, 0]), "error": np.array([0.5, 0.25, 0.125])},
        boundaries=(
            Boundary("named", [0, 1, 2], 5, 'the "old" wall', edges=np.array([[1, 2], [0, 1]])),
            Boundary("open", [2, 3, 4]),
        ),
        cell_names={"material": {0: "mud", 3: "rock"}},
    )  # fmt: skip


@pytest.mark.parametrize("name", ["gmsh", "gmsh41"])
def test_meshio_and_bsgplan_read_what_is_written(tmp_path, named, name):
    path = tmp_path / "named.msh"
    write(named, path, format=name)
    other = meshio.gmsh.read(path)
    assert {n: pair.tolist() for n, pair in other.field_data.items()} == {
        "the 'old' wall": [5, 1], "open 1": [1, 1], "mud": [1, 2], "rock": [4, 2],
    }  # fmt: skip
    again = read(path)
    assert [(b.name, b.code, len(b.edges)) for b in again.boundaries] == [
        ("open 1", 1, 2),
        ("the 'old' wall", 5, 2),
    ]
    assert again.cell_names == {"gmsh:physical": {1: "mud", 4: "rock"}}
    assert again.point_data["wind"].tolist() == [[0, 1, 0], [2, 3, 0], [4, 5, 0], [6, 7, 0], [8, 9, 0]]
    if name == "gmsh":
        assert "error" not in again.cell_data
        return
    at = dict(zip(again.mesh.centroids[:, 0].tolist(), again.cell_data["error"].tolist(), strict=True))
    assert at == dict(zip(named.mesh.centroids[:, 0].tolist(), [0.5, 0.25, 0.125], strict=True))
    regions = sorted(again.cell_data["gmsh:physical"].tolist())
    assert regions == [1, 1, 4]


@pytest.mark.parametrize("name", ["gmsh", "gmsh41"])
def test_gmsh_reads_what_is_written(tmp_path, named, name):
    gmsh = pytest.importorskip("gmsh", exc_type=ImportError)
    path = tmp_path / "named.msh"
    write(named, path, format=name)
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(path))
        groups = {(d, t): gmsh.model.getPhysicalName(d, t) for d, t in gmsh.model.getPhysicalGroups()}
        assert groups == {(1, 1): "open 1", (1, 5): "the 'old' wall", (2, 1): "mud", (2, 4): "rock"}
        assert [len(gmsh.model.mesh.getElementsByType(kind)[0]) for kind in (1, 2)] == [4, 3]
        views = [gmsh.view.option.getString(tag, "Name") for tag in gmsh.view.getTags()]
        assert sorted(views) == ["depth", *(["error"] if name == "gmsh41" else []), "wind"]
    finally:
        gmsh.finalize()


def test_element_data_beside_lines_in_2_2_are_read_though_meshio_cannot(tmp_path, named):
    """Meshio splits them by the length of a tuple; gmsh itself writes such files."""
    path = tmp_path / "data.msh"
    write(named, path)
    values = "\n".join(f"{k} {k / 4}" for k in range(1, 8))
    path.write_text(
        path.read_text() + f'$ElementData\n1\n"error"\n1\n0\n3\n0\n1\n7\n{values}\n$EndElementData\n'
    )
    with pytest.raises(ValueError, match="Incompatible cell data"):
        meshio.gmsh.read(path)
    found = read(path)
    assert sorted(found.cell_data["error"].tolist()) == [1.25, 1.5, 1.75]
    assert found.notes == ("constant third coordinate dropped",)
