"""Boundaries as edges of the mesh, and the points where they change."""

from __future__ import annotations

import numpy as np
import pytest

from bsgplan.errors import InvalidOption
from bsgplan.io import Boundary
from bsgplan.laid_out import find_features
from bsgplan.laid_out.tracks import changes, find_tracks
from bsgplan.mesh import Mesh
from bsgplan.mesh.edges import edge_numbers
from bsgplan.sizing import size_field

from .conftest import as_file, lattice

SQUARE = Mesh(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]), np.array([[0, 1, 2], [0, 2, 3]]))


def test_edges_are_found_either_way_and_missing_ones_told() -> None:
    """By hand, on two triangles: 1-3 is no edge."""
    found = edge_numbers(SQUARE, np.array([[1, 0], [0, 1], [1, 3]]))
    assert found[0] == found[1] >= 0
    assert set(SQUARE.topology.edges[found[0]].tolist()) == {0, 1}
    assert found[2] == -1


def test_labels_change_where_one_boundary_ends_and_nowhere_else() -> None:
    """Two boundaries that meet at 0 and 2; 1 and 3 lie inside them."""
    tracks = find_tracks(
        SQUARE, (Boundary("open", np.array([0, 1, 2])), Boundary("land", np.array([2, 3, 0]), 0))
    )
    assert changes(SQUARE, SQUARE.topology.is_boundary_edge, tracks).tolist() == [0, 2]


def test_a_closed_boundary_changes_nowhere() -> None:
    """An island of ADCIRC does not repeat its first node: the last step closes it."""
    tracks = find_tracks(SQUARE, (Boundary("land", np.array([0, 1, 2, 3]), 1),))
    assert len(tracks.edge) == 4
    assert not len(changes(SQUARE, SQUARE.topology.is_boundary_edge, tracks))


def test_a_set_of_nodes_has_the_boundary_edges_between_them() -> None:
    """The diagonal 0-2 has both ends in the set, but is no boundary edge."""
    tracks = find_tracks(SQUARE, (Boundary("named", np.array([0, 1, 2]), 7, "wall"),))
    assert {tuple(sorted(e)) for e in SQUARE.topology.edges[tracks.edge].tolist()} == {(0, 1), (1, 2)}


def test_steps_that_are_no_edges_are_counted() -> None:
    """1-3 crosses the square."""
    tracks = find_tracks(SQUARE, (Boundary("land", np.array([0, 1, 3]), 0),))
    assert tracks.missing == (1,)


def test_materials_give_interfaces() -> None:
    """Left and right half of a square: the interface is its middle line, n edges."""
    mesh = lattice(8)
    region = (mesh.centroids[:, 0] > 0.5) + 4.0
    features = find_features(as_file(mesh, cell_data={"material": region}), size_field(mesh), side=2)
    middle = mesh.points[mesh.topology.edges[features.interfaces]]
    assert len(middle) == 8
    assert (middle[..., 0] == 0.5).all()
    assert features.region_array == "material"


def test_one_material_has_no_interface() -> None:
    """An array with one value tells nothing apart."""
    mesh = lattice(4)
    found = find_features(as_file(mesh, cell_data={"material": np.ones(32)}), size_field(mesh), side=2)
    assert not found.interfaces.any()
    assert found.region_array is None


def test_keep_takes_numbers_and_names() -> None:
    """A point by its number; an inner line by its name becomes an interface."""
    mesh = lattice(4)
    line = np.array([[7, 12], [12, 17]])
    mesh_file = as_file(mesh, (Boundary("named", np.unique(line), 3, "crack", edges=line),))
    size = size_field(mesh)
    assert find_features(mesh_file, size, side=2).interfaces.sum() == 0
    found = find_features(mesh_file, size, side=2, keep=["crack", "6"])
    assert found.interfaces.sum() == 2
    assert 6 in found.kept
    with pytest.raises(InvalidOption, match="no boundary or line of made has this name; there are: crack"):
        find_features(mesh_file, size, side=2, keep=["crac"])
    with pytest.raises(InvalidOption, match="count from 0 to 24"):
        find_features(mesh_file, size, side=2, keep=["25"])
