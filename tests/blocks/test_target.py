"""The wanted block edge: what a block sees of a size field, and which gradients it may follow."""

from __future__ import annotations

import domains
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.blocks.domain import Domain, domain_of
from bsgplan.blocks.target import COST, SLOPES, SPREAD, _seen, target_of
from bsgplan.mesh.operators import vertex_areas
from bsgplan.sizing import SizeField

SQUARE = domain_of(domains.grid_mesh(40, 40))
X, Y = SQUARE.points.T


def waves(domain: Domain, n: int, share: float) -> np.ndarray:
    """One and some cosine of n half waves across the domain, flat at its walls."""
    x = domain.points[:, 0]
    return np.asarray(1 + share * np.cos(n * np.pi * (x - x.min()) / np.ptp(x)))


@given(size=st.floats(0.03, 0.5))
def test_blocks_see_one_size_as_it_is(size: float) -> None:
    """A mean of equal sizes."""
    assert _seen(SQUARE, np.full(SQUARE.n_points, size)) == pytest.approx(size)


@pytest.mark.parametrize("n", [1, 2, 4])
def test_blocks_see_waves_of_the_density_damped(n: int) -> None:
    """Diffusion over l damps cos(k x) to S = 1 / (1 + k^2 l^2), gently to 2 S - S^2: the closed form."""
    base, share = 0.25, 0.01
    seen = _seen(SQUARE, base * waves(SQUARE, n, share) ** -0.5)
    once = 1 / (1 + SPREAD * (base * n * np.pi) ** 2)
    damped = share * (2 * once - once**2)
    assert seen**-2 * base**2 == pytest.approx(waves(SQUARE, n, damped), abs=0.1 * share)
    assert np.ptp(seen**-2 * base**2) == pytest.approx(2 * damped, rel=0.02)


@given(slope=st.floats(-0.5, 0.5), least=st.floats(0.05, 0.2))
def test_what_blocks_see_asks_for_as_many_of_them(slope: float, least: float) -> None:
    """The integral of the density is kept to rounding, and no size lies beyond those there are."""
    length = least + np.abs(slope) * (X - X.min())
    seen = _seen(SQUARE, length)
    area = vertex_areas(SQUARE.mesh)
    assert area @ seen**-2 == pytest.approx(area @ length**-2)
    assert seen.min() >= 0.99 * length.min()
    assert seen.max() <= 1.01 * length.max()


@pytest.mark.parametrize("slope", [0.05, 0.2, 0.3])
def test_on_smooth_domains_the_limit_of_the_gradient_costs_little(slope: float) -> None:
    """The tightest bound that costs at most COST: the next tighter one costs more."""
    mesh = domains.grid_mesh(40, 40)
    h = 0.5 + slope * np.abs(mesh.points - 20.0).max(axis=1)
    target = target_of(domain_of(mesh), SizeField(mesh, h), 4)
    blocks = target.blocks
    assert target.raggedness == 0
    at = SLOPES.index(target.gradient_limit)
    assert blocks["gradient"] <= COST * blocks["resolution"] or at == len(SLOPES) - 1
    if at:
        tighter = target_of(domain_of(mesh), SizeField(mesh, h), 4, gradient_limit=SLOPES[at - 1])
        assert tighter.blocks["gradient"] > COST * tighter.blocks["resolution"]


@pytest.mark.parametrize("slope", [0.3, 0.4, 0.5])
def test_smoothed_sizes_are_limited_as_smoothed(slope: float) -> None:
    """Ridges too steep for blocks in a box whose walls carry every edge: the boundary costs nothing more.

    The limit of the gradient used to be judged, and its blocks told, by the sizes as they were.
    """
    mesh = domains.grid_mesh(40, 40)
    h = 0.4 + slope * np.abs(mesh.points[:, 0] % 10 - 5)
    blocks = target_of(domain_of(mesh), SizeField(mesh, h), 4).blocks
    assert blocks["gradient"] == pytest.approx(blocks["boundary"], rel=1e-9)
