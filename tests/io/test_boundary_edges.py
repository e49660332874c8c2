"""Boundaries as edges: the smallest set of points decides, names and tags are unique."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from strategies import meshes as random_meshes

from bsgplan.io import Boundary
from bsgplan.io.boundary_edges import edge_groups, rim

SQUARE = np.array([[0, 1, 2], [0, 2, 3]])
NO_QUADS = np.empty((0, 4), dtype=np.int64)


def groups_of(*boundaries: Boundary) -> list[tuple[str, int, list[list[int]]]]:
    return [(g.name, g.tag, sorted(g.edges.tolist())) for g in edge_groups(SQUARE, NO_QUADS, boundaries, 4)]


def test_one_edge_between_two_ends_of_a_long_boundary_stays_its_own():
    coast, sea = Boundary("land", [1, 2, 3, 0], 20), Boundary("open", [0, 1])
    assert groups_of(coast, sea) == [("land_20", 20, [[1, 2], [2, 3], [3, 0]]), ("open", 21, [[0, 1]])]


def test_the_rest_is_unmarked_and_the_diagonal_no_edge_of_the_rim():
    assert groups_of(Boundary("named", [0, 1, 2], 5, "two sides")) == [
        ("two_sides", 5, [[0, 1], [1, 2]]),
        ("unmarked", 6, [[2, 3], [3, 0]]),
    ]
    assert groups_of() == [("unmarked", 1, [[0, 1], [1, 2], [2, 3], [3, 0]])]


def test_equal_names_and_codes_are_told_apart_and_pieces_joined():
    a, b = Boundary("named", [0, 1], 1, "wall"), Boundary("named", [1, 2], 2, "wall")
    c, d = Boundary("named", [2, 3], 1, "wall"), Boundary("named", [3, 0], 1, "x")
    assert groups_of(a, b, c, d) == [
        ("wall", 1, [[0, 1], [2, 3]]),
        ("wall_2", 2, [[1, 2]]),
        ("x", 3, [[3, 0]]),
    ]


def test_the_other_side_of_a_weir_belongs_to_it():
    weir = Boundary("land", [0, 1], 24, partners=np.array([3, 2]))
    assert groups_of(weir)[0] == ("land_24", 24, [[0, 1], [1, 2], [2, 3], [3, 0]])


@given(mesh=random_meshes())
def test_the_rim_is_that_of_the_topology(mesh):
    topology = mesh.topology
    edges = rim(mesh.triangles, NO_QUADS, mesh.n_points)
    expected = topology.edges[topology.is_boundary_edge]
    assert sorted(np.sort(edges).tolist()) == expected.tolist()
    groups = edge_groups(mesh.triangles, NO_QUADS, (), mesh.n_points)
    assert len(groups[0].edges) == len(expected)
