"""Table 1 with its correction, the bounds of Table 2, and the inverses."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.errors import InvalidOption
from bsgplan.patterns import Pattern, Shape, best_spacing, bounds, fan_angle, fan_edge_ratio, fan_quality
from bsgplan.patterns.bounds import valences_of_angle, valences_of_edge_ratio, valences_of_quality

TABLE_1 = [
    (3, 0.60, 30, 1.73),
    (4, 0.87, 45, 1.41),
    (5, 0.97, 54, 1.18),
    (6, 1.00, 60, 1.00),
    (7, 0.98, 51, 1.15),
    (8, 0.95, 45, 1.31),  # the paper prints 0.94
    (9, 0.90, 40, 1.46),
    (10, 0.85, 36, 1.62),
    (11, 0.81, 33, 1.77),
    (12, 0.76, 30, 1.93),
    (15, 0.65, 24, 2.40),
    (20, 0.51, 18, 3.20),
    (25, 0.42, 14, 3.99),
]


@pytest.mark.parametrize(("valence", "q", "degrees", "ratio"), TABLE_1)
def test_fans_are_those_of_table_1(valence, q, degrees, ratio):
    assert round(float(fan_quality(valence)), 2) == q
    assert abs(np.degrees(fan_angle(valence)) - degrees) <= 0.5
    assert round(float(fan_edge_ratio(valence)), 2) == ratio


def test_valence_8_is_a_slip_of_the_paper():
    assert round(float(fan_quality(8)), 4) == 0.9473


def test_bounds_show_both_columns_of_table_2_and_the_honest_one():
    found = [bounds(Pattern.parse(text)) for text in ("7:5:3:1", "7:4:1")]
    assert [round(b.positive_spread, 2) for b in found] == [0.98, 0.95]
    assert [round(b.positive_concentrated, 2) for b in found] == [0.95, 0.90]
    assert [round(b.q_bound, 2) for b in found] == [0.97, 0.95]
    assert [round(np.degrees(b.angle_bound)) for b in found] == [51, 45]
    assert [round(b.edge_ratio_bound, 2) for b in found] == [1.18, 1.31]


def test_a_pattern_without_irregularity_is_not_bounded():
    free = bounds(Pattern.parse("5:5:5"))
    assert (free.q_bound, free.positive_concentrated) == pytest.approx((1.0, 1.0))
    assert free.angle_bound == pytest.approx(np.pi / 3)


@given(st.lists(st.integers(1, 20), min_size=2, max_size=7).map(tuple))
def test_no_transition_exceeds_valence_5_and_no_bound_is_beaten(counts):
    pattern = Pattern(counts)
    bound = bounds(pattern)
    assert 0 < bound.q_bound <= bound.positive_spread <= 1 + 1e-12
    assert bound.positive_concentrated <= bound.positive_spread
    if any(pattern.front_irregularity):
        assert bound.q_bound <= float(fan_quality(5))
    assert best_spacing(pattern, Shape.rectangle(1.0)).q_min <= bound.q_bound


@given(st.floats(0.05, 1.0))
def test_inverses_return_exactly_the_valences_that_qualify(share):
    valences = np.arange(3, 400)
    for allowed, qualifies in [
        (valences_of_quality(share), fan_quality(valences) >= share - 1e-9),
        (valences_of_angle(share * np.pi / 3), fan_angle(valences) >= share * np.pi / 3 - 1e-9),
        (valences_of_edge_ratio(1 / share), fan_edge_ratio(valences) <= 1 / share + 1e-9),
    ]:
        assert allowed == (valences[qualifies].min(), valences[qualifies].max())


def test_impossible_requests_are_refused():
    for call in (
        lambda: valences_of_quality(0.0),
        lambda: valences_of_quality(1.1),
        lambda: valences_of_angle(2.0),
        lambda: valences_of_edge_ratio(0.9),
        lambda: fan_quality(2),
    ):
        with pytest.raises(InvalidOption):
            call()
