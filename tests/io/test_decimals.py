"""Decimals read by compiled code: the floats of Python to the last bit, and nothing that is no number."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.io.decimals import POWERS, decimals
from bsgplan.io.decimals_kernel import LARGEST_POWER
from bsgplan.io.number_table import numbers_with_commas

DIGITS = st.text("0123456789", max_size=24)
SPELT = st.builds(
    "{}{}{}{}{}".format,
    st.sampled_from(["", "-", "+", " ", "\n-"]),
    DIGITS,
    st.sampled_from(["", "."]),
    DIGITS,
    st.sampled_from(["", "e0", "E-7", "e+22", "e-400", "e400", "e60", "e-63", "e", " "]),
)
FLOATS = st.floats(allow_nan=False).map(repr) | st.integers().map(str)


def python(words: list[str]) -> list[float] | None:
    try:
        return [float(word) for word in words]
    except ValueError:
        return None


@given(st.lists(SPELT | FLOATS, min_size=1, max_size=20))
def test_numbers_are_those_of_python_to_the_last_bit(words):
    found = decimals(",".join(words).encode(), len(words))
    expected = python(words)
    assert (found is None) == (expected is None)
    if expected is not None:
        assert found.tobytes() == np.array(expected).tobytes()


@given(st.lists(st.sampled_from(["1", ",", "-", ".", "e", " ", "\0", "x", "nan", "_", "7"]), max_size=12))
def test_only_numbers_pass_and_as_many_as_wanted(pieces):
    text = "".join(pieces)
    words = text.split(",")
    found, plain = (read(text.encode(), len(words)) for read in (decimals, numbers_with_commas))
    expected = None if "_" in text else python(words)
    for values in (found, plain):
        assert (values is None) == (expected is None)
        assert values is None or np.array_equal(values, expected, equal_nan=True)
    assert decimals(text.encode(), len(words) + 1) is None
    assert decimals(text.encode(), len(words) - 1) is None or not text


@pytest.mark.parametrize("digits", [15, 16, 17, 19])
def test_halfway_between_two_floats_and_beside(digits):
    """Long mantissas near the middle of two floats, where a product cut short rounds wrongly."""
    random = np.random.default_rng(71993)
    floats = random.uniform(1, 10, 2000) * 10.0 ** random.integers(-30, 30, 2000)
    middles = [
        (a.as_integer_ratio(), b.as_integer_ratio())
        for a, b in zip(floats.tolist(), np.nextafter(floats, np.inf).tolist(), strict=True)
    ]
    words = []
    for (p, q), (r, s) in middles:
        top, bottom = p * s + r * q, 2 * q * s
        power = len(str(top // bottom)) - digits if top >= bottom else -digits - len(str(bottom // top)) + 1
        scaled = top * 10 ** max(-power, 0) // (bottom * 10 ** max(power, 0))
        words += [f"{scaled}e{power}", f"{scaled + 1}e{power}"]
    assert decimals(",".join(words).encode(), len(words)).tolist() == [float(word) for word in words]


def test_powers_of_ten_are_cut_not_rounded():
    for power, bits in zip(range(-LARGEST_POWER, LARGEST_POWER + 1), POWERS.tolist(), strict=True):
        top, bottom = (10**power, 1) if power >= 0 else (1, 10**-power)
        scale = 0
        while top << max(scale, 0) < (bottom << 63) << max(-scale, 0):
            scale += 1
        while top << max(scale, 0) >= (bottom << 64) << max(-scale, 0):
            scale -= 1
        assert bits == (top << max(scale, 0)) // (bottom << max(-scale, 0))
