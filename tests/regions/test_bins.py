"""Triangles shared out to bins of log size: by hand, and against points sown in the triangle."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from strategies import jittered

from bsgplan.regions.bins import _area_below, bin_edges, sums_over_bins
from bsgplan.sizing import SizeField

N_SOWN = 80


def test_halves_and_quarters_by_hand() -> None:
    """A triangle with sizes 0, 1, 2 has half of its area below 1, an eighth below 1/2."""
    low, middle, high = np.array([[0.0], [1.0], [2.0]])
    for level, share in ((0.0, 0.0), (0.5, 0.125), (1.0, 0.5), (1.5, 0.875), (2.0, 1.0)):
        assert _area_below(np.array([level]), low, middle, high) == pytest.approx([share])


@pytest.mark.parametrize(("middle", "share"), [(0.0, 0.75), (1.0, 0.25)])
def test_two_corners_of_one_size(middle: float, share: float) -> None:
    below = _area_below(np.array([0.5]), np.array([0.0]), np.array([middle]), np.array([1.0]))
    assert below == pytest.approx([share])


@given(st.floats(0, 1), st.floats(0, 1))
def test_the_share_is_that_of_points_sown_evenly(middle: float, level: float) -> None:
    u, v = (a.ravel() for a in np.meshgrid(*2 * [(np.arange(2 * N_SOWN) + 0.5) / (2 * N_SOWN)]))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    sown = np.mean(u * middle + v < level)
    found = _area_below(np.array([level]), np.array([0.0]), np.array([middle]), np.array([1.0]))
    assert found == pytest.approx([sown], abs=2.0 / N_SOWN)


@given(st.integers(0, 2**32 - 1), st.floats(-0.2, 0.2), st.floats(-0.2, 0.2))
def test_nothing_is_lost_and_each_bin_has_its_strip(seed: int, slope_x: float, slope_y: float) -> None:
    """Log size is linear in space: bins are strips of the rectangle, and hold as much area as points sown."""
    assume(np.hypot(slope_x, slope_y) > 1e-3)
    mesh = jittered(12, 9, seed)
    size = SizeField(mesh, np.exp(mesh.points @ [slope_x, slope_y]))
    label = np.zeros(mesh.n_triangles, dtype=np.int64)
    edges, first = bin_edges(size, label)
    (area,) = sums_over_bins(size, label, edges, first, [mesh.areas])
    assert area.sum() == pytest.approx(mesh.area)
    x, y = (a.ravel() for a in np.meshgrid((np.arange(440) + 0.5) / 40, (np.arange(320) + 0.5) / 40))
    sown = np.histogram(x * slope_x + y * slope_y, edges)[0] / 1600
    assert area == pytest.approx(sown, abs=0.02 * mesh.area)
