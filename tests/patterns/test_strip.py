"""Strips tile, are Delaunay, look the same from both ends, and have the widths of NOTES.md."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference import critical_table

from bsgplan.mesh.quality import corner_edge_lengths, mean_ratio, signed_areas
from bsgplan.patterns import (
    Pattern,
    Shape,
    best_width,
    realise,
    strip_quality,
    strip_triangles,
    vertex_irregularity_of_fronts,
    width_interval,
)
from bsgplan.patterns.frustum import mean_ratios
from bsgplan.patterns.strip import critical_turns, ring_turn, strip_table

COUNT = st.integers(1, 40)
RING = st.integers(3, 40)
WIDTH = st.floats(0.05, 5)

BEST = [
    ("1:1", 0.8660, 1),
    ("2:1", 0.8660, 1 / 2),
    ("3:2", 0.8660, 1 / 3),
    ("4:3", 0.8660, 1 / 4),
    ("9:8", 0.8660, 1 / 9),
    ("3:1", 0.5000, 0.5774),
    ("4:1", 0.5000, 0.4330),
    ("5:3", 0.7206, 0.2404),
    ("7:4", 0.7559, 0.1637),
    ("7:5", 0.7777, 0.1591),
    ("7:1", 0.2402, 0.5151),
]


def strip_points(m, n, width=1.0, height=1.0):
    low, high = np.arange(m + 1) * height / m, np.arange(n + 1) * height / n
    return np.column_stack([np.repeat([0, width], [m + 1, n + 1]), np.concatenate([low, high])])


@pytest.mark.parametrize(("text", "q", "width"), BEST)
def test_best_quality_and_width_of_a_strip(text, q, width):
    found_width, found_q = best_width(*Pattern.parse(text).counts)
    assert found_q == pytest.approx(q, abs=5e-5)
    assert found_width == pytest.approx(width, abs=5e-5)


def test_one_by_one_is_the_unit_square_of_figure_1():
    assert strip_triangles(1, 1).tolist() == [[0, 2, 1], [2, 3, 1]]


@given(COUNT, COUNT, WIDTH, WIDTH)
def test_triangles_tile_the_strip(m, n, width, height):
    areas = signed_areas(strip_points(m, n, width, height), strip_triangles(m, n))
    assert len(areas) == m + n
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(width * height)


@given(COUNT, COUNT, WIDTH)
def test_strips_are_delaunay(m, n, width):
    points = strip_points(m, n, width)
    for corners in points[strip_triangles(m, n)]:
        centre = np.linalg.solve(
            2 * (corners[1:] - corners[0]), (corners[1:] ** 2).sum(1) - (corners[0] ** 2).sum()
        )
        radius = np.linalg.norm(corners[0] - centre)
        assert np.linalg.norm(points - centre, axis=1).min() >= radius * (1 - 1e-9)


@given(COUNT, COUNT)
def test_a_strip_turned_by_180_degrees_is_the_strip_of_swapped_counts(m, n):
    turned = m + n + 1 - strip_triangles(m, n)
    there = {frozenset(triangle) for triangle in turned.tolist()}
    assert there == {frozenset(triangle) for triangle in strip_triangles(n, m).tolist()}


@given(COUNT, COUNT)
def test_the_front_that_loses_elements_has_no_positive_vertex(m, n):
    realised = realise(Pattern((m, n)), Shape.rectangle(1.0), np.array([0.0, 1.0]))
    first, second = vertex_irregularity_of_fronts(realised)
    assert (first.total, second.total) == (n - m, m - n)
    fine, coarse = (first, second) if m >= n else (second, first)
    assert fine.positive == 0
    assert coarse.negative == 0


@given(COUNT, COUNT, WIDTH, WIDTH)
def test_the_closed_form_is_the_quality_of_the_triangles(m, n, width, height):
    points, triangles = strip_points(m, n, width, height), strip_triangles(m, n)
    q = mean_ratio(signed_areas(points, triangles), corner_edge_lengths(points, triangles))
    assert strip_quality(m, n, width, height=height) == pytest.approx(q.min())


@given(COUNT, COUNT, st.floats(0.01, 1), WIDTH, st.booleans())
def test_a_width_is_in_the_interval_exactly_where_it_reaches_the_quality(m, n, share, width, is_ring):
    m, n = (m + 2, n + 2) if is_ring else (m, n)
    best, best_q = best_width(m, n, is_closed=is_ring)
    assert strip_quality(m, n, width, is_closed=is_ring) <= best_q + 1e-12
    low, high = width_interval(m, n, share * best_q * (1 - 1e-9), is_closed=is_ring)
    assert low <= best <= high
    q = strip_quality(m, n, width, is_closed=is_ring) - share * best_q
    assert abs(q) < 1e-6 or (q > 0) == (low <= width <= high)
    assert width_interval(m, n, best_q * 1.01) == (np.inf, -np.inf) or is_ring


@given(RING, RING)
def test_a_closed_strip_uses_every_edge_twice_inside_and_once_on_its_rings(m, n):
    triangles = strip_triangles(m, n, is_closed=True)
    edges = np.sort(
        np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1
    )
    edges, times = np.unique(edges, axis=0, return_counts=True)
    assert len(triangles) == m + n
    assert np.count_nonzero(times == 1) == m + n
    assert np.count_nonzero(times == 2) == m + n


@given(RING, RING)
def test_turned_rings_have_no_ties_and_are_no_worse_than_aligned_ones(m, n):
    _, base, midpoint, apex = strip_table(m, n, is_closed=True)
    other = np.repeat([1 / n, 1 / m], [m, n])
    distance = np.abs(apex - midpoint)
    assert (distance < other / 2 * (1 - 1e-9)).all()
    assert 0 <= ring_turn(m, n) < 1 / max(m, n)
    aligned = best_width(m, n)[1]
    assert best_width(m, n, is_closed=True)[1] >= aligned - 1e-12 or m == 1
    assert base.sum() == pytest.approx(2)


@given(COUNT, COUNT, WIDTH, WIDTH, WIDTH)
def test_the_worst_triangle_is_critical_for_any_lengths(m, n, first, second, width):
    sizes = [np.array(v) for v in (first, second, width)]
    every = mean_ratios(strip_table(m, n), *sizes, is_closed=False)
    critical = mean_ratios(critical_table(m, n), *sizes, is_closed=False)
    assert critical.min() == pytest.approx(every.min(), rel=1e-9)
    assert critical_table(m, n).shape[1] <= m + n


@given(COUNT, COUNT, st.booleans())
def test_critical_turns_are_those_of_the_critical_triangles(m, n, is_closed):
    side, _, midpoint, apex = critical_table(m, n, is_closed=is_closed)
    turns = np.abs(apex - midpoint)
    for found, own in zip(critical_turns(m, n, is_closed=is_closed), (side < 0.5, side > 0.5), strict=True):
        assert found.tolist() == [turns[own].min(), turns[own].max()]


@given(RING, RING, st.floats(1, 5), st.floats(1.01, 4))
def test_the_worst_triangle_of_a_planar_annulus_is_critical(m, n, first, ratio):
    second = first * ratio
    for sizes in ((first, second), (second, first)):
        lengths = [np.array(2 * np.pi * size) for size in sizes]
        width = np.array(second - first)
        every = mean_ratios(strip_table(m, n, is_closed=True), *lengths, width, is_closed=True)
        critical = mean_ratios(critical_table(m, n, is_closed=True), *lengths, width, is_closed=True)
        assert critical.min() == pytest.approx(every.min(), rel=1e-9, abs=1e-9)
