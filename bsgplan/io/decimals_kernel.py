"""The compiled loop of `decimals`: numbers with commas between them, rounded correctly or left to others.

A decimal w 10^q with w < 2^64 is w times the leading 64 bits of 10^q. Where the truncated rest of that power
cannot change how the product is rounded to 53 bits the number is done, as in [Lemire 2021], Algorithm 1; the
one in some hundred that is not, and whatever is no plain number, is left to the caller.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..compiled import compiled, inner

LARGEST_POWER = 64
"""Powers of ten up to which numbers are read here: lengths and coordinates."""
MOST_DIGITS = 19
"""Digits that certainly fit in 64 bits."""
EXACT_POWER = 22
"""The largest power of ten that a float holds exactly."""

ZERO, ONE, TEN = np.uint64(0), np.uint64(1), np.uint64(10)
HALF_WORD, LOW_HALF = np.uint64(32), np.uint64(2**32 - 1)
TOP = np.uint64(63)
NINE, LAST_NINE = np.uint64(9), np.uint64(0x1FF)
"""Bits of the high half of a product below the 53 of a float, the next one, and a possible leading zero."""
LAST_TWO = np.uint64(3)
FRACTION, FRACTION_MASK = np.uint64(52), np.uint64(2**52 - 1)
EXACT = np.uint64(2**53)
SIGN = np.uint64(2**63)


@compiled
def read_decimals(
    text: NDArray[np.uint8],
    values: Floats,
    bits: NDArray[np.uint64],
    state: Ints,
    tens: Floats,
    powers: NDArray[np.uint64],
) -> None:
    """Read numbers until the end of the text or of values, or one that is left to the caller.

    values, (n,), and bits are the same memory. state is where to go on in the text, and the number of values
    so far. tens are 10^0 .. 10^22, powers the leading 64 bits of 10^-64 .. 10^64.
    """
    at, count, n = state[0], state[1], len(text)
    while at < n and count < len(values):
        state[0], state[1] = at, count
        while at < n and (text[at] == 32 or 9 <= text[at] <= 13):
            at += 1
        is_negative = at < n and text[at] == 45
        if at < n and (text[at] == 45 or text[at] == 43):
            at += 1
        mantissa, exponent, n_digits, n_seen, is_fraction = ZERO, np.int64(0), 0, 0, False
        while at < n:
            digit = np.int64(text[at]) - 48
            if 0 <= digit <= 9:
                mantissa = mantissa * TEN + np.uint64(digit)
                n_digits += mantissa != ZERO
                exponent -= is_fraction
                n_seen += 1
            elif digit == -2 and not is_fraction:
                is_fraction = True
            else:
                break
            at += 1
        if n_seen == 0 or n_digits > MOST_DIGITS:
            return
        if at < n and (text[at] == 69 or text[at] == 101):
            at += 1
            is_small = at < n and text[at] == 45
            if at < n and (text[at] == 45 or text[at] == 43):
                at += 1
            power, first = np.int64(0), at
            while at < n and 48 <= text[at] <= 57 and power < 1000:
                power = 10 * power + np.int64(text[at]) - 48
                at += 1
            if at == first:
                return
            exponent += -power if is_small else power
        while at < n and (text[at] == 32 or 9 <= text[at] <= 13):
            at += 1
        if at < n and text[at] != 44:
            return
        if mantissa <= EXACT and -EXACT_POWER <= exponent <= EXACT_POWER:
            value = np.float64(mantissa)
            value = value / tens[-exponent] if exponent < 0 else value * tens[exponent]
            values[count] = -value if is_negative else value
        elif -LARGEST_POWER <= exponent <= LARGEST_POWER and mantissa != ZERO:
            found = rounded(mantissa, powers[exponent + LARGEST_POWER], exponent)
            if found == ZERO:
                return
            bits[count] = found | SIGN if is_negative else found
        else:
            return
        at += 1
        count += 1
    state[0], state[1] = at, count


@inner
def rounded(mantissa: np.uint64, power: np.uint64, exponent: np.int64) -> np.uint64:
    """Return the bits of the float nearest to mantissa 10^exponent, 0 where that takes more of the power."""
    shift = 0
    while mantissa >> TOP == ZERO:
        mantissa <<= ONE
        shift += 1
    high, low = product(mantissa, power)
    if high & LAST_NINE == LAST_NINE and low + mantissa < mantissa:
        return ZERO
    top = high >> TOP
    fraction = high >> (top + NINE)
    if low == ZERO and high & LAST_NINE == ZERO and fraction & LAST_TWO == ONE:
        return ZERO
    fraction = (fraction + (fraction & ONE)) >> ONE
    binary = (217706 * exponent >> 16) + 64 + 1023 - shift - (1 - np.int64(top))  # 217706 / 2^16 = log2(10)
    if fraction >> np.uint64(53):
        fraction >>= ONE
        binary += 1
    return (np.uint64(binary) << FRACTION) | (fraction & FRACTION_MASK)


@inner
def product(a: np.uint64, b: np.uint64) -> tuple[np.uint64, np.uint64]:
    """Return the high and the low half of the product of two words."""
    a_high, a_low, b_high, b_low = a >> HALF_WORD, a & LOW_HALF, b >> HALF_WORD, b & LOW_HALF
    low = a_low * b_low
    middle = a_high * b_low + (low >> HALF_WORD)
    other = a_low * b_high + (middle & LOW_HALF)
    return a_high * b_high + (middle >> HALF_WORD) + (other >> HALF_WORD), a * b
