"""The ADCIRC and SCHISM text mesh: what it reads, what it refuses, what it gives back."""

from __future__ import annotations

import numpy as np
import pytest
import reference
from hypothesis import given
from hypothesis import strategies as st
from predicates import assert_is_mesh_file
from strategies import meshes as random_meshes

from bsgplan.errors import BsgplanError, MeshReadError, OutputError
from bsgplan.io import Boundary, MeshFile, read, write_fort14

SMALL = """a square  ! with a comment
2 4   ! NE, NP
1 0.0 0.0 1.5   ! first node
2 1.0 0.0 -2.5D+00
3 1.0 1.0 1.0e-1
4 0.0 1.0 4
1 3 1 2 3
2 3 1 3 4
1 = Number of open boundaries
2 = Total number of open boundary nodes
2 = Number of nodes for open boundary 1
1
2 the last one
2 ! land
6
3 0 ! mainland
2
3
4
1 24 = a weir
4 1 0.25 1.0 1.0 ! node, partner, height, coefficients
"""


@pytest.fixture
def small(reading):
    """A function that writes a text as fort.14 and reads it."""
    return reading("fort.14")


def test_a_small_file_by_hand(small):
    found = small(SMALL)
    assert_is_mesh_file(found)
    assert found.format == "fort.14"
    assert found.title == "a square  ! with a comment"
    assert found.mesh.points.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert found.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert found.point_data["depth"].tolist() == [1.5, -2.5, 0.1, 4.0]
    opened, land, weir = found.boundaries
    assert (opened.kind, opened.code, opened.nodes.tolist()) == ("open", None, [0, 1])
    assert (land.kind, land.code, land.nodes.tolist()) == ("land", 0, [1, 2, 3])
    assert (weir.code, weir.nodes.tolist(), weir.partners.tolist()) == (24, [3], [0])
    assert weir.columns.tolist() == [[0.25, 1.0, 1.0]]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("\n", "\r\n"),
        ("4\n1 3 1 2 3", "4\n1   3  1 2 3  ! comment"),
        ("1 24 = a weir\n4 1 0.25 1.0 1.0 !", "1 24 = a weir\n4 1 0.25 1.0 1.0\n\n\n  \n!")[0:2],
    ],
)
def test_spelling_does_not_matter(small, old, new):
    assert small(SMALL.replace(old, new)).mesh.n_triangles == 2


def test_ids_in_any_order_and_with_gaps(small):
    """SCHISM and cut-out meshes number as they like."""
    head, _, _ = SMALL.partition("1 0.0")
    text = head + "70 0 1 4\n5 0 0 1\n20 1 0 2\n300 1 1 3\n9 3 5 20 300\n8 3 5 300 70\n"
    found = small(text)
    assert found.mesh.points[found.mesh.triangles[0]].tolist() == [[0, 0], [1, 0], [1, 1]]
    assert found.point_data["depth"].tolist() == [4, 1, 2, 3]


def test_elements_of_four_nodes_are_quads_measured_apart(small):
    found = small("mixed\n2 5\n1 0 0 1\n2 1 0 1\n3 1 1 1\n4 0 1 1\n5 2 0.5 7\n1 4 1 2 3 4\n2 3 2 5 3\n")
    assert found.mesh.n_triangles == 1
    assert found.ignored == {"quad": 1}
    assert found.quad_points[found.quads[0]].tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert found.point_data["depth"].tolist() == [1, 1, 7]
    assert not any("dropped" in note for note in found.notes)


def test_clockwise_and_unused_are_told(small):
    text = "t\n1 4\n1 0 0 1\n2 5 5 1\n3 1 0 1\n4 0 1 9\n1 3 1 4 3\n0\n0\n1\n2\n2 0\n1\n2\n"
    found = small(text)
    assert_is_mesh_file(found)
    assert found.point_data["depth"].tolist() == [1, 1, 9]
    assert found.boundaries[0].nodes.tolist() == [0]
    told = " ".join(found.notes)
    assert "1 clockwise triangle turned" in told
    assert "1 point of no cell dropped" in told
    assert "1 boundary entry dropped" in told


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("2 4   !", "2 four !", "line 2: needs the numbers of elements and nodes"),
        ("2 4   !", "999999999999 1000000000000 !", "line 2: .* only 19 follow"),
        ("2 4   !", "0 4 !", "line 2: 0 elements"),
        ("2 4   !", "2 3 !", "line 6: an element needs 5 numbers"),
        ("2 4   !", "2 5 !", "line 7: node id 1 stands on line 3 already"),
        ("2 1.0 0.0", "2 one 0.0", "line 4: a node has x 'one'"),
        ("2 1.0 0.0", "2 nan 0.0", "line 4: a node has x 'nan'"),
        ("2 1.0 0.0", "2.5 1.0 0.0", "line 4: node id 2.5 is no whole number"),
        ("4 0.0 1.0 4", "4 0.0 1.0", r"line 6: a node needs 4 numbers \(id x y depth\)"),
        ("4 0.0 1.0 4", "", "line 6: blank"),
        ("2 3 1 3 4", "2 3 1 3 99", r"line 8: the element names node 99.*ids 1 .. 4"),
        ("2 3 1 3 4", "2 3 1 3", "line 8: an element needs 5 numbers"),
        ("2 3 1 3 4", "2 5 1 3 4", "line 8: an element has 3 or 4 nodes"),
        ("2 = Total", "x = Total", "line 10: needs the total number of open"),
        ("2 = Number", "200 = Number", "line 11: open boundary 1 claims 200 nodes"),
        ("2 the last one", "17", "line 13: the boundary names node 17"),
        ("4 1 0.25 1.0 1.0", "4 1 0.25", "line 21: needs a barrier with 5 numbers"),
        (
            "1 24 = a weir\n4 1 0.25 1.0 1.0 ! node, partner, height, coefficients\n",
            "",
            "the file ends before",
        ),
    ],
)
def test_an_error_names_line_value_and_remedy(small, old, new, message):
    assert old in SMALL
    with pytest.raises(MeshReadError, match=message) as caught:
        small(SMALL.replace(old, new, 1))
    assert ";" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_round_trip_is_exact(tmp_path, small):
    found = small(SMALL.replace("1.0 1.0 1.0e-1", "0.1 0.30000000000000004 1e-17"))
    path = tmp_path / "again.14"
    write_fort14(found, path)
    assert_same(read(path), found)
    assert [p.name for p in tmp_path.iterdir() if p.name.startswith(".")] == []


@pytest.mark.parametrize("name", ["weirs_internal_overflow", "vew1d_coincident_seams", "katrina_wnat_om2d"])
def test_round_trip_of_real_meshes(tmp_path, meshes, name):
    found = read(meshes / f"{name}.fort.14")
    write_fort14(found, tmp_path / "again.14")
    assert_same(read(tmp_path / "again.14"), found)


@given(mesh=random_meshes(), data=st.data())
def test_round_trip_of_random_meshes(tmp_path, mesh, data):
    depth = np.array(
        data.draw(st.lists(st.floats(-1e6, 1e6), min_size=mesh.n_points, max_size=mesh.n_points))
    )
    nodes = np.array(data.draw(st.lists(st.integers(0, mesh.n_points - 1), max_size=5)), dtype=np.int64)
    columns = np.linspace(0, 1, len(nodes) * 3).reshape(-1, 3)
    boundaries = (Boundary("open", nodes), Boundary("land", nodes, 24, partners=nodes[::-1], columns=columns))
    quads = np.empty((0, 4), dtype=np.int64)
    found = MeshFile(
        "x", "fort.14", mesh, quads, np.empty((0, 2)), {"depth": depth}, {}, boundaries, title="random"
    )
    write_fort14(found, tmp_path / "r.14")
    again = read(tmp_path / "r.14")
    assert_same(again, found)
    nodes_slow, triangles_slow = reference.read_fort14((tmp_path / "r.14").read_text())
    assert np.column_stack([again.mesh.points, again.point_data["depth"]]).tolist() == nodes_slow
    assert (again.mesh.triangles + 1).tolist() == triangles_slow


def test_a_folder_that_is_not_there_is_an_output_error(tmp_path, small):
    with pytest.raises(OutputError, match="cannot be written"):
        write_fort14(small(SMALL), tmp_path / "no" / "x.14")


@given(data=st.data())
def test_any_damage_gives_a_mesh_or_a_one_line_error(tmp_path, data):
    """Fuzz: bytes and lines deleted, inserted and replaced."""
    content = bytearray(SMALL.encode())
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(content)))
        stop = min(len(content), start + data.draw(st.sampled_from([0, 1, 1, 2, 20, 60])))
        piece = data.draw(
            st.one_of(
                st.sampled_from([b"", b"-", b".", b"1e400", b"\n", b" 9 ", b"\n\n", b"!"]),
                st.binary(max_size=4),
            )
        )
        content[start:stop] = piece
    path = tmp_path / "fuzz.14"
    path.write_bytes(content)
    message = ""
    try:
        assert_is_mesh_file(read(path))
    except BsgplanError as error:
        message = str(error)
    assert "\n" not in message
    assert message == "" or str(path) in message


def assert_same(found: MeshFile, expected: MeshFile) -> None:
    """Equal to the last bit: points, triangles, depth, title, boundaries."""
    assert found.title == expected.title
    assert np.array_equal(found.mesh.points, expected.mesh.points)
    assert np.array_equal(found.mesh.triangles, expected.mesh.triangles)
    assert np.array_equal(found.point_data["depth"], expected.point_data["depth"])
    assert len(found.boundaries) == len(expected.boundaries)
    for a, b in zip(found.boundaries, expected.boundaries, strict=True):
        assert (a.kind, a.code, a.nodes.tolist()) == (b.kind, b.code, b.nodes.tolist())
        for name in ("partners", "columns"):
            left, right = getattr(a, name), getattr(b, name)
            assert (left is None) == (right is None)
            assert left is None or np.array_equal(left, right)
