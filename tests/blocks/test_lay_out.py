"""The verb on small domains by hand: every weak spot once; the same answer wherever and however often."""

from __future__ import annotations

from pathlib import Path

import domains
import numpy as np
import pytest
import shapely

from bsgplan.arrays import Bools, Ints
from bsgplan.blocks import BlockGrid, lay_out
from bsgplan.blocks.lack import POOR, qualities
from bsgplan.blocks.verify import verify
from bsgplan.errors import InvalidOption
from bsgplan.io import read
from bsgplan.mesh import Mesh, clean
from bsgplan.sizing import SizeField, size_field

SQUARE = domains.grid_mesh(12, 12)
X, Y = SQUARE.points.T
LOOP = domains.on_rectangle(SQUARE, 3, 9)


def laid_out(mesh: Mesh, h: float, tris_per_block: int = 16, *, effort: int = 4, is_straight: bool = False,
             interfaces: Bools | None = None, kept: Ints | None = None) -> BlockGrid:  # fmt: skip
    """The grid for one size everywhere."""
    size = SizeField(mesh, np.full(mesh.n_points, h))
    return lay_out(size, tris_per_block=tris_per_block, effort=effort, is_straight=is_straight,
                   interfaces=interfaces, kept=kept)  # fmt: skip


@pytest.mark.parametrize(
    "interfaces",
    [
        domains.edges_where(SQUARE, X == 6),
        domains.edges_where(SQUARE, (X == 6) & (Y <= 5)),
        domains.edges_where(SQUARE, (X == 6) & (Y >= 5) & (Y <= 7)),
        domains.edges_where(SQUARE, X == 6) | domains.edges_where(SQUARE, Y == 6),
        LOOP,
        LOOP | domains.edges_where(SQUARE, (X == 6) & (Y >= 9)),
        LOOP | domains.edges_where(SQUARE, (X == 6) & (Y >= 9) & (Y <= 10)),
        domains.on_rectangle(SQUARE, 5, 7),
    ],
    ids=[
        "across",
        "ends inside",
        "inside",
        "cross",
        "closed",
        "lollipop",
        "short tail",
        "smaller than a block",
    ],
)
def test_interfaces_are_kept(interfaces: Bools) -> None:
    """Edges of blocks run along them, the whole way: no triangle lies on both sides."""
    grid = laid_out(SQUARE, 0.6, interfaces=interfaces)
    lines = shapely.multilinestrings(shapely.linestrings(SQUARE.points[SQUARE.topology.edges[interfaces]]))
    sides = grid.placed.codes >= 0
    inner = sides & (grid.placed.neighbours >= 0)
    t, side = np.nonzero(inner & (grid.placed.codes % 2 == 0))
    ends = np.stack([grid.mesh.points[grid.placed.triangles[t, (side + k) % 3]] for k in (1, 2)], axis=1)
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum() == pytest.approx(shapely.length(lines))
    assert shapely.distance(lines, shapely.points(ends.reshape(-1, 2))).max() < 1e-9


@pytest.mark.parametrize("kept", [[78], [0, 5, 20, 77, 78, 79, 90], list(range(0, 169, 3))])
def test_kept_points_are_corners_of_blocks(kept: list[int]) -> None:
    """Inside, on the boundary, beside each other."""
    blocks = laid_out(SQUARE, 0.5, kept=np.array(kept)).layout.mesh
    found = np.array([np.linalg.norm(blocks.points - SQUARE.points[k], axis=1).min() for k in kept])
    assert found.max() < 1e-12


def weak_domains() -> dict[str, Mesh]:
    """Where layouts break first."""
    pinch, channel = np.zeros((12, 6), bool), np.zeros((16, 9), bool)
    pinch[:6, :3], pinch[6:, 3:] = True, True
    channel[:5], channel[-5:], channel[:, 4] = True, True, True
    box = shapely.box(0, 0, 10, 10)
    slit = SQUARE.points.copy()
    on = np.flatnonzero((X == 6) & (Y > 3) & (Y < 9))
    name = np.arange(len(slit))
    name[on] = len(slit) + np.arange(len(on))
    is_right = SQUARE.centroids[:, :1] > 6
    island, splinter = [(5, 5), (5.8, 5), (5.3, 5.7)], [(5, 5), (7.8, 5), (5.1, 5.1)]
    spike = [(0, 0), (10, 0), (10, 10), (5.2, 10), (5, 20), (4.8, 10), (0, 10)]
    bowtie = np.array([[0.0, 0], [1, 0], [0.5, 0.5], [0, 1], [1, 1]])
    return {
        "one triangle": clean(np.array([[0.0, 0], [1, 0], [0.4, 0.8]]), np.array([[0, 1, 2]])).mesh,
        "bowtie": clean(bowtie, np.array([[0, 1, 2], [2, 4, 3]])).mesh,
        "pinch": domains.grid_mesh(12, 6, pinch),
        "channel": domains.grid_mesh(16, 9, channel),
        "strip": domains.grid_mesh(30, 1),
        "island of three": domains.polygon_mesh(box.difference(shapely.Polygon(island)), 1, 1),
        "splinter": domains.polygon_mesh(box.difference(shapely.Polygon(splinter)), 0.7, 1),
        "spike": domains.polygon_mesh(shapely.Polygon(spike), 0.5, 3),
        "slit": Mesh(
            np.vstack([slit, slit[on]]), np.where(is_right, name[SQUARE.triangles], SQUARE.triangles)
        ),
    }


@pytest.mark.parametrize("name", weak_domains())
@pytest.mark.parametrize("coarse", [0.7, 3.0])
def test_weak_spots_get_a_valid_grid(name: str, coarse: float) -> None:
    """Ears, islands of three edges, channels of one triangle, slits, wanted blocks larger than all of it."""
    mesh = weak_domains()[name]
    grid = laid_out(mesh, coarse * float(mesh.edge_lengths.mean()))
    assert verify(grid).is_valid
    assert qualities(grid.placed).min() > 0


def test_fjords_one_triangle_wide_carry_blocks(meshes: Path) -> None:
    """Blocks across them are as small as they are wide: no more triangles are poor than in the input."""
    mesh = read(meshes / "north_sea.msh").mesh
    grid = lay_out(size_field(mesh), tris_per_block=16, seed=7)
    assert verify(grid).is_valid
    quality = qualities(grid.placed)
    assert quality.min() > 0
    assert (quality < POOR).sum() <= (mesh.qualities < POOR).sum()


def test_the_same_seed_gives_the_same_layout() -> None:
    """Bit for bit; another seed another one."""
    size = SizeField(SQUARE, 0.4 + 0.05 * X)
    first, second = (lay_out(size, tris_per_block=4, effort=5, seed=3) for _ in range(2))
    assert np.array_equal(first.placed.points, second.placed.points)
    assert np.array_equal(first.placed.triangles, second.placed.triangles)
    other = lay_out(size, tris_per_block=4, effort=5, seed=4)
    assert other.placed.points.shape != first.placed.points.shape or not np.array_equal(
        other.placed.points, first.placed.points
    )


@pytest.mark.parametrize(
    ("scale", "shift"), [(1.0, (4096.0, -512.0)), (2.0**-20, (0.0, 0.0)), (2.0**15, (0.0, 0.0))]
)
def test_place_and_unit_do_not_matter(scale: float, shift: tuple[float, float]) -> None:
    """Powers of two change no digit: the same blocks, moved and scaled."""
    own = lay_out(SizeField(SQUARE, 0.4 + 0.05 * X), tris_per_block=16, effort=4, seed=3)
    mesh = Mesh(SQUARE.points * scale + shift, SQUARE.triangles)
    other = lay_out(SizeField(mesh, scale * (0.4 + 0.05 * X)), tris_per_block=16, effort=4, seed=3)
    assert np.array_equal(own.layout.mesh.triangles, other.layout.mesh.triangles)
    assert other.mesh.points == pytest.approx(own.mesh.points * scale + shift, rel=1e-9)


def test_no_square_is_refused() -> None:
    """17 triangles make no block."""
    with pytest.raises(InvalidOption, match="17 triangles per block is no square"):
        laid_out(SQUARE, 0.5, 17)
