"""A verdict finds every damage; a grid that verifies is what its definition says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import domains
import numpy as np
import pytest

from bsgplan.blocks import BlockGrid, lay_out
from bsgplan.blocks.placed import PlacedMesh
from bsgplan.blocks.verify import verified, verify
from bsgplan.errors import LayoutRefused
from bsgplan.sizing import SizeField


@pytest.fixture(scope="module")
def grid() -> BlockGrid:
    """A square with a hole, blocks of 16, one kept point."""
    keep = np.ones((12, 12), bool)
    keep[5:7, 5:7] = False
    mesh = domains.grid_mesh(12, 12, keep)
    return lay_out(SizeField(mesh, np.full(mesh.n_points, 0.5)), effort=4, kept=np.array([13 * 3 + 3]))


def test_a_sound_grid(grid: BlockGrid) -> None:
    """Every check is met, and the area is that of the square less the hole: all corners are there."""
    verdict = verify(grid)
    assert verdict.is_valid
    assert verdict.reason == ""
    assert verdict.area_difference == pytest.approx(0, abs=1e-12)
    assert verdict.deviation == pytest.approx(0, abs=1e-12)
    assert verdict.n_crossings == verdict.n_input_crossings == 0
    assert grid.mesh.area == pytest.approx(140)


def inverted(fine: PlacedMesh) -> PlacedMesh:
    """Moves an inner point across a triangle."""
    v = int(np.flatnonzero(~fine.topology.is_boundary)[-1])
    t = int(np.flatnonzero((fine.triangles == v).any(axis=1))[0])
    others = fine.triangles[t][fine.triangles[t] != v]
    points = fine.points.copy()
    points[v] = 2 * points[others].mean(axis=0) - points[v]
    return replace(fine, points=points)


def without_a_triangle(fine: PlacedMesh) -> PlacedMesh:
    """Takes an inner triangle out: a hole."""
    t = int(np.flatnonzero((fine.neighbours >= 0).all(axis=1) & (fine.codes < 0).all(axis=1))[0])
    return replace(fine, triangles=np.delete(fine.triangles, t, 0), codes=np.delete(fine.codes, t, 0))


def turned_over(fine: PlacedMesh) -> PlacedMesh:
    """Turns one triangle over."""
    triangles = fine.triangles.copy()
    triangles[7] = triangles[7, ::-1]
    return replace(fine, triangles=triangles)


def off_the_boundary(fine: PlacedMesh) -> PlacedMesh:
    """Shrinks the grid: no point on the boundary, the corners lost."""
    return replace(fine, points=0.7 * fine.points)


def slid_past(fine: PlacedMesh) -> PlacedMesh:
    """Swaps the arcs of two neighbours on a curve."""
    t, side = (
        int(rows[0])
        for rows in np.nonzero((fine.codes >= 0) & (fine.kinds[fine.triangles[:, [1, 2, 0]]] == 1))
    )
    a, b = fine.triangles[t, (side + 1) % 3], fine.triangles[t, (side + 2) % 3]
    arcs = fine.arcs.copy()
    arcs[[a, b]] = arcs[[b, a]]
    return replace(fine, arcs=arcs)


@pytest.mark.parametrize(
    ("damage", "name"),
    [
        (inverted, "inverted or flat triangles of the grid, the first near"),
        (without_a_triangle, "Euler characteristic of the grid off"),
        (turned_over, "edges of the grid with two triangles on one side"),
        (off_the_boundary, "corners, junctions and kept points missing in the grid"),
        (slid_past, "curves covered by the grid, off once"),
    ],
)
def test_every_damage_is_found(
    grid: BlockGrid, damage: Callable[[PlacedMesh], PlacedMesh], name: str
) -> None:
    """And the grid is refused with that reason."""
    broken = replace(grid, placed=damage(grid.placed))
    assert not verify(broken).is_valid
    assert name in verify(broken).reason
    with pytest.raises(LayoutRefused, match=f"no valid grid was found: {name}"):
        verified(broken)


def test_a_block_with_a_triangle_too_many_is_found(grid: BlockGrid) -> None:
    """Every block has side^2."""
    block = grid.block.copy()
    block[0] = block[-1]
    assert verify(replace(grid, block=block)).reason.startswith("blocks without their side^2 triangles: 2")


def test_a_distant_boundary_is_found(grid: BlockGrid) -> None:
    """The hole's points moved outwards by 2 leave the corners missing and the boundary far: both are told."""
    hole = grid.placed.topology.is_boundary & (np.abs(grid.placed.points).max(axis=1) < 0.3)
    points = grid.placed.points.copy()
    points[hole] = 0.0
    names = [check.name for check in verify(replace(grid, placed=replace(grid.placed, points=points))).checks
             if not check.is_met]  # fmt: skip
    assert any(name.startswith("corners") for name in names)
