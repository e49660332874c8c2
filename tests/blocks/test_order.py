"""Hilbert's curve by its definition, and meshes renumbered along it."""

from __future__ import annotations

from dataclasses import replace

import domains
import numpy as np
import pytest

from bsgplan.blocks.corners import find_corners
from bsgplan.blocks.domain import domain_of
from bsgplan.blocks.kinds import FROZEN
from bsgplan.blocks.order import hilbert, in_order
from bsgplan.blocks.placed import PlacedMesh, place

GRID = domain_of(domains.grid_mesh(12, 7))


@pytest.mark.parametrize("n", [2, 4, 16, 32])
def test_the_curve_goes_from_cell_to_neighbouring_cell(n: int) -> None:
    """Every cell once, each beside the one before, from one end of the lower side to the other."""
    cells = np.argwhere(np.ones((n, n), dtype=bool)).astype(float)
    way = cells[np.argsort(hilbert(cells))]
    assert len(np.unique(hilbert(cells))) == n * n
    assert (np.abs(np.diff(way, axis=0)).sum(axis=1) == 1).all()
    assert way[[0, -1]].tolist() == [[0, 0], [n - 1, 0]]


def test_one_point_and_a_line_have_an_order() -> None:
    """No extent, or none in one direction, is no error."""
    assert hilbert(np.array([[3.0, 4.0]])).tolist() == [0]
    assert len(set(hilbert(np.array([[0.0, 1.0], [0.5, 1.0], [1.0, 1.0]])).tolist())) == 3


def test_the_mesh_stays_what_it_is() -> None:
    """The same triangles with the same corners, codes and kinds, whatever their numbers."""
    mesh = shuffled()
    other = in_order(mesh)
    assert told(other) == told(mesh)
    assert (
        np.abs(np.diff(other.triangles, axis=1)).mean() < np.abs(np.diff(mesh.triangles, axis=1)).mean() / 2
    )


def test_frozen_vertices_keep_their_order() -> None:
    """Grafts count them: the k-th frozen vertex is the k-th of the rim."""
    mesh = shuffled()
    mesh = replace(mesh, kinds=np.where(np.arange(len(mesh.points)) % 3 == 0, FROZEN, mesh.kinds))
    other = in_order(mesh)
    is_frozen = other.kinds == FROZEN
    assert np.array_equal(other.points[is_frozen], mesh.points[mesh.kinds == FROZEN])


def shuffled() -> PlacedMesh:
    mesh = place(GRID, *find_corners(GRID, np.full(GRID.n_points, 0.2)))
    order = np.random.default_rng(5).permutation(len(mesh.points))
    name = np.empty_like(order)
    name[order] = np.arange(len(order))
    vertexwise = ("points", "kinds", "curves", "arcs", "goals", "hints")
    return replace(
        mesh,
        triangles=name[mesh.triangles],
        **{key: getattr(mesh, key)[order] for key in vertexwise},
    )


def told(mesh: PlacedMesh) -> list[tuple[object, ...]]:
    """Each triangle by what is true of it and its corners, numbers aside."""
    columns = [
        mesh.points,
        mesh.kinds[:, None],
        mesh.curves[:, None],
        mesh.arcs[:, None],
        mesh.goals[:, None],
    ]
    corners = np.column_stack(columns)[mesh.triangles].reshape(len(mesh.triangles), -1)
    return sorted(map(tuple, np.column_stack([corners, mesh.codes]).tolist()))
