"""The search: the numbers of NOTES.md, never worse than its pool, times, errors."""

from __future__ import annotations

import time

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from bsgplan.errors import InvalidOption, NoPatternFits
from bsgplan.patterns import (
    Pattern,
    Shape,
    best_length,
    best_spacing,
    length_of_layers,
    search,
    shortlist,
)
from bsgplan.patterns.search import RESOLUTION
from bsgplan.patterns.search_exact import STEP, exact_front
from bsgplan.patterns.search_pool import improved, regular_sequences
from bsgplan.patterns.search_priced import priced_sequences
from bsgplan.patterns.search_strips import front, known, strips_between
from bsgplan.patterns.straight import qualities_over
from bsgplan.patterns.width import best_width, best_widths, strip_form, strip_forms


@pytest.mark.parametrize("is_closed", [False, True])
def test_forms_of_many_strips_are_those_of_each(is_closed):
    pairs = [(m, n) for m in range(3, 26) for n in range(3, 26)]
    forms = strip_forms(*np.array(pairs).T, is_closed=is_closed)
    widths, caps = best_widths(forms)
    for pair, form, w, q in zip(pairs, forms, widths, caps, strict=True):
        assert np.allclose(form, strip_form(*pair, is_closed=is_closed), rtol=1e-12)
        assert (w, q) == pytest.approx(best_width(*pair, is_closed=is_closed), rel=1e-9)


def test_7_to_1_lists_7_4_2_1_above_the_patterns_of_the_paper():
    found = {str(f.pattern): f for f in search(7, 1)}
    best = found["7:4:2:1"]
    assert (best.n_blocks, best.positive, round(best.q_min, 3)) == (20, 3, 0.756)
    for text in ("7:4:1", "7:5:3:1"):
        assert found[text].q_min == pytest.approx(0.5)
    assert best.length == pytest.approx(best_length(Pattern.parse("7:4:2:1")).length)
    at = {str(f.pattern): round(f.q_min, 3) for f in search(7, 1, length=0.7)}
    assert at["7:4:2:1"] == 0.736 == max(at.values())
    assert max(at["7:4:1"], at["7:5:3:1"]) <= 0.5


def test_short_transitions_take_4_2_1_and_long_ones_4_3_2_1():
    best = {length: str(search(4, 1, length=length)[0].pattern) for length in (0.75, 13 / 12)}
    assert best == {0.75: "4:2:1", 13 / 12: "4:3:2:1"}


@given(st.integers(1, 40), st.integers(1, 40), st.one_of(st.none(), st.floats(0.05, 3)))
@example(28, 4, length_of_layers(28, 4, 9.5))
@example(40, 10, 2.0)
@settings(max_examples=12, deadline=None)
def test_never_worse_than_arithmetic_geometric_and_the_paper(fine, coarse, length):
    low, high = sorted((fine, coarse))
    regular = regular_sequences(high, low, length)
    if high > low:
        assert {tuple(range(high, low - 1, -1)), (high, low)} <= set(regular)
    least = 0.3
    try:
        found = search(fine, coarse, length=length, least_quality=least)
    except NoPatternFits:
        assert qualities_over(regular, length).max() < least
        return
    for counts, q in zip(regular, qualities_over(regular, length), strict=True):
        (k,) = known([counts], [q])
        assert q < least or any(
            f.n_blocks <= k.n_blocks and f.positive <= k.positive and f.q_min >= q - RESOLUTION - STEP
            for f in found
        )
    for f in found:
        assert f.pattern.counts[0] == fine
        assert f.pattern.counts[-1] == coarse
        assert all((a >= b) == (fine >= coarse) or a == b for a, b in f.pattern.strips)


@pytest.mark.parametrize(("fine", "coarse", "length"), [(12, 1, 0.7), (14, 3, None), (13, 2, 2.5)])
def test_the_pruned_search_comes_close_to_the_exact_one(fine, coarse, length):
    strips = strips_between(fine, coarse)
    sequences = priced_sequences(strips, length, least_quality=0.3)
    qualities = qualities_over(sequences, length)
    pool = [k for k in known(sequences, qualities) if k.quality >= 0.3]
    pruned = improved(pool, length, least_quality=0.3)
    gaps = [
        k.quality
        - max((p.quality for p in pruned if p.n_blocks <= k.n_blocks and p.positive <= k.positive), default=0)
        for k in exact_front(strips, length, [], least_quality=0.3)
    ]
    assert np.quantile(gaps, 0.75) < 0.01
    assert np.mean(gaps) < 0.05


def test_the_papers_long_transitions_are_matched():
    for fine, coarse, length, blocks, positive, q in (
        (40, 10, 2.0, 1500, 1, 0.803),
        (128, 1, 1.0, 381, 64, 0.866),
    ):
        assert any(
            f.n_blocks <= blocks and f.positive <= positive and f.q_min > q - 0.0015
            for f in search(fine, coarse, length=length)
        )


@pytest.mark.parametrize(
    ("fine", "coarse", "length", "seconds"),
    [(7, 1, length_of_layers(28, 4, 9.5), 0.2), (40, 10, 2.0, 3), (128, 1, 1.0, 3), (128, 1, None, 3)],
)
def test_cpu_time(fine, coarse, length, seconds):
    spent = []
    for _ in range(2):  # machines are noisy: the better of two
        start = time.process_time()
        search(fine, coarse, length=length)
        spent.append(time.process_time() - start)
    assert min(spent) < seconds


def test_a_reversed_search_gives_reversed_patterns():
    forth, back = search(7, 2, length=0.8), search(2, 7, length=0.8)
    assert [f.pattern.counts[::-1] for f in forth] == [b.pattern.counts for b in back]
    for f, b in zip(forth, back, strict=True):
        assert (
            b.q_min == f.q_min == pytest.approx(best_spacing(b.pattern, Shape.rectangle(0.8)).q_min, abs=1e-6)
        )


def test_equal_ends_have_layers_of_equal_fronts():
    assert [str(f.pattern) for f in search(3, 3)] == ["3:3"]
    found = search(3, 3, length=2.0)
    assert found[0].pattern.counts == (3,) * 7
    assert found[0].q_min == pytest.approx(3**0.5 / 2)
    assert [f.n_blocks for f in found] == sorted((f.n_blocks for f in found), reverse=True)


@given(st.integers(2, 30), st.integers(1, 29), st.floats(0.5, 30))
def test_length_of_layers_integrates_equilateral_layers(fine, coarse, layers):
    depth = (np.arange(20000) + 0.5) / 20000
    exact = layers * (3**0.5 / 2 / (fine + (coarse - fine) * depth)).mean()
    assert length_of_layers(fine, coarse, layers) == pytest.approx(exact, rel=1e-4)
    assert length_of_layers(coarse, fine, layers) == pytest.approx(exact, rel=1e-4)


@given(st.lists(st.integers(1, 12), min_size=2, max_size=6))
def test_the_best_length_is_best(counts):
    pattern = Pattern(tuple(counts))
    best = best_length(pattern)
    for length in (best.shortest, best.length, best.longest):
        assert best_spacing(pattern, Shape.rectangle(length)).q_min == pytest.approx(best.q_min, abs=1e-6)
    for length in (best.shortest * 0.99, best.longest * 1.01):
        assert best_spacing(pattern, Shape.rectangle(length)).q_min < best.q_min


def test_the_spacing_at_the_peak_of_a_strip_is_finite():
    """1:5 over exactly its best length had widths that were no numbers."""
    for m in range(1, 13):
        for n in range(1, 13):
            pattern = Pattern((m, n))
            width, q = best_width(m, n)
            assert best_spacing(pattern, Shape.rectangle(width)).q_min == pytest.approx(q, abs=1e-9)


def test_what_no_pattern_meets_says_what_is_there():
    with pytest.raises(
        NoPatternFits, match=r"over 0\.01 heights reaches a mean ratio of 0\.3; 7:4:1 has 0\.0"
    ):
        search(7, 1, length=0.01)
    with pytest.raises(NoPatternFits, match=r"mean ratio of 0\.9"):
        search(7, 1, least_quality=0.9)


@pytest.mark.parametrize(
    ("fine", "coarse", "options"),
    [
        (0, 1, {}),
        (7, 0, {}),
        (600, 1, {}),
        (7, 2, {"is_closed": True}),
        (7, 1, {"length": 0.0}),
        (7, 1, {"length": float("nan")}),
        (7, 2, {"length": 129.0}),
        (40, 40, {"length": 7.0}),
        (7, 1, {"least_quality": 1.0}),
    ],
)
def test_what_is_out_of_range_is_refused(fine, coarse, options):
    with pytest.raises(InvalidOption):
        search(fine, coarse, **options)


def test_layers_must_be_positive():
    with pytest.raises(InvalidOption, match="layers"):
        length_of_layers(28, 4, 0)


@given(st.integers(1, 16), st.integers(1, 16), st.floats(0.1, 2))
@settings(max_examples=15, deadline=None)
def test_the_shortlist_is_matched_by_the_search_and_has_most_of_it(fine, coarse, length):
    soon = shortlist(fine, coarse, length=length, least_quality=0.55)
    try:
        every = search(fine, coarse, length=length, least_quality=0.55)
    except NoPatternFits:
        assert soon == ()
        return
    for f in soon:
        assert any(
            e.n_blocks <= f.n_blocks and e.positive <= f.positive and e.q_min >= f.q_min - RESOLUTION - STEP
            for e in every
        )
        assert f.q_min == pytest.approx(best_spacing(f.pattern, Shape.rectangle(length)).q_min, abs=1e-9)
    assert not every or soon
    assert len(soon) >= len(every) / 2


def test_the_front_is_that_of_comparing_each_with_each():
    rng = np.random.default_rng(60_127)
    sequences = [tuple(sorted(rng.integers(1, 9, 4).tolist(), reverse=True)) for _ in range(200)]
    pool = known(sequences, rng.random(200).round(2))
    for resolution in (0.0, 0.05):
        slow = []
        for k in sorted(pool, key=lambda k: (k.n_blocks, k.positive, -k.quality, k.counts)):
            if not any(o.positive <= k.positive and o.quality >= k.quality - resolution for o in slow):
                slow.append(k)
        fast = front(pool, resolution=resolution)
        assert {id(k) for k in fast} == {id(k) for k in slow}
        assert [k.quality for k in fast] == sorted((k.quality for k in slow), reverse=True)
