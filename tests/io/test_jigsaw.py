"""JIGSAW .msh: meshes in the plane, in space and on an ellipsoid; grids and damage are refused."""

from __future__ import annotations

import numpy as np
import pytest

from bsgplan.errors import MeshReadError
from bsgplan.io import read

PLANE = """# mesh.msh; created by hand
MSHID=3;EUCLIDEAN-MESH
NDIMS=2
POINT=5
0.0;0.0;0
1.0;0.0;1
1.0;1.0;0
0.0;1.0;0
2.0;1.0;0
VALUE=5;1
0.5
0.25
0.5
0.75
1
EDGE2=3
0;1;4
1;2;4
2;3;7
TRIA3=2
0;1;2;0
0;2;3;3
QUAD4=0
"""


@pytest.fixture
def plane(reading):
    """A function that writes a text as .msh and reads it."""
    return reading("mesh.msh")


def test_a_plane_mesh_by_hand(plane):
    found = plane(PLANE)
    assert found.format == "jigsaw"
    assert found.mesh.points.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert found.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert found.point_data["value"].tolist() == [0.5, 0.25, 0.5, 0.75]
    assert found.point_data["tag"].tolist() == [0, 1, 0, 0]
    assert found.cell_data["tag"].tolist() == [0, 3]
    assert found.ignored == {"line": 3, "quad": 0}
    assert [(b.code, b.edges.tolist()) for b in found.boundaries] == [(4, [[0, 1], [1, 2]]), (7, [[2, 3]])]


def test_an_ellipsoid_in_radians_is_told_in_degrees(plane):
    found = plane(PLANE.replace("EUCLIDEAN", "ELLIPSOID").replace("NDIMS", "RADII=6371.;6371.;6371.\nNDIMS"))
    assert np.allclose(found.mesh.points, np.rad2deg([[0, 0], [1, 0], [1, 1], [0, 1]]))
    assert found.notes[0] == "longitude and latitude, radians in the file, are told in degrees"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("EUCLIDEAN-MESH", "EUCLIDEAN-GRID", "a JIGSAW grid, a size field"),
        ("NDIMS=2", "NDIMS=4", "line 3: 4 dimensions; needs 2 or 3"),
        ("NDIMS=2\n", "", "line 3: POINT before NDIMS"),
        ("POINT=5", "POINT=6", "line 10: POINT has 'VALUE=5'"),
        ("POINT=5", "POINT=4", "line 9: needs NAME="),
        ("0;2;3;3", "0;2;9;3", "TRIA3 1 names point 9"),
        ("0;2;3;3", "0;2;3", "line 22: TRIA3 needs 4 numbers, got 3"),
        ("VALUE=5;1", "VALUE=5;1000000000", "numbers at a point"),
        ("VALUE=5;1", "VALUE=4;1", "needs NAME="),
        ("QUAD4=0", "QUAD4=999999999999", "the file ends after 0 of 999999999999"),
        ("QUAD4=0", "PENTA5=0", "no section of JIGSAW is called 'PENTA5'"),
    ],
)
def test_an_error_names_line_value_and_remedy(plane, old, new, message):
    assert old in PLANE
    with pytest.raises(MeshReadError, match=message) as caught:
        plane(PLANE.replace(old, new))
    assert ";" in str(caught.value)


def test_a_surface_in_space_of_tiny_units(meshes):
    found = read(meshes / "jigsaw_piece.msh")
    assert found.mesh.points.shape == (337, 3)
    assert np.ptp(found.mesh.points) < 1e-6
