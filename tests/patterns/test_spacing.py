"""Front positions: the numbers of NOTES.md, the paper's figures, and never worse than what it starts from."""

from __future__ import annotations

import numpy as np
import pytest
import reference
from hypothesis import given, settings
from hypothesis import strategies as st
from pattern_strategies import COUNTS, RINGS, shapes

from bsgplan.errors import InvalidOption
from bsgplan.patterns import Pattern, Shape, best_spacing, best_spacings, paper_spacing
from bsgplan.patterns.alike import alike
from bsgplan.patterns.frustum import pattern_qualities
from bsgplan.patterns.placement import place
from bsgplan.patterns.spacing import spacing_at, uniform_spacing
from bsgplan.patterns.straight import straight_widths

LENGTHS = (0.25, 0.5, 0.75, 1, 1.5, 2, 3)
OVER_LENGTH = {
    "4:1": (0.433, 0.495, 0.433, 0.365, 0.266, 0.207, 0.141),
    "4:2:1": (0.371, 0.670, 0.866, 0.831, 0.693, 0.569, 0.408),
    "4:3:1": (0.310, 0.476, 0.500, 0.500, 0.491, 0.424, 0.311),
    "4:3:2:1": (0.300, 0.560, 0.756, 0.858, 0.822, 0.725, 0.553),
}
BEST_OVER_ALL_LENGTHS = {
    "7:4:1": 0.500,
    "7:5:3:1": 0.500,
    "7:2:1": 0.500,
    "7:3:1": 0.500,
    "7:3:2:1": 0.596,
    "7:4:2:1": 0.756,
    "7:6:5:4:3:2:1": 0.866,
}


@pytest.mark.parametrize("text", OVER_LENGTH)
def test_q_min_over_the_length(text):
    found = [best_spacing(Pattern.parse(text), Shape.rectangle(length)).q_min for length in LENGTHS]
    assert [round(q, 3) for q in found] == list(OVER_LENGTH[text])


def test_the_best_lengths_of_4_2_1_and_4_3_2_1():
    assert best_spacing(Pattern.parse("4:2:1"), Shape.rectangle(0.75)).q_min == pytest.approx(3**0.5 / 2)
    assert best_spacing(Pattern.parse("4:3:2:1"), Shape.rectangle(13 / 12)).q_min == pytest.approx(3**0.5 / 2)
    short, long = (
        [best_spacing(Pattern.parse(text), Shape.rectangle(length)).q_min for text in ("4:2:1", "4:3:2:1")]
        for length in (0.9, 1.0)
    )
    assert short[0] > short[1]
    assert long[0] < long[1]


@pytest.mark.parametrize("text", BEST_OVER_ALL_LENGTHS)
def test_best_over_all_lengths(text):
    pattern = Pattern.parse(text)
    found = max(best_spacing(pattern, Shape.rectangle(length)).q_min for length in np.linspace(0.3, 2, 681))
    assert round(found, 3) == BEST_OVER_ALL_LENGTHS[text]


def test_7_4_2_1_at_length_0_7():
    assert round(best_spacing(Pattern.parse("7:4:2:1"), Shape.rectangle(0.7)).q_min, 3) == 0.736


def test_figure_6b_and_its_better_optimum():
    pattern, shape = Pattern(tuple(range(40, 9, -1))), Shape.rectangle(2.0, 1.0)
    spacing = paper_spacing(pattern, shape)
    q = pattern_qualities(pattern, shape, spacing.positions)
    assert (len(q), round(q.min(), 3), round(q.mean(), 3)) == (1500, 0.790, 0.860)
    assert round(best_spacing(pattern, shape).q_min, 3) == 0.803


def test_figure_7b():
    pattern, shape = Pattern.parse("128:64:32:16:8:4:2:1"), Shape.rectangle(1.0)
    q = pattern_qualities(pattern, shape, paper_spacing(pattern, shape).positions)
    assert (len(q), round(q.min(), 3), round(q.mean(), 3)) == (381, 0.866, 0.867)
    assert best_spacing(pattern, shape).q_min >= q.min() - 1e-9


@given(COUNTS, st.floats(1e-6, 1e6), st.floats(1e-3, 1e3))
def test_straight_optimum_is_exact_and_scales(counts, length, scale):
    pattern = Pattern(counts)
    spacing = best_spacing(pattern, Shape.rectangle(length))
    scaled = best_spacing(pattern, Shape.rectangle(length * scale, scale))
    assert scaled.q_min == pytest.approx(spacing.q_min, rel=1e-6)
    assert spacing.is_straight
    (widths,) = straight_widths([counts], np.array([length]))
    assert widths.sum() == pytest.approx(length)
    for first, second in zip(range(len(widths) - 1), range(1, len(widths)), strict=True):
        for share in (-0.01, 0.01):  # no exchange of width between neighbours helps
            moved = widths.copy()
            moved[[first, second]] += share * min(widths[first], widths[second]) * np.array([1, -1])
            positions = np.concatenate([[0.0], np.cumsum(moved)])
            assert spacing_at(pattern, Shape.rectangle(length), positions).q_min <= spacing.q_min + 1e-9


@given(COUNTS, st.floats(0.1, 4))
@settings(max_examples=40, deadline=None)
def test_the_general_placement_agrees_with_the_closed_form_on_rectangles(counts, length):
    pattern, shape = Pattern(counts), Shape.rectangle(length)
    start = max(uniform_spacing(pattern, shape), paper_spacing(pattern, shape), key=lambda s: s.q_min)
    placed = spacing_at(pattern, shape, place(alike([pattern], [shape]), start.positions[None])[0])
    exact = best_spacing(pattern, shape).q_min
    assert start.q_min - 1e-9 <= placed.q_min <= exact + 1e-9
    assert placed.q_min >= exact - 0.01 - 0.05 * exact  # any counts at all; transitions below


def test_the_general_placement_is_within_a_hundredth_for_transitions():
    for text in ("4:2:1", "4:3:2:1", "7:4:2:1", "28:20:14:9:6:4", "3:5:2:7:7:1"):
        for length in (0.2, 0.5, 1.0, 3.0):
            pattern, shape = Pattern.parse(text), Shape.rectangle(length)
            start = paper_spacing(pattern, shape).positions
            placed = spacing_at(pattern, shape, place(alike([pattern], [shape]), start[None])[0])
            assert placed.q_min == pytest.approx(best_spacing(pattern, shape).q_min, abs=0.01)


@given(st.data(), st.booleans())
@settings(max_examples=60, deadline=None)
def test_the_best_spacing_is_valid_and_never_worse_than_uniform_or_paper(data, is_closed):
    pattern = Pattern(data.draw(RINGS if is_closed else COUNTS), is_closed)
    shape = data.draw(shapes(is_closed=is_closed))
    spacing = best_spacing(pattern, shape)
    assert np.isfinite(spacing.q_min)
    assert spacing.positions[0] == 0
    assert spacing.positions[-1] == shape.length
    assert (spacing.widths > 0).all()
    for other in (uniform_spacing(pattern, shape), paper_spacing(pattern, shape)):
        assert spacing.q_min >= other.q_min - 1e-9


def test_a_sixth_of_an_annulus_has_the_quality_of_the_whole():
    radii, turn = np.array([1.0, 1.35]), 2 * np.pi
    whole = Shape(radii - 1, turn * radii, is_closed=True)
    sixth = Shape(radii - 1, turn / 6 * radii)
    ring = best_spacing(Pattern((24, 12), is_closed=True), whole)
    assert best_spacing(Pattern((4, 2)), sixth).q_min == pytest.approx(ring.q_min, abs=1e-9)


def test_rings_of_a_wide_annulus_approach_equilateral_triangles():
    n, radius = 240, 100.0
    edge = 2 * np.pi * radius / n
    width = 4 * edge * 3**0.5 / 2
    shape = Shape(np.array([0, width]), 2 * np.pi * np.array([radius - width / 2, radius + width / 2]), True)
    spacing = best_spacing(Pattern((n,) * 5, is_closed=True), shape)
    assert spacing.q_min > 0.995


def test_rings_of_constant_count_follow_a_size_proportional_to_the_radius():
    pattern = Pattern.parse("12:12:12", is_closed=True)
    ratio = np.exp(3**0.5 / 2 * 2 * np.pi / 12)  # equilateral in log r and angle
    shape = Shape(np.array([0, ratio**2 - 1]), 2 * np.pi * np.array([1, ratio**2]), True)
    spacing = best_spacing(pattern, shape)
    assert pattern.irregularity.positive == 0
    assert spacing.q_min == pytest.approx(0.955, abs=0.001)
    assert spacing.positions[1] == pytest.approx(ratio - 1, abs=0.01)


def test_a_shape_counts_as_straight_up_to_a_tenth():
    ends = np.array([0.0, 1.0])
    assert Shape(ends, np.array([1.0, 1.09])).is_straight
    assert not Shape(ends, np.array([1.0, 1.11])).is_straight
    assert not Shape(ends, np.array([1.0, 1.0]), True).is_straight
    assert Shape(ends, np.array([1.0, 1.08])).height == pytest.approx(1.04)


@pytest.mark.parametrize(
    ("positions", "lengths"),
    [([0], [1]), ([0, 1], [1]), ([1, 2], [1, 1]), ([0, 0], [1, 1]), ([0, 1], [1, 0]), ([0, np.nan], [1, 1])],
)
def test_shapes_that_are_none_are_refused(positions, lengths):
    with pytest.raises(InvalidOption):
        Shape(np.array(positions, dtype=float), np.array(lengths, dtype=float))


def test_open_and_closed_do_not_mix():
    with pytest.raises(InvalidOption, match="pattern 4:3 is closed but the shape is open"):
        best_spacing(Pattern((4, 3), is_closed=True), Shape.rectangle(1.0))


@given(st.data(), st.booleans())
@settings(max_examples=25, deadline=None)
def test_many_at_once_are_placed_as_each_alone(data, is_closed):
    """Patterns of several lengths in shapes of their own, straight ones among them: no row sees another."""
    counts = data.draw(st.lists(RINGS if is_closed else COUNTS, min_size=2, max_size=7))
    patterns = [Pattern(c, is_closed) for c in counts]
    within = [data.draw(shapes(is_closed=is_closed)) for _ in counts]
    if not is_closed:
        within[0] = Shape.rectangle(2.0, 3.0)
    for many, pattern, shape in zip(best_spacings(patterns, within), patterns, within, strict=True):
        alone = best_spacing(pattern, shape)
        assert many.q_min == pytest.approx(alone.q_min, rel=1e-9, abs=1e-9)
        assert many.positions == pytest.approx(alone.positions, rel=1e-9, abs=1e-9 * shape.length)
        assert many.q_min == pytest.approx(pattern_qualities(pattern, shape, many.positions).min(), abs=1e-9)


@pytest.mark.parametrize(
    ("text", "is_closed"), [("2:1", False), ("7:4:1", False), ("9:7:4:2:1", False), ("12:9:6:6:5", True)]
)
@pytest.mark.parametrize("lengths", [(4.0, 1.0), (1.0, 2.0, 1.5), (2.0, 0.6, 0.5, 3.0)])
def test_the_placement_is_that_of_one_trial_at_a_time(text, is_closed, lengths):
    pattern = Pattern.parse(text, is_closed=is_closed)
    front_lengths = np.array(lengths) * (5 if is_closed else 1)
    shape = Shape(np.linspace(0, 1.2, len(lengths)), front_lengths, is_closed)
    start = uniform_spacing(pattern, shape).positions
    slow = reference.placed(pattern, shape, start.tolist())
    (fast,) = place(alike([pattern], [shape]), start[None])
    assert fast == pytest.approx(slow, abs=1e-6)
    before, after = (pattern_qualities(pattern, shape, x).min() for x in (start, fast))
    assert after >= before - 1e-9


def test_fronts_of_many_shapes_are_those_of_each():
    """Interpolation between the stations of each shape, its ends among them; none reads the next one's."""
    first = Shape(np.array([0.0, 1e-3, 5.0]), np.array([1.0, 3.0, 2.0]))
    second = Shape(np.array([0.0, 1e6]), np.array([7.0, 9.0]))
    both = alike([Pattern((2, 1))] * 2, [first, second])
    shares = np.array([0.0, 1e-4, 0.3, 1.0])
    positions = np.stack([shares * 5.0, shares * 1e6])
    found = both.front_lengths(positions, np.array([0, 1]))
    assert found[0] == pytest.approx(first.front_lengths(positions[0]))
    assert found[1] == pytest.approx(second.front_lengths(positions[1]))
    (alone,) = both.front_lengths(positions[1:], np.array([1]))
    assert alone == pytest.approx(found[1])
