"""Orientation and crossings against exact fractions and by hand."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.blocks.orientation import cross_properly, orientation
from bsgplan.blocks.outline import area_inside, crossings

coordinates = st.one_of(
    st.integers(-3, 3).map(float), st.floats(-1.0, 1.0), st.integers(0, 8).map(lambda k: 0.1 + k * 2.0**-55)
)


@given(st.lists(coordinates, min_size=6, max_size=6))
def test_orientation_is_that_of_fractions(values: list[float]) -> None:
    """Also where the determinant is all rounding."""
    (ax, ay), (bx, by), (cx, cy) = np.array([Fraction(v) for v in values]).reshape(3, 2)
    exact = (ax - cx) * (by - cy) - (ay - cy) * (bx - cx)
    a, b, c = np.array(values).reshape(3, 1, 2)
    assert orientation(a, b, c)[0] == (exact > 0) - (exact < 0)


@given(st.integers(0, 2**32 - 1))
def test_crossings_are_those_of_all_pairs(seed: int) -> None:
    """The tree finds what trying every pair finds; segments that share an end do not cross."""
    random = np.random.default_rng(seed)
    points = random.integers(0, 6, (12, 2)).astype(float)  # many touch and overlap
    segments = random.permuted(np.tile(np.arange(12), (9, 1)), axis=1)[:, :2]
    first, second = np.triu_indices(9, 1)
    is_shared = (segments[first][:, :, None] == segments[second][:, None]).any(axis=(1, 2))
    is_crossing = cross_properly(points, segments[first], segments[second]) & ~is_shared
    expected = set(zip(first[is_crossing].tolist(), second[is_crossing].tolist(), strict=True))
    assert {tuple(pair) for pair in crossings(points, segments).tolist()} == expected


def test_segments_that_touch_do_not_cross_properly() -> None:
    """A plain cross does; an end on the other segment, a common end, the same line do not."""
    points = np.array([[0.0, 0], [2, 2], [0, 2], [2, 0], [1, 1], [3, 3]])
    first = np.array([[0, 1], [0, 1], [0, 1], [0, 1]])
    second = np.array([[2, 3], [2, 4], [1, 3], [4, 5]])
    assert cross_properly(points, first, second).tolist() == [True, False, False, False]


def test_area_inside_a_square_with_a_hole() -> None:
    """The hole does not count; a figure eight is two loops."""
    square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [1, 2], [2, 2], [2, 1]])
    loops = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]])
    assert area_inside(square, loops, is_crossing=False) == 15.0
    eight = np.array([[0.0, 0], [2, 2], [2, 0], [0, 2]])
    assert area_inside(eight, loops[:4], is_crossing=True) == 2.0
