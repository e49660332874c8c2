"""Subdivision against closed forms: counts, the affine lattice, nodes shared and snapped."""

from __future__ import annotations

from dataclasses import replace

import domains
import numpy as np
import pytest
import shapely

from bsgplan.blocks.corners import find_corners
from bsgplan.blocks.curve_places import CurvePlaces
from bsgplan.blocks.domain import domain_of
from bsgplan.blocks.outline import rounds
from bsgplan.blocks.placed import PlacedMesh, place
from bsgplan.blocks.subdivide import subdivide

HOLED = domain_of(
    domains.polygon_mesh(shapely.box(0, 0, 5, 4).difference(shapely.Point(2, 2).buffer(1)), 0.9, 5)
)


@pytest.mark.parametrize("side", [1, 2, 3, 8])
@pytest.mark.parametrize("snap", [False, True])
def test_counts_are_the_closed_form(side: int, snap: bool) -> None:
    """V + (s - 1) E + (s - 1)(s - 2)/2 F nodes, an outline of s times as many edges."""
    blocks = _blocks()
    cut = subdivide(
        HOLED, blocks, side, np.zeros(HOLED.n_points), bend=np.full(len(blocks.topology.edges), float(snap))
    )
    n_edges, n_blocks = len(blocks.topology.edges), len(blocks.triangles)
    inside = (side - 1) * (side - 2) // 2
    assert len(cut.mesh.points) == len(blocks.points) + (side - 1) * n_edges + inside * n_blocks
    assert np.bincount(cut.block).tolist() == [side**2] * n_blocks
    fine = cut.mesh.topology
    assert len(fine.edges) == side * n_edges + 3 * side * (side - 1) // 2 * n_blocks
    assert fine.euler_characteristic == blocks.topology.euler_characteristic
    assert fine.is_boundary_edge.sum() == side * blocks.topology.is_boundary_edge.sum()
    assert ((cut.mesh.codes >= 0) & (cut.mesh.neighbours < 0)).sum() == fine.is_boundary_edge.sum()
    up = np.bincount(cut.i[cut.block == 0] + cut.j[cut.block == 0], minlength=side)
    assert up.tolist() == [k + 1 + (k + 1 if k < side - 1 else 0) for k in range(side)]


def test_straight_blocks_are_affine_lattices() -> None:
    """Each triangle is the block shrunk by s, upside down or not, at its place (i, j)."""
    side, blocks = 4, _blocks()
    cut = subdivide(HOLED, blocks, side, np.zeros(HOLED.n_points), bend=np.zeros(len(blocks.topology.edges)))
    a, b, c = blocks.points[blocks.triangles[cut.block]].swapaxes(0, 1)
    corner = a + (cut.i[:, None] * (b - a) + cut.j[:, None] * (c - a)) / side
    first = cut.mesh.points[cut.mesh.triangles[:, 0]]
    is_up = np.linalg.norm(first - corner, axis=1) < 1e-12
    assert is_up.sum() == len(blocks.triangles) * side * (side + 1) // 2
    assert first[~is_up] == pytest.approx((corner + (b - a) / side)[~is_up], abs=1e-12)
    areas = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    p, q, r = cut.mesh.points[cut.mesh.triangles].swapaxes(0, 1)
    own = (q - p)[:, 0] * (r - p)[:, 1] - (q - p)[:, 1] * (r - p)[:, 0]
    assert own == pytest.approx(areas / side**2)


def test_snapped_nodes_lie_on_their_curves_and_within_them() -> None:
    """Nodes of a side across the start of a closed curve too: arcs run past the end of no curve."""
    blocks = _blocks()
    cut = subdivide(HOLED, blocks, 4, np.zeros(HOLED.n_points), bend=np.ones(len(blocks.topology.edges))).mesh
    on = np.flatnonzero(cut.topology.is_boundary)
    places = CurvePlaces(HOLED, np.zeros(HOLED.n_points))
    assert places.points(cut.curves[on], cut.arcs[on]) == pytest.approx(cut.points[on], abs=1e-12)
    assert (cut.arcs[on] >= 0).all()
    assert (cut.arcs[on] < HOLED.curve_lengths[cut.curves[on]]).all()
    assert rounds(HOLED, cut) == pytest.approx(np.ones(2))
    from_start = subdivide(
        HOLED, _turned(blocks), 4, np.zeros(HOLED.n_points), bend=np.ones(len(blocks.topology.edges))
    ).mesh
    assert (from_start.arcs < HOLED.curve_lengths.max()).all()


def _turned(blocks: PlacedMesh) -> PlacedMesh:
    """The same blocks, those on curves moved half an edge on, so that a side spans each curve's start."""
    curve = np.maximum(blocks.curves, 0)
    arcs = np.where(blocks.curves >= 0, (blocks.arcs + 0.05) % HOLED.curve_lengths[curve], blocks.arcs)
    return replace(blocks, arcs=arcs)


def _blocks() -> PlacedMesh:
    is_corner, turning = find_corners(HOLED, np.full(HOLED.n_points, 0.2))
    return place(HOLED, is_corner, turning)
