"""SMS .2dm: the grammar by hand, what is refused and where."""

from __future__ import annotations

import pytest

from bsgplan.errors import MeshReadError
from bsgplan.io import read

SMALL = """MESH2D
MESHNAME "a harbour"
NUM_MATERIALS_PER_ELEM 1
E3T 1 10 20 30 2
E4Q 2 20 50 60 30 1
E3T 3 10 30 40 7
E2L 4 10 20 1
ND 10 0.0 0.0 -1.5
ND 40 0.0 1.0 4.0e+000
ND 20 1.0 0.0 2.0
ND 30 1.0 1.0 3.0
ND 50 2.0 0.0 5.0
ND 60 2.0 1.0 6.0
NS 10 20
NS -50 3 "open sea"
NS 40 -10
BEGPARAMDEF
GM "Mesh"
ENDPARAMDEF
MAT 2 "sand"
"""


@pytest.fixture
def small(reading):
    """A function that writes a text as .2dm and reads it."""
    return reading("mesh.2dm")


def test_a_small_file_by_hand(small):
    found = small(SMALL)
    assert (found.format, found.title) == ("2dm", "a harbour")
    assert found.mesh.points.tolist() == [[0, 0], [0, 1], [1, 0], [1, 1]]
    assert found.mesh.triangles.tolist() == [[0, 2, 3], [0, 3, 1]]
    assert found.point_data["depth"].tolist() == [-1.5, 4, 2, 3]
    assert found.cell_data["material"].tolist() == [2, 7]
    assert found.cell_names == {"material": {2: "sand"}}
    assert found.ignored == {"quad": 1, "line": 1}
    assert found.quad_points[found.quads[0]].tolist() == [[1, 0], [2, 0], [2, 1], [1, 1]]
    assert found.is_renumbered
    opened, other = found.all_boundaries
    assert (opened.name, opened.code, opened.nodes.tolist()) == ("open sea", 3, [0, 2, 4])
    assert (other.name, other.code, other.nodes.tolist()) == ("", 2, [1, 0])


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("\n", "\r\n"),
        ("E3T 1 10", "  E3T  1   10"),
        (" 2\nE4Q", "\nE4Q"),
        ("E3T 1 10 20 30 2", "E6T 1 10 50 20 60 30 40 2"),
        ("E4Q 2 20 50 60 30", "E8Q 2 20 10 50 10 60 10 30 10"),
    ],
)
def test_spelling_does_not_matter(small, old, new):
    found = small(SMALL.replace(old, new))
    assert found.mesh.triangles.tolist() == small(SMALL).mesh.triangles.tolist()
    assert found.quads.tolist() == small(SMALL).quads.tolist()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("E3T 3 10 30 40 7", "E3T 3 10 30", r"line 6: an element \(E3T\) needs 4 numbers"),
        ("E3T 3 10 30 40", "E3T 3 10 30 41", "line 6: names point 41, which no line defines"),
        ("E3T 3 10 30 40", "E3T 3 10 30 4.5", "line 6: a point 4.5 is no whole number"),
        ("ND 40 0.0", "ND 40 x", "line 9: a point"),
        ("ND 40 0.0", "ND 10 0.0", "line 9: point 10 stands on line 8 already"),
        ("NS 40 -10", "NS 40 10", "line 16: the nodestring has no end"),
        ("NS 40 -10", "NS 40 -11", "line 16: names point 11"),
        ("NS 40 -10", "NS 40 a", "line 16: a nodestring names points"),
        ("\nND ", "\nNX ", "no ND line"),
        ("MAT 2", "MAT \0 2", "binary data"),
    ],
)
def test_an_error_names_line_value_and_remedy(small, old, new, message):
    assert old in SMALL
    with pytest.raises(MeshReadError, match=message) as caught:
        small(SMALL.replace(old, new))
    assert ";" in str(caught.value)


def test_nodestrings_of_the_bohai_sea(meshes):
    (opened,) = read(meshes / "bohai_yellow_sea_BYS_20814.2dm").boundaries
    assert (opened.n_nodes, opened.nodes[0], opened.nodes[-1]) == (70, 18842, 16105)
