"""The table of patterns in NOTES.md, and the identities of counts and irregularity."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.errors import InvalidOption
from bsgplan.patterns import Pattern

COUNTS = st.lists(st.integers(1, 40), min_size=2, max_size=9).map(tuple)

TABLE = [
    ("4:1", 5, (-3, 3), (3, -3)),
    ("4:3:1", 11, (-1, -1, 2), (2, -2)),
    ("4:2:1", 9, (-2, 1, 1), (2, -2)),
    ("4:3:2:1", 15, (-1, 0, 0, 1), (1, -1)),
    ("7:5:3:1", 24, (-2, 0, 0, 2), (2, -2)),
    ("7:4:1", 16, (-3, 0, 3), (3, -3)),
    ("7:2:1", 12, (-5, 4, 1), (5, -5)),
    ("7:4:2:1", 20, (-3, 1, 1, 1), (3, -3)),
]


@pytest.mark.parametrize(("text", "n_blocks", "fronts", "signs"), TABLE)
def test_blocks_and_irregularity_are_those_of_the_table(text, n_blocks, fronts, signs):
    pattern = Pattern.parse(text)
    assert pattern.n_blocks == n_blocks
    assert pattern.front_irregularity == fronts
    assert (pattern.irregularity.positive, pattern.irregularity.negative) == signs


def test_the_patterns_of_figures_6_and_7_have_1500_and_381_blocks():
    arithmetic = Pattern(tuple(range(40, 9, -1)))
    assert arithmetic.n_blocks == 1500
    assert arithmetic.front_irregularity == (-1, *[0] * 29, 1)
    assert Pattern.parse("128:64:32:16:8:4:2:1").n_blocks == 381


def test_a_ring_of_constant_counts_has_no_irregularity():
    pattern = Pattern.parse("12:12:12", is_closed=True)
    assert pattern.front_irregularity == (0, 0, 0)
    assert pattern.n_blocks == 48


@given(COUNTS)
def test_irregularity_sums_to_zero_and_text_round_trips(counts):
    pattern = Pattern(counts)
    assert sum(pattern.front_irregularity) == pattern.irregularity.total == 0
    assert Pattern.parse(str(pattern)) == pattern
    assert pattern.reversed().reversed() == pattern
    assert pattern.reversed().n_blocks == pattern.n_blocks
    assert pattern.reversed().front_irregularity == pattern.front_irregularity[::-1]
    assert pattern.n_blocks == counts[0] + counts[-1] + 2 * sum(counts[1:-1])  # Eq. 15, second form
    assert (pattern.n_fronts, pattern.n_layers) == (len(counts), len(counts) - 1)


@given(COUNTS, st.data())
def test_a_front_is_not_negative_exactly_where_its_neighbours_sum_to_twice_it_or_more(counts, data):
    # Eq. 19 as it should read: the paper has the inequality the wrong way round
    counts = (*counts, data.draw(st.integers(1, 40)))
    inner = Pattern(counts).front_irregularity[1:-1]
    for k, irregularity in enumerate(inner, start=1):
        assert (irregularity >= 0) == (counts[k - 1] + counts[k + 1] >= 2 * counts[k])


@pytest.mark.parametrize("text", ["", "7", "7:", "7:x", "7:-4", "7:0", "7:4.5", "²:1", "7/4"])
def test_text_that_is_no_pattern_is_refused(text):
    with pytest.raises(InvalidOption):
        Pattern.parse(text)


def test_errors_name_the_pattern_and_the_remedy():
    with pytest.raises(InvalidOption, match=r"12:2 has a closed ring of 2 elements; each needs at least 3"):
        Pattern((12, 2), is_closed=True)
    with pytest.raises(InvalidOption, match="not a sequence of integers"):
        Pattern((2.5, 1))  # type: ignore[arg-type]
