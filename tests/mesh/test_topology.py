"""Edges, fans, pinches, loops and genus: by hand, against slow twins, under rewriting."""

from __future__ import annotations

import numpy as np
import pytest
import reference
from hypothesis import given
from hypothesis import strategies as st
from predicates import assert_identity_holds, assert_is_mesh
from strategies import meshes, rewritings

from bsgplan.errors import InvalidMesh
from bsgplan.mesh import Mesh, clean
from bsgplan.mesh.irregularity import genus, mesh_irregularity
from bsgplan.mesh.topology import topology

TRIANGLE = np.array([[0.0, 0], [1, 0], [0, 1]])
TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


def annulus(n: int) -> Mesh:
    """Two rings of n vertices joined by 2 n triangles."""
    angle = 2 * np.pi * np.arange(n) / n
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    i, j = np.arange(n), (np.arange(n) + 1) % n
    return Mesh(
        np.vstack([ring, 2 * ring]),
        np.vstack([np.column_stack([i, n + i, j]), np.column_stack([j, n + i, n + j])]),
    )


def torus(n: int, m: int) -> Mesh:
    """A regular triangulation of a torus: every vertex has valence 6."""
    u, v = (k.ravel() for k in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
    a, b = 2 * np.pi * u / n, 2 * np.pi * v / m
    points = np.column_stack([(3 + np.cos(b)) * np.cos(a), (3 + np.cos(b)) * np.sin(a), np.sin(b)])

    def at(u, v):
        return (u % n) * m + v % m

    lower = np.column_stack([at(u, v), at(u + 1, v), at(u + 1, v + 1)])
    upper = np.column_stack([at(u, v), at(u + 1, v + 1), at(u, v + 1)])
    return Mesh(points, np.vstack([lower, upper]))


def test_one_triangle():
    mesh = Mesh(TRIANGLE, [[0, 1, 2]])
    topo = mesh.topology
    assert topo.edges.tolist() == [[0, 1], [0, 2], [1, 2]]
    assert (topo.n_components, topo.n_pinches, topo.n_boundary_loops, topo.euler_characteristic) == (
        1,
        0,
        1,
        1,
    )
    assert mesh.irregularity.total == -6
    assert mesh.qualities.tolist() == pytest.approx([np.sqrt(3) / 2])


def test_tetrahedron_is_a_sphere():
    points = np.vstack([np.zeros(3), np.eye(3)])
    mesh = Mesh(points, TETRAHEDRON)
    assert mesh.topology.n_boundary_loops == 0
    assert mesh.topology.euler_characteristic == 2
    assert genus(mesh.topology).tolist() == [0]
    assert mesh.irregularity.total == -12


def test_annulus_has_two_loops_and_no_irregularity():
    mesh = annulus(12)
    assert (mesh.topology.n_boundary_loops, mesh.topology.euler_characteristic) == (2, 0)
    assert genus(mesh.topology).tolist() == [0]
    assert (mesh.irregularity.positive, mesh.irregularity.negative) == (0, 0)


def test_torus_has_genus_one_and_needs_no_irregular_vertex():
    mesh = torus(7, 5)
    assert (mesh.topology.n_boundary_loops, mesh.topology.euler_characteristic) == (0, 0)
    assert genus(mesh.topology).tolist() == [1]
    assert not mesh.vertex_irregularity.any()


def test_two_triangles_at_a_vertex_are_a_pinch():
    points = np.array([[0.0, 0], [1, -1], [1, 1], [-1, 1], [-1, -1]])
    mesh = Mesh(points, [[0, 1, 2], [0, 3, 4]])
    topo = mesh.topology
    assert (topo.n_components, topo.n_pinches, topo.n_boundary_loops, topo.euler_characteristic) == (
        2,
        1,
        2,
        1,
    )
    assert genus(topo).tolist() == [0, 0]
    assert_identity_holds(mesh)


def test_closed_fans_at_one_vertex_are_a_pinch() -> None:
    """Two tetrahedra tip to tip, and one on the rim of a triangle: fans without an end do not hide."""
    tips = np.vstack([TETRAHEDRON, np.where(TETRAHEDRON == 0, 0, TETRAHEDRON + 3)])
    topo = topology(tips, 7)
    assert (topo.n_pinches, topo.n_components, topo.n_boundary_loops) == (1, 2, 0)
    assert sorted(np.unique(topo.corner_fan)) == list(range(8))
    on_rim = topology(np.vstack([TETRAHEDRON, [[0, 4, 5]]]), 6)
    assert (on_rim.n_pinches, on_rim.n_boundary_loops) == (1, 1)


def test_fans_are_the_vertices_where_there_is_no_pinch() -> None:
    mesh = annulus(7)
    assert np.array_equal(mesh.topology.corner_fan, mesh.triangles)


def test_moebius_band_has_one_loop_and_the_identity_holds():
    """Not orientable, yet an honest surface: five triangles, one boundary."""
    cells = np.array([[0, 1, 2], [1, 2, 3], [2, 3, 4], [3, 4, 0], [4, 0, 1]])
    topo = topology(cells, 5)
    assert (topo.n_boundary_loops, topo.n_pinches, topo.euler_characteristic) == (1, 0, 0)
    assert mesh_irregularity(topo).total == 0


def test_quads_of_a_square_have_minus_four():
    i = np.arange(9).reshape(3, 3)
    cells = np.column_stack([i[:-1, :-1].ravel(), i[1:, :-1].ravel(), i[1:, 1:].ravel(), i[:-1, 1:].ravel()])
    topo = topology(cells, 9)
    assert (topo.n_boundary_loops, topo.euler_characteristic) == (1, 1)
    result = mesh_irregularity(topo)
    assert (result.positive, result.negative) == (0, -4)


def test_an_edge_of_three_triangles_is_refused_by_name():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]])
    with pytest.raises(InvalidMesh, match=r"\(0, 1\) in 3 cells"):
        Mesh(points, [[0, 1, 2], [0, 1, 3], [0, 1, 4]])


@given(meshes(max_side=6))
def test_fast_topology_agrees_with_its_slow_twin(mesh):
    cells = mesh.triangles.tolist()
    topo = mesh.topology
    slow = reference.edges(cells)
    assert sorted(slow) == [tuple(edge) for edge in topo.edges.tolist()]
    assert [sorted(slow[tuple(e)]) for e in topo.edges.tolist()] == [
        [c for c in pair if c >= 0] for pair in np.sort(topo.edge_cells, axis=1).tolist()
    ]
    assert topo.n_pinches == reference.n_pinches(cells)
    corner = topo.cells.ravel()
    after = np.roll(topo.cells, -1, axis=1).ravel()
    for edge, sides in zip(topo.edges.tolist(), topo.edge_sides.tolist(), strict=True):
        assert all(sorted((corner[s], after[s])) == edge for s in sides if s >= 0)
    inner = topo.edges[~topo.is_boundary_edge]
    for edge, pair, tips in zip(inner, topo.neighbours, topo.tips, strict=True):
        assert [set(cells[c]) - set(edge.tolist()) for c in pair] == [{t} for t in tips]
    others, of_edge, start = topo.links
    for v in range(topo.n_points):
        own = slice(start[v], start[v + 1])
        assert {tuple(sorted((v, w))) for w in others[own].tolist()} == {e for e in slow if v in e}
        assert all(v in topo.edges[e] for e in of_edge[own])
    assert topo.n_boundary_loops == reference.n_boundary_loops(cells)
    links = [(c[0], c[1]) for c in slow.values() if len(c) == 2]
    assert topo.n_components == len(reference.components(set(range(len(cells))), links))
    assert mesh.vertex_irregularity.tolist() == reference.valence_irregularity(cells, mesh.n_points)


@given(meshes())
def test_the_identity_holds_on_random_meshes(mesh):
    assert_is_mesh(mesh)
    assert_identity_holds(mesh)
    assert (genus(mesh.topology) == 0).all()  # a planar mesh has no handle


@given(st.data())
def test_nothing_depends_on_numbering_or_orientation(data):
    mesh = data.draw(meshes())
    points, triangles = data.draw(rewritings(mesh))
    other = clean(points, triangles).mesh
    for name in ("n_components", "n_pinches", "n_boundary_loops", "euler_characteristic"):
        assert getattr(other.topology, name) == getattr(mesh.topology, name)
    assert other.irregularity == mesh.irregularity
    assert sorted(other.qualities) == pytest.approx(sorted(mesh.qualities))
    assert other.area == pytest.approx(mesh.area)
