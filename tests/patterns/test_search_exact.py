"""The exact search: its front against brute force, up to 16 elements and for short and long transitions."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
import reference
from hypothesis import example, given, settings
from hypothesis import strategies as st

from bsgplan.patterns import search, width_interval
from bsgplan.patterns.search import EXACT, LEAST_QUALITY, MOST_LAYERS, RESOLUTION, is_exact
from bsgplan.patterns.search_exact import NEAR, STEP, exact_front, sequences_at
from bsgplan.patterns.search_strips import front, known, strips_between
from bsgplan.patterns.straight import qualities_over
from bsgplan.patterns.width import best_width

LEVELS = (0.32, 0.4, 0.5, 0.58, 0.65, 0.71, 0.75, 0.79, 0.82, 0.84, 0.855, 0.8649)
"""Mean ratios at which all sequences are listed."""
MOST = 6000
"""Sequences listed at one of them, at most; those of the fewest blocks where there are more."""


def widths(fine, coarse, q, *, is_closed=False):
    """The widths of every strip that reach q, one strip at a time."""
    low, high = np.full((2, fine + 1, fine + 1), np.inf)
    for m in range(coarse, fine + 1):
        for n in range(coarse, m + 1):
            low[m, n], high[m, n] = width_interval(m, n, q, is_closed=is_closed)
    return low, high


def all_at(fine, coarse, length, q, *, is_closed=False):
    """Blocks, iota+ and counts of all sequences that reach q, up to as many blocks as can be listed."""
    both, found, blocks = widths(fine, coarse, q, is_closed=is_closed), [], 2 * fine
    while blocks < 2000:
        more = reference.every_sequence(both, (fine, coarse), length, blocks=blocks, most=MOST)
        if more is None:
            break
        found, blocks = more, int(blocks * 1.4)
    return found


@given(st.integers(1, 16), st.integers(1, 15), st.floats(0.03, 1), st.booleans())
@example(1, 15, 0.7, False)
@example(7, 5, 0.2625, False)
@example(3, 5, 0.15, False)
@example(5, 1, 0.21, False)
@example(2, 14, 0.25, False)
@example(8, 8, 1.0, False)
@example(4, 12, 0.3, True)
@settings(max_examples=8, deadline=None)
def test_the_exact_front_misses_nothing_that_brute_force_finds(coarse, more, share, is_closed):
    fine = min(coarse + more, EXACT)
    coarse = max(coarse, 3) if is_closed else coarse
    if fine <= coarse:
        return
    length = share * 12 / coarse  # up to about 12 coarse layers
    found = exact_front(
        strips_between(fine, coarse, is_closed=is_closed), length, [], least_quality=LEAST_QUALITY
    )
    for k in found[:: max(1, len(found) // 4)]:  # what is told is true
        assert reference.straight_quality(k.counts, length, is_closed=is_closed) == pytest.approx(
            k.quality, abs=1e-6
        )
    listed = search(fine, coarse, length=length, is_closed=is_closed) if found else ()
    for q in LEVELS:  # and nothing is missing
        every = all_at(fine, coarse, length, q, is_closed=is_closed)
        pairs = {(blocks, positive): counts for blocks, positive, counts in every}
        for (blocks, positive), counts in pairs.items():
            assert any(
                f.n_blocks <= blocks and f.positive <= positive and f.quality >= q - STEP - 1e-9
                for f in found
            ), (counts, q)
            assert any(
                f.n_blocks <= blocks and f.positive <= positive and f.q_min >= q - STEP - RESOLUTION - 1e-9
                for f in listed
            ), (counts, q)


def test_brute_force_lists_thousands_and_long_ones():
    many = [all_at(16, 1, 0.7, q) for q in LEVELS]
    assert sum(map(len, many)) > 4000
    assert max(len(counts) for found in many for _, _, counts in found) > 6
    assert max(len(counts) for _, _, counts in all_at(3, 2, 5.0, 0.8)) > 12


@pytest.mark.parametrize(("fine", "coarse"), [(16, 1), (16, 3), (15, 2)])
@pytest.mark.parametrize("is_closed", [False, True])
def test_at_free_length_all_strictly_decreasing_sequences_are_tried(fine, coarse, is_closed):
    coarse = max(coarse, 3) if is_closed else coarse
    inner = range(coarse + 1, fine)
    every = [
        (fine, *(n for n in reversed(inner) if mask >> (n - coarse - 1) & 1), coarse)
        for mask in range(2 ** len(inner))
    ]
    caps = {
        (m, n): best_width(m, n, is_closed=is_closed)[1]
        for m in range(coarse, fine + 1)
        for n in range(coarse, m)
    }
    qualities = [min(caps[strip] for strip in pairwise(counts)) for counts in every]
    best = front(
        [k for k in known(every, qualities) if k.quality >= LEAST_QUALITY],
    )
    found = exact_front(
        strips_between(fine, coarse, is_closed=is_closed), None, [], least_quality=LEAST_QUALITY
    )
    for k in best:
        assert any(
            f.n_blocks <= k.n_blocks and f.positive <= k.positive and f.quality >= k.quality - NEAR
            for f in found
        )
    for f in found:
        assert any(
            k.n_blocks <= f.n_blocks and k.positive <= f.positive and k.quality >= f.quality - 1e-9
            for k in best
        )


@given(st.integers(1, 16), st.integers(1, 15), st.floats(1, 200), st.floats(0.4, 0.865))
@example(1, 15, 32.0, 0.8649)
@settings(max_examples=25, deadline=None)
def test_equal_fronts_wait_for_the_coarse_end(coarse, more, layers, q):
    """Long transitions: what is found reaches q, and repeats inner fronts less than can be exchanged."""
    fine = min(coarse + more, EXACT)
    if fine == coarse:
        return
    length = layers / coarse
    strips = strips_between(fine, coarse)
    new = sequences_at(strips, length, q, [])
    if new:
        assert qualities_over(new, length).min() > q - 1e-6
    for counts in new:
        for n in range(coarse + 1, fine + 1):
            assert counts.count(n) <= n // np.gcd(n, coarse)
    pairs = [(k.positive, k.n_blocks) for k in known(new, [q] * len(new))]
    assert sorted(pairs) == sorted(pairs, key=lambda pair: -pair[1])  # less iota+ costs blocks


def test_exact_is_said_of_small_fronts_at_every_length():
    assert is_exact(16, 1)
    assert not is_exact(17, 1)
    found = search(6, 2, length=20.0)
    assert max(len(f.pattern.counts) for f in found) > 40
    assert STEP < NEAR <= RESOLUTION
    assert MOST_LAYERS == 256
