"""Straight patterns over a length, many at once: the slow twin, one strip at a time, says the same."""

from __future__ import annotations

import numpy as np
import pytest
import reference
from hypothesis import example, given, settings
from hypothesis import strategies as st
from pattern_strategies import COUNTS, RINGS

from bsgplan.patterns.straight import qualities_over, reaches, straight_widths
from bsgplan.patterns.width import best_width, strip_quality


@given(st.data(), st.floats(1e-7, 1e7), st.booleans())
@settings(max_examples=40, deadline=None)
def test_the_quality_of_many_is_that_of_each_by_halving(data, length, is_closed):
    sequences = data.draw(st.lists(RINGS if is_closed else COUNTS, min_size=1, max_size=6))
    found = qualities_over(sequences, length, is_closed=is_closed)
    slow = [reference.straight_quality(counts, length, is_closed=is_closed) for counts in sequences]
    assert found == pytest.approx(slow, rel=1e-9)


@pytest.mark.parametrize("length", [1e-12, 1e-7, 1e7, 1e12])
def test_lengths_far_from_any_good_one_have_their_limits(length):
    """Quality is proportional to the width in flat strips, to its inverse in long ones."""
    many = [(7, 4, 2, 1), (3, 1), (12, 12, 9)]
    nearer = length * (2 if length < 1 else 0.5)
    assert qualities_over(many, length) == pytest.approx(qualities_over(many, nearer) / 2, rel=1e-6)


@given(COUNTS, st.floats(0.02, 5))
@example((1, 5), best_width(1, 5)[0])  # at the peak of a strip
@example((4, 2, 1), 0.75)
def test_the_widths_have_the_quality_and_the_length(counts, length):
    (widths,) = straight_widths([counts], np.array([length]))
    assert widths.sum() == pytest.approx(length)
    each = [strip_quality(m, n, w) for m, n, w in zip(counts, counts[1:], widths.tolist(), strict=False)]
    assert min(each) == pytest.approx(qualities_over([counts], length)[0], rel=1e-6)


def test_4_to_1_in_one_strip_by_hand():
    """Q = 2 sqrt(3) b w / (2 w^2 + c) with b = 1, c = 1.5 + 2 (3/8)^2: under the best width the triangle on
    the coarse front is the worst, over it that on the fine one with b = 1/4, c = 1.5/16 + 2 (3/8)^2.
    """
    fine, coarse = (0.25, 1.5 / 16 + 2 * (3 / 8) ** 2), (1.0, 1.5 + 0.0)
    for length in (0.1, 0.3, 1.0, 3.0):
        by_hand = min(2 * 3**0.5 * b * length / (2 * length**2 + c) for b, c in (fine, coarse))
        assert qualities_over([(4, 1)], length)[0] == pytest.approx(by_hand)


@given(st.lists(COUNTS, min_size=1, max_size=8), st.floats(0.05, 3), st.floats(-0.1, 0.1))
def test_what_reaches_a_quality_has_it(sequences, length, away):
    qualities = qualities_over(sequences, length)
    wanted = qualities * (1 + away) if abs(away) > 1e-6 else qualities
    assert reaches(sequences, length, wanted).tolist() == [away <= 1e-6] * len(sequences)
    best = qualities_over(sequences, None)
    assert reaches(sequences, None, best).all()
    assert not reaches(sequences, None, best * 1.001).any()
