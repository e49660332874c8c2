"""Decimal numbers with commas between them as floats, to the last bit, ten times as fast as by numpy.

Compiled: that pays in files of some ten megabytes.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from .decimals_kernel import EXACT_POWER, LARGEST_POWER, read_decimals

TENS: Floats = np.array([float(10**power) for power in range(EXACT_POWER + 1)])


def decimals(text: bytes, n: int) -> Floats | None:
    """Return the n numbers of a text with commas between them, (n,); None for any other text.

    >>> decimals(b"1, -25e3,nan", 3), decimals(b"1,,2", 3), decimals(b"1 2", 1)
    (array([ 1.0e+00, -2.5e+04,      nan]), None, None)
    """
    values, state = np.empty(n), np.zeros(2, dtype=np.int64)
    characters, bits = np.frombuffer(text, dtype=np.uint8), values.view(np.uint64)
    while True:
        read_decimals(characters, values, bits, state, TENS, POWERS)
        at, count = state.tolist()
        if at >= len(text) or count == n:
            return values if count == n and at >= len(text) else None
        stop = text.find(b",", at)
        stop = len(text) if stop < 0 else stop
        word = text[at:stop]
        try:
            values[count] = float(word)
        except ValueError:
            return None
        if b"_" in word:
            return None  # digits in groups, a number to Python only
        state[:] = stop + 1, count + 1


def leading_bits(power: int) -> int:
    """Return the leading 64 bits of a power of ten, truncated.

    >>> leading_bits(1) == 10 << 60, leading_bits(-1) == 2**67 // 10
    (True, True)
    """
    if power >= 0:
        return 10**power << 64 >> (10**power).bit_length()
    scale = (10**-power).bit_length() + 64
    quotient = 2**scale // 10**-power
    return quotient >> (quotient.bit_length() - 64)


POWERS = np.array(
    [leading_bits(power) for power in range(-LARGEST_POWER, LARGEST_POWER + 1)], dtype=np.uint64
)
