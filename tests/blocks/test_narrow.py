"""Where water is narrow: ears of sharp bays, channels one triangle wide, and what they cost all others."""

from __future__ import annotations

from dataclasses import replace

import domains
import numpy as np
import pytest

from bsgplan.blocks.corners import find_corners
from bsgplan.blocks.domain import Domain, domain_of
from bsgplan.blocks.ease import eased
from bsgplan.blocks.gridded import gridded, unbent
from bsgplan.blocks.kinds import INTERIOR
from bsgplan.blocks.lack import POOR, merit, qualities
from bsgplan.blocks.layout import BlockLayout
from bsgplan.blocks.limits import CHANNEL, channel_limit
from bsgplan.blocks.placed import PlacedMesh, place
from bsgplan.blocks.smooth import smooth
from bsgplan.blocks.subdivide import subdivide
from bsgplan.blocks.target import STRETCH, target_of
from bsgplan.mesh import Mesh
from bsgplan.sizing import SizeField

SIDE = 4


@pytest.mark.parametrize("degrees", [4.0, 8.0])
def test_one_triangle_takes_the_ear_of_a_sharp_bay(degrees: float) -> None:
    """s^2 triangles like the block are all poor; the tip alone has to be, at best as an isosceles one."""
    domain, fine = ear(degrees)
    assert (qualities(fine) < POOR).sum() == SIDE**2
    quality = qualities(eased(domain, fine, np.full(domain.n_points, np.log(0.25))))
    assert quality.min() > 0
    assert (quality < POOR).sum() == 1
    angle = np.radians(degrees)
    best = np.sqrt(3) * np.sin(angle) / (1 + 2 * np.sin(angle / 2) ** 2)
    assert 0.5 * best < quality.min() <= best + 1e-9


def test_an_ear_does_not_keep_the_others_from_being_smoothed() -> None:
    """The least quality is the ear's and cannot rise: the square beside it relaxed for it was thrown away."""
    square, wedge = domains.grid_mesh(8, 8), np.array([[20.0, 0.0], [30.0, -0.2], [30.0, 0.2]])
    mesh = Mesh(
        np.concatenate([square.points, wedge]),
        np.concatenate([square.triangles, square.n_points + np.array([[0, 1, 2]])]),
    )
    domain = domain_of(mesh)
    start = placed(domain, 0.02)
    random = np.random.default_rng(3)
    shift = random.uniform(-0.2, 0.2, start.points.shape) / domain.scale
    start = replace(start, points=start.points + np.where((start.kinds == INTERIOR)[:, None], shift, 0.0))
    result = smooth(domain, start, np.full(domain.n_points, np.log(1.1 / domain.scale)))
    of_square = slice(0, square.n_triangles)
    assert qualities(result).min() == qualities(start).min()
    assert qualities(result)[of_square].min() > qualities(start)[of_square].min() + 0.1
    assert merit(result) >= merit(start)


@pytest.mark.parametrize("aslant", [0.5, 2.0, 5.0])
def test_a_channel_is_as_wide_as_its_banks_are_apart(aslant: float) -> None:
    """Its edges run from bank to bank aslant and are longer than it is wide."""
    mesh = strip(aslant, width=1.0)
    domain = domain_of(mesh)
    across = channel_limit(domain, np.full(domain.n_points, 100.0)) * domain.scale
    inner = np.flatnonzero(np.abs(mesh.points[:, 0] - mesh.points[:, 0].mean()) < 4 * aslant)
    assert across[np.isin(domain.source, inner)] == pytest.approx(CHANNEL)


def test_no_floor_keeps_blocks_out_of_a_narrow_channel() -> None:
    """Ten times as narrow as the size of its triangles: the floor was a quarter of the block."""
    mesh = strip(5.0, width=1.0)
    target = target_of(domain_of(mesh), SizeField(mesh, np.full(mesh.n_points, 10.0)), SIDE)
    middle = np.abs(mesh.points[:, 0] - mesh.points[:, 0].mean()) < 20
    assert target.length[middle] == pytest.approx(STRETCH * CHANNEL)


def test_a_stretched_block_across_a_channel_has_the_promised_quality() -> None:
    """Base b and height w: b w / 2 the area that STRETCH CHANNEL w wants; mean ratio .74."""
    base, height = CHANNEL * STRETCH**2, 1.0
    squares = base**2 + 2 * ((base / 2) ** 2 + height**2)
    assert 2 * np.sqrt(3) * base * height / squares == pytest.approx(0.74, abs=0.01)


def test_sides_stay_bent_where_straight_ones_do_not_help() -> None:
    """The ear is poor either way: its grid lay off the boundary for nothing."""
    mesh = Mesh(np.array([[0.0, 0.0], [10.0, -0.3], [10.0, 0.3]]), np.array([[0, 1, 2]]))
    size = SizeField(mesh, np.full(3, 2.0))
    domain = domain_of(mesh)
    target = target_of(domain, size, SIDE)
    grid = gridded(BlockLayout(size, domain, target, place(domain, target.is_corner, target.turning)))
    assert qualities(grid.placed).min() < POOR
    assert np.array_equal(unbent(grid).placed.points, grid.placed.points)


def strip(step: float, *, width: float) -> Mesh:
    """Return a channel one triangle wide, a point every 2 step on its banks, by turns."""
    n = 24
    lower = np.column_stack([2 * step * np.arange(n), np.zeros(n)])
    upper = np.column_stack([2 * step * np.arange(n) + step, np.full(n, width)])
    i = np.arange(n - 1)
    triangles = np.concatenate(
        [np.column_stack([i, i + 1, n + i]), np.column_stack([i + 1, n + i + 1, n + i])]
    )
    return Mesh(np.concatenate([lower, upper]), triangles)


def ear(degrees: float) -> tuple[Domain, PlacedMesh]:
    """Return a bay that closes at that angle, and its one block cut into SIDE^2 triangles."""
    half = np.radians(degrees / 2)
    tip = np.array([[0.0, 0.0], [np.cos(half), -np.sin(half)], [np.cos(half), np.sin(half)]])
    domain = domain_of(Mesh(tip, np.array([[0, 1, 2]])))
    cut = subdivide(domain, placed(domain, 1.0), SIDE, np.zeros(3), bend=np.ones(3))
    return domain, cut.mesh


def placed(domain: Domain, size: float) -> PlacedMesh:
    return place(domain, *find_corners(domain, np.full(domain.n_points, size)))
