"""Moved vertices: never a worse block, what shall stay stays, the numbers of NOTES.md, and the time."""

from __future__ import annotations

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pattern_strategies import COUNTS, RINGS

from bsgplan.errors import InvalidOption
from bsgplan.mesh import Mesh
from bsgplan.patterns import Pattern, Shape, best_length, best_spacing, move_vertices, realise
from bsgplan.patterns.moving import _quality_parts, signed_qualities


def straight(pattern, length=None):
    shape = Shape.rectangle(length or best_length(pattern).length)
    return realise(pattern, shape, best_spacing(pattern, shape).positions)


def q_min(realised):
    return float(signed_qualities(realised.points, realised.triangles).min())


@pytest.mark.parametrize(("text", "least"), [("7:4:1", 0.70), ("7:5:3:1", 0.75), ("7:4:2:1", 0.86)])
def test_the_papers_patterns_with_sliding_walls_and_free_length(text, least):
    assert q_min(move_vertices(straight(Pattern.parse(text)), stretches=True)) >= least


@given(COUNTS, st.floats(0.2, 3), st.booleans(), st.booleans())
@settings(max_examples=15, deadline=None)
def test_moves_never_lower_the_worst_block_and_keep_what_shall_stay(counts, length, slides, stretches):
    start = straight(Pattern(counts), length)
    moved = move_vertices(start, slides=slides, stretches=stretches)
    assert q_min(moved) >= q_min(start)
    assert (signed_qualities(moved.points, moved.triangles) > 0).all()
    assert moved.triangles is start.triangles
    first, last = start.front == 0, start.front == start.front[-1]
    assert (moved.points[first] == start.points[first]).all()
    assert (moved.points[last, 1] == start.points[last, 1]).all()
    assert np.ptp(moved.points[last, 0]) < 1e-12
    if not stretches:
        assert (moved.points[last] == start.points[last]).all()
    wall = np.abs(start.points[:, 1]) == 0.5
    assert (moved.points[wall, 1] == start.points[wall, 1]).all()
    if not slides:
        inner = wall & ~first & ~last
        assert (moved.points[inner] == start.points[inner]).all()
    again = move_vertices(start, slides=slides, stretches=stretches)
    assert (again.points == moved.points).all()


def test_more_freedom_does_no_harm_to_the_example_of_the_paper():
    start = straight(Pattern.parse("7:4:1"), 0.7)
    fixed, sliding = (q_min(move_vertices(start, slides=slides)) for slides in (False, True))
    free = q_min(move_vertices(start, stretches=True))
    assert 0.5 < fixed < sliding < free


@given(RINGS)
@settings(max_examples=10, deadline=None)
def test_flat_rings_move_their_inner_vertices(counts):
    counts = sorted(set(counts), reverse=True)
    if len(counts) < 2:
        return
    positions = np.linspace(0, 1, len(counts))
    shape = Shape(np.array([0.0, 1.0]), 2 * np.pi * np.array([2.0, 1.0]), True)
    start = realise(Pattern(tuple(counts), True), shape, positions)
    moved = move_vertices(start)
    assert q_min(moved) >= q_min(start)
    ends = (start.front == 0) | (start.front == len(counts) - 1)
    assert (moved.points[ends] == start.points[ends]).all()


def test_rings_in_space_and_curved_walls_are_refused():
    cylinder = Shape(np.array([0.0, 1.0]), np.array([6.0, 6.0]), True)
    ring = realise(Pattern.parse("6:6:6", is_closed=True), cylinder, np.array([0, 0.5, 1]))
    with pytest.raises(InvalidOption, match="in space"):
        move_vertices(ring)
    wedge = Shape(np.array([0.0, 1.0]), np.array([1.0, 2.0]))
    start = realise(Pattern.parse("3:4:5"), wedge, np.array([0, 0.5, 1]))
    with pytest.raises(InvalidOption, match="walls are not straight"):
        move_vertices(start)
    assert q_min(move_vertices(start, slides=False)) >= q_min(start)
    flat = Shape(np.array([0.0, 1.0]), 2 * np.pi * np.array([2.0, 1.0]), True)
    with pytest.raises(InvalidOption, match="no last front"):
        move_vertices(realise(Pattern((8, 4), True), flat, np.array([0.0, 1.0])), stretches=True)


def test_qualities_and_their_gradient():
    points, triangles = np.array([[0.1, 0.2], [0.9, 0.1], [0.6, 0.8]]), np.array([[0, 1, 2]])
    q, gradient = _quality_parts(points, triangles)
    assert q[0] == pytest.approx(Mesh(points, triangles).qualities[0])
    assert signed_qualities(points, triangles[:, ::-1])[0] == pytest.approx(-q[0])
    for corner in range(3):
        for axis in range(2):
            step = np.zeros((3, 2))
            step[corner, axis] = 1e-6
            change = (
                signed_qualities(points + step, triangles) - signed_qualities(points - step, triangles)
            )[0]
            assert change / 2e-6 == pytest.approx(gradient[0, corner, axis], abs=1e-6)


@pytest.mark.parametrize("text", ["7:5:3:1", "7:4:2:1", "12:9:7:5:3"])
def test_cpu_time_of_20_to_60_blocks(text):
    start = time.process_time()
    move_vertices(straight(Pattern.parse(text)), stretches=True)
    assert time.process_time() - start < 1
