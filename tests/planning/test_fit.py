"""Sequences of front counts: the dynamic programme finds the cheapest, and none has a front too short."""

from __future__ import annotations

from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.planning.fit import (
    PRICES,
    STEEP,
    TOLERANCE,
    _best_sequences,
    _choices,
    block_counts,
    misfit,
    misfits,
    sequences,
)
from bsgplan.regions import Profile


def straight(fine: float, coarse: float, layers: float) -> Profile:
    """A profile of counts linear in the depth, of unit size."""
    depths = np.linspace(0, layers, 5)
    counts = np.linspace(fine, coarse, 5)
    return Profile(depths, counts, np.linspace(0, 1, 5), counts, depths * np.sqrt(3) / 2)


def cost(counts: tuple[int, ...], wanted: list[float], price: float) -> float:
    """The sum in the module's docstring, written out."""
    total = sum((np.log(f / t) / TOLERANCE) ** 2 for f, t in zip(counts, wanted, strict=True))
    total += STEEP * sum(max(0.0, max(pair) / min(pair) - 2) for pair in pairwise(counts))
    padded = [counts[0], *counts, counts[-1]]
    return total + price * sum(
        abs(a - 2 * b + c) for a, b, c in zip(padded, padded[1:], padded[2:], strict=False)
    )


@given(
    st.lists(st.floats(1, 14), min_size=2, max_size=5),
    st.sampled_from([1, 3]),
)
def test_the_dynamic_programme_is_as_cheap_as_trying_everything(wanted: list[float], least: int) -> None:
    """At every price, all prices together."""
    wanted = [max(least, t) for t in wanted]
    every = list(product(*(_choices(t, least).tolist() for t in wanted)))
    for found, price in zip(_best_sequences(np.array(wanted), least), PRICES, strict=True):
        assert min(found) >= least
        assert cost(found, wanted, price) == pytest.approx(min(cost(c, wanted, price) for c in every))


@given(
    st.floats(0.3, 60),
    st.floats(0.3, 60),
    st.floats(0.5, 80),
    st.sampled_from([1, 2, 4, 8]),
    st.sampled_from([1, 3]),
)
def test_sequences_have_two_fronts_or_more_and_no_front_under_the_least(
    fine: float, coarse: float, layers: float, side: int, least: int
) -> None:
    found = sequences(straight(fine, coarse, layers), side, least=least)
    assert found
    assert len(set(found)) == len(found)
    assert all(len(counts) >= 2 and min(counts) >= least for counts in found)


def test_the_paper_region_is_offered_its_own_two_patterns() -> None:
    found = sequences(straight(28, 4, 9.5), 4)
    assert {(7, 5, 3, 1), (7, 4, 1), (7, 1)} <= set(found)


def test_a_pattern_that_follows_its_profile_has_no_misfit() -> None:
    profile = straight(28, 4, 12)
    assert block_counts(profile, 4, 3).tolist() == [7, 5, 3, 1]
    assert misfit((7, 5, 3, 1), profile, 4) == 0
    assert misfit((7, 1), profile, 4) > misfit((7, 4, 1), profile, 4) > 0


def test_twice_the_blocks_along_and_across_are_ln_2_off() -> None:
    assert misfit((4, 4, 4), straight(8, 8, 4), 4) == pytest.approx(np.log(2))


def test_misfits_of_many_are_those_of_each() -> None:
    profile = straight(28, 4, 9.5)
    many = [(7, 4, 1), (7, 5, 3, 1), (6, 4, 2), (7, 1)]
    found = misfits(many, profile, 4)
    assert list(found.values()) == pytest.approx([misfit(c, profile, 4) for c in found], rel=1e-12)
    assert set(found) == set(many)
    wanted = np.array([7.0, 4.0, 1.0])  # of 7:4:1 on its two strips, 9.5 layers in 2 of 4
    along = (np.log(wanted / np.array([7, 4, 1])) ** 2).mean()
    assert found[7, 4, 1] == pytest.approx(((along + np.log(9.5 / 8) ** 2) / 2) ** 0.5)
