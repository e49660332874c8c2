"""SU2: markers with their names, several zones, mixed cells, surfaces; what is refused, what comes back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from predicates import assert_is_mesh_file
from strategies import meshes as random_meshes

from bsgplan.errors import BsgplanError, MeshReadError
from bsgplan.io import Boundary, MeshFile, read
from bsgplan.io.su2_write import write_su2

SMALL = """% a square and a quad beside it
NDIME= 2
NELEM= 3
5 0 1 2 0
5 0 2 3 1
9 1 4 5 2 2
NPOIN= 6 6
0.0 0.0 0
1.0 0.0 1
1.0 1.0 2
0.0 1.0e+000 3
2.0 0.0 4
2.0 1.0 5
NMARK= 2
MARKER_TAG= lower wall
MARKER_ELEMS= 2
3 0 1
3 1 4
MARKER_TAG= 7
MARKER_ELEMS= 1
SEND_RECV= 1
3 3 0
"""

TWO_ZONES = """NZONE= 2
IZONE= 1
NDIME= 2
NELEM= 1
5 0 1 2
NPOIN= 3
0 0
1 0
0 1
NMARK= 1
MARKER_TAG= left
MARKER_ELEMS= 1
3 2 0
IZONE= 2
NDIME= 2
NPOIN= 3
1 0
2 0
2 1
NELEM= 1
5 2 1 0
NMARK= 1
MARKER_TAG= right
MARKER_ELEMS= 1
3 1 2
FFD_NBOX= 1
1 2 3
"""


@pytest.fixture
def small(reading):
    """A function that writes a text as SU2 and reads it."""
    return reading("mesh.su2")


def test_a_small_file_by_hand(small):
    found = small(SMALL)
    assert_is_mesh_file(found)
    assert found.format == "su2"
    assert found.mesh.points.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert found.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert found.quad_points[found.quads[0]].tolist() == [[1, 0], [2, 0], [2, 1], [1, 1]]
    assert [(b.kind, b.name, b.code, b.nodes.tolist()) for b in found.boundaries] == [
        ("named", "lower wall", 1, [0, 1]),
        ("named", "7", 7, [0, 3]),
    ]
    assert found.ignored == {"quad": 1}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("\n", "\r\n"),
        ("NDIME= 2", "ndime=2"),
        ("5 0 1 2 0\n", "5\t0  1 2\n\n% in between\n"),
        ("0.0 0.0 0\n", "0.0 0.0 % without index\n"),
        ("5 0 1 2 0", "5.0 0 1 2.0 0"),
    ],
)
def test_spelling_does_not_matter(small, old, new):
    found = small(SMALL.replace(old, new))
    assert found.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert [b.name for b in found.boundaries] == ["lower wall", "7"]


def test_two_zones_are_joined_with_their_own_points(small):
    found = small(TWO_ZONES)
    assert_is_mesh_file(found)
    assert found.mesh.n_points == 6
    corners = found.mesh.points[found.mesh.triangles]
    assert sorted(map(sorted, corners.tolist())) == [
        [[0, 0], [0, 1], [1, 0]],
        [[1, 0], [2, 0], [2, 1]],
    ]
    assert found.cell_data["zone"].tolist() == [1, 2]
    assert [(b.name, b.code, b.nodes.tolist()) for b in found.boundaries] == [
        ("left", 1, [0, 2]),
        ("right", 2, [4, 5]),
    ]
    assert "2 zones joined, their points stay apart" in found.notes


def test_a_surface_in_space_and_the_skin_of_a_volume(small):
    surface = small("NDIME= 3\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0 0\n1 0 1\n0 1 1\nNMARK= 0\n")
    assert surface.mesh.points.tolist() == [[0, 0, 0], [1, 0, 1], [0, 1, 1]]
    volume = small(
        "NDIME= 3\nNELEM= 1\n10 0 1 2 3\nNPOIN= 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nNMARK= 2\n"
        "MARKER_TAG= floor\nMARKER_ELEMS= 1\n5 0 2 1\nMARKER_TAG= sides\nMARKER_ELEMS= 2\n5 0 1 3\n5 0 3 2\n"
    )
    assert volume.mesh.n_triangles == 3
    assert volume.cell_data["marker"].tolist() == [1, 2, 2]
    assert volume.ignored == {"tetra": 1}


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("NELEM= 3", "NELEM= 1000000000000", "line 7: an element has 'NPOIN=', not a finite number"),
        ("NPOIN= 6 6", "NPOIN= 1000000000000", "line 14: a point has 'NMARK='"),
        ("NPOIN= 6 6", "NPOIN= 5", "line 13: .* after the last line that NPOIN counts"),
        ("NELEM= 3", "NELEM= 2", "line 6: .* after the last line that NELEM counts"),
        (
            "MARKER_ELEMS= 1",
            "MARKER_ELEMS= 9999999999999",
            "the file ends after 1 of 9999999999999 lines, marker '7' each",
        ),
        ("NELEM= 3", "NELEM= -3", "line 3: NELEM= '-3' is no count"),
        ("NELEM= 3", "NELEM= three", "line 3: NELEM= 'three' is no count"),
        ("NDIME= 2", "NDIME= 4", "line 2: NDIME= 4 is not 2 or 3"),
        ("NDIME= 2\n", "NPOIN= 1\n", "NPOIN= stands before NDIME="),
        ("5 0 1 2 0", "6 0 1 2 0", "line 4: an element of unknown type 6"),
        ("5 0 1 2 0", "5 0 1", "line 4: an element needs 4 numbers, got 3"),
        ("5 0 1 2 0", "5 0 1 2.5 0", "line 4: an element has 2.5 for a whole number"),
        ("5 0 1 2 0", "5 0 1 6 0", r"triangle 0 names point 6, the file has points 0 \.\. 5"),
        ("5 0 1 2 0", "5 0 1 -2 0", "triangle 0 names point -2"),
        ("3 1 4", "3 1 44", "marker 'lower wall', line 1 names point 44"),
        ("2.0 0.0 4", "2.0 nan 4", "line 12: a point has 'nan'"),
        ("2.0 0.0 4", "2.0", "line 12: a point needs 2 numbers, got 1"),
        ("NMARK= 2", "NPOIN= 0", "line 14: NPOIN= stands twice"),
        ("NDIME= 2\n", "NDIME= 2\nNZONE= 3\n", "NZONE= 3, but 1 zones follow"),
    ],
)
def test_what_is_refused_names_the_line(small, old, new, message):
    assert old in SMALL
    with pytest.raises(MeshReadError, match=message):
        small(SMALL.replace(old, new, 1))


@pytest.mark.parametrize("section", ["NPOIN", "NELEM"])
def test_a_missing_section_is_named(small, section):
    lines = [line for line in SMALL.splitlines() if not line.startswith("%")]
    start = next(k for k, line in enumerate(lines) if line.startswith(section))
    stop = next(k for k in range(start + 1, len(lines)) if "=" in lines[k])
    with pytest.raises(MeshReadError, match=f"no {section}= section"):
        small("\n".join(lines[:start] + lines[stop:]))


def test_what_is_written_is_read_again(small, tmp_path):
    found = small(SMALL)
    write_su2(found, tmp_path / "again.su2")
    again = read(tmp_path / "again.su2")
    assert np.array_equal(again.mesh.points, found.mesh.points)
    assert np.array_equal(again.mesh.triangles, found.mesh.triangles)
    assert again.quad_points[again.quads].tolist() == found.quad_points[found.quads].tolist()
    named = [(b.name, again_nodes(again, b)) for b in again.all_boundaries]
    assert named == [
        ("lower_wall", [[0, 0], [1, 0], [2, 0]]),
        ("7", [[0, 0], [0, 1]]),
        ("unmarked", [[0, 1], [1, 1], [2, 0], [2, 1]]),
    ]


def again_nodes(mesh_file: MeshFile, boundary: Boundary) -> list[list[float]]:
    own = mesh_file.quad_points[mesh_file.quad_nodes < 0]
    return sorted(np.concatenate([mesh_file.mesh.points, own])[boundary.nodes].tolist())


@given(mesh=random_meshes())
def test_random_meshes_survive_to_the_last_bit(tmp_path, mesh):
    rim = np.flatnonzero(mesh.topology.is_boundary)
    boundary = Boundary("named", rim, 3, "rim")
    written = MeshFile("x", "test", mesh, np.empty((0, 4), int), np.empty((0, 2)), boundaries=(boundary,))
    write_su2(written, tmp_path / "random.su2")
    found = read(tmp_path / "random.su2")
    assert np.array_equal(found.mesh.points, mesh.points)
    assert np.array_equal(found.mesh.triangles, mesh.triangles)
    assert [(b.name, b.nodes.tolist()) for b in found.boundaries] == [("rim", rim.tolist())]


def test_the_four_zones_of_a_real_file(meshes):
    found = read(meshes / "multizone_cht_3cyl_ffd.su2")
    assert_is_mesh_file(found)
    assert found.ignored == {"quad": 45750}
    assert found.mesh.n_triangles + 45750 == 33700 + 3 * 4534
    assert [b.name for b in found.boundaries][:4] == [
        "cylinder_outer1", "cylinder_outer2", "cylinder_outer3", "farfield",
    ]  # fmt: skip
    assert [b.n_nodes for b in found.all_boundaries] == [400] * 3 + [80] + [40, 400] * 3


def test_real_markers_lie_on_the_rim(meshes):
    found = read(meshes / "mesh_NACA0012_inv.su2")
    assert [(b.name, b.n_nodes) for b in found.boundaries] == [("airfoil", 200), ("farfield", 50)]
    on_rim = found.mesh.topology.is_boundary
    assert on_rim.sum() == 250
    assert all(on_rim[b.nodes].all() for b in found.boundaries)


def test_binary_garbage_is_refused(tmp_path):
    path = tmp_path / "x.su2"
    path.write_bytes(b"NDIME= 2\nNELEM= 5\n" + bytes(range(256)) * 9000)
    with pytest.raises(BsgplanError, match="line"):
        read(path)
    path.write_bytes(b"NDIME= 2\nNELEM= 5\n" + b"x" * 3_000_000)
    with pytest.raises(BsgplanError, match="no line of a mesh"):
        read(path)
