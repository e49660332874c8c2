"""Realised patterns: counts, quality, irregularity per front on the mesh itself; and their subdivision."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pattern_strategies import COUNTS, RINGS, shapes

from bsgplan.errors import InvalidOption
from bsgplan.mesh.mesh import Mesh
from bsgplan.mesh.quality import corner_edge_lengths, mean_ratio, signed_areas
from bsgplan.patterns import (
    Pattern,
    Shape,
    best_spacing,
    paper_spacing,
    realise,
    relative_irregularity,
    subdivide,
    vertex_irregularity_of_fronts,
)
from bsgplan.patterns.frustum import pattern_qualities
from bsgplan.patterns.realise import WIDEST


def rings(ratio=1.6, n_rings=3):
    ends = np.array([0, ratio ** (n_rings - 1) - 1])
    return Shape(ends, 2 * np.pi * (1 + ends), True)


def is_sector(shape):
    """Return True where the lengths are linear in the distance and the angle can be drawn."""
    slopes = np.diff(shape.lengths) / np.diff(shape.positions)
    return np.ptp(slopes) < 1e-9 and abs(slopes[0]) < WIDEST


@given(st.data(), st.booleans())
@settings(max_examples=60, deadline=None)
def test_a_realised_pattern_has_its_blocks_its_irregularity_and_its_quality(data, is_closed):
    pattern = Pattern(data.draw(RINGS if is_closed else COUNTS), is_closed)
    shape = data.draw(shapes(is_closed=is_closed))
    spacing = best_spacing(pattern, shape)
    realised = realise(pattern, shape, spacing.positions)
    assert len(realised.triangles) == pattern.n_blocks
    assert np.bincount(realised.front).tolist() == [count + (not is_closed) for count in pattern.counts]
    fronts = vertex_irregularity_of_fronts(realised)
    assert tuple(front.total for front in fronts) == pattern.front_irregularity
    expected = pattern_qualities(pattern, shape, spacing.positions)
    areas = np.abs(signed_areas(realised.points, realised.triangles))
    q = mean_ratio(areas, corner_edge_lengths(realised.points, realised.triangles))
    if not (is_closed or shape.is_straight or is_sector(shape)):
        return  # other open shapes are drawn at one mean angle
    assert q == pytest.approx(np.abs(expected), abs=1e-4)
    if realised.points.shape[1] == 2:
        signs = np.sign(signed_areas(realised.points, realised.triangles))
        assert (signs == np.sign(expected))[np.abs(expected) > 1e-6].all()


@given(COUNTS, st.floats(0.1, 5))
def test_an_open_pattern_tiles_its_rectangle(counts, length):
    shape = Shape.rectangle(length, 2.0)
    pattern = Pattern(counts)
    realised = realise(pattern, shape, paper_spacing(pattern, shape).positions)
    mesh = Mesh(realised.points, realised.triangles)  # refuses clockwise and non-manifold triangles
    assert mesh.area == pytest.approx(2 * length)


def test_both_signs_on_one_front_are_shown():
    realised = realise(Pattern.parse("7:4:2:1"), Shape.rectangle(0.7), np.array([0, 0.1, 0.3, 0.7]))
    fronts = vertex_irregularity_of_fronts(realised)
    assert [(front.positive, front.negative) for front in fronts] == [(0, -3), (2, -1), (1, 0), (1, 0)]


def test_equal_fronts_are_regular_open_and_closed():
    open_grid = realise(Pattern.parse("5:5:5"), Shape.rectangle(1.0), np.array([0, 0.5, 1.0]))
    closed = realise(Pattern.parse("12:12:12", is_closed=True), rings(), np.array([0, 0.6, 1.56]))
    assert not relative_irregularity(open_grid).any()
    assert not relative_irregularity(closed).any()


@pytest.mark.parametrize("is_inward", [False, True])
def test_a_radial_annulus_is_planar_and_counter_clockwise(is_inward):
    shape = rings()
    lengths = shape.lengths[::-1] if is_inward else shape.lengths
    realised = realise(
        Pattern.parse("12:12:12", is_closed=True),
        Shape(shape.positions, lengths, True),
        np.array([0, 0.96 if is_inward else 0.6, 1.56]),
    )
    mesh = Mesh(realised.points, realised.triangles)
    assert mesh.is_planar
    assert mesh.topology.euler_characteristic == 0
    assert mesh.area == pytest.approx(6 * np.sin(np.pi / 6) * (2.56**2 - 1))


def test_a_cylinder_is_in_space_and_seen_counter_clockwise_from_outside():
    shape = Shape(np.array([0.0, 2.0]), np.array([6.0, 6.0]), True)
    realised = realise(Pattern.parse("9:9:9", is_closed=True), shape, np.array([0.0, 1.0, 2.0]))
    assert realised.points.shape == (27, 3)
    a, b, c = realised.points[realised.triangles].swapaxes(0, 1)
    outward = (np.cross(b - a, c - a) * ((a + b + c) * [1, 1, 0])).sum(axis=1)
    assert (outward > 0).all()
    assert np.ptp(realised.points[:, 2]) == pytest.approx(2.0)


@given(st.data(), st.booleans(), st.integers(1, 6))
@settings(max_examples=40, deadline=None)
def test_subdivision_is_conforming_conserves_area_and_adds_no_irregular_vertex(data, is_closed, s):
    pattern = Pattern.parse("12:9:9", is_closed=True) if is_closed else Pattern(data.draw(COUNTS))
    shape = rings() if is_closed else Shape.rectangle(1.0)
    coarse = realise(pattern, shape, paper_spacing(pattern, shape).positions)
    points, triangles, block = subdivide(coarse.points, coarse.triangles, s)
    before, after = Mesh(coarse.points, coarse.triangles), Mesh(points, triangles)
    assert np.array_equal(points[: before.n_points], coarse.points)
    assert after.n_triangles == s * s * pattern.n_blocks
    assert np.bincount(block).tolist() == [s * s] * pattern.n_blocks
    assert after.area == pytest.approx(before.area)
    assert np.bincount(block, weights=after.areas) == pytest.approx(before.areas)
    assert after.qualities == pytest.approx(np.repeat(before.qualities, s * s))
    assert np.count_nonzero(after.topology.is_boundary_edge) == s * np.count_nonzero(
        before.topology.is_boundary_edge
    )
    assert after.topology.euler_characteristic == before.topology.euler_characteristic
    assert not after.vertex_irregularity[before.n_points :].any()
    assert np.array_equal(after.vertex_irregularity[: before.n_points], before.vertex_irregularity)


def test_subdivision_by_zero_is_refused():
    with pytest.raises(InvalidOption, match="subdivision 0 is below 1"):
        subdivide(np.eye(3), np.array([[0, 1, 2]]), 0)
