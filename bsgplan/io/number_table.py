"""Rows of numbers in a text: read fast where clean, with a line number where not."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..errors import MeshReadError

LARGEST_WHOLE = 2**53
"""Largest whole number that passes exactly through a float."""
BLANKS = b" \t\n\v\f\r"
FORTRAN_EXPONENT = bytes.maketrans(b"Dd", b"Ee")


def table_of_text(text: bytes, n_lines: int, n_columns: int) -> Floats | Ints | None:
    """Return the table of lines that each hold n_columns numbers and nothing else; None for any other text.

    Each line ends in a newline. NaN passes as a number.
    """
    characters = np.frombuffer(text, dtype=np.uint8)
    words = word_starts(characters)
    if len(words) != n_lines * n_columns or not n_lines:
        return None
    ends, by_line = np.flatnonzero(characters == ord("\n")), words.reshape(n_lines, n_columns)
    if len(ends) != n_lines or (by_line[:, -1] > ends).any() or (by_line[1:, 0] < ends[:-1]).any():
        return None  # a line lends to the next
    values = numbers_of(text)
    return None if values is None or len(values) != len(words) else values.reshape(n_lines, n_columns)


def numbers_of(text: bytes) -> Floats | Ints | None:
    r"""Return the numbers that a text consists of, as integers where all are whole; None for any other text.

    Integers are read several times as fast. Those that would not pass exactly through a float are floats.

    >>> numbers_of(b"1 2\n3"), numbers_of(b"1 2.5"), numbers_of(b"1 x")
    (array([1, 2, 3]), array([1. , 2.5]), None)
    """
    whole = _parsed(text, np.int64)
    if whole is not None and not ((whole > LARGEST_WHOLE) | (whole < -LARGEST_WHOLE)).any():
        return whole
    return _parsed(text, np.float64)


def numbers_with_commas(text: bytes, n: int) -> Floats | None:
    """Return the n numbers of a text with commas between them, (n,); None for any other text.

    >>> numbers_with_commas(b"1, 2.5", 2), numbers_with_commas(b"1 2", 2)
    (array([1. , 2.5]), None)
    """
    words = b",%b," % text.translate(None, BLANKS)
    values = None if b",," in words else _parsed(text, np.float64, separator=",")  # numpy reads blanks as -1
    return values if values is not None and len(values) == n else None


def _parsed(text: bytes, kind: type[np.float64] | type[np.int64], *, separator: str = " ") -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return np.fromstring(text, dtype=kind, sep=separator)
        except (DeprecationWarning, ValueError):
            return None


def word_starts(characters: NDArray[np.uint8]) -> Ints:
    """Return where the words of a text begin, (n_words,)."""
    is_word = characters > ord(" ")
    is_start = is_word.copy()
    is_start[1:] &= ~is_word[:-1]
    return np.flatnonzero(is_start)


def first_bad_line(
    lines: Sequence[bytes], line_numbers: Sequence[int], columns: Sequence[str], what: str
) -> MeshReadError:
    """Return the error of the first line that does not begin with a finite number for each column."""
    wanted = f"{what} needs {len(columns)} numbers ({' '.join(columns)})"
    for number, line in zip(line_numbers, lines, strict=True):
        words = line.split()
        if not words:
            return MeshReadError(
                f"line {number}: blank where {wanted}; delete the line or repair the header's counts"
            )
        if len(words) < len(columns):
            return MeshReadError(
                f"line {number}: {wanted}, got {shown(line)}; repair the line or the header's counts"
            )
        for name, word in zip(columns, words, strict=False):
            try:
                is_number = np.isfinite(float(word.translate(FORTRAN_EXPONENT)))
            except ValueError:
                is_number = False
            if not is_number:
                return MeshReadError(
                    f"line {number}: {what} has {name} {shown(word)}, not a finite number; repair the line"
                )
    return MeshReadError(f"line {line_numbers[0]}: {wanted}; repair the lines from there on")


def shown(line: bytes) -> str:
    """Return a line as a short quoted text for a message.

    >>> shown(b" 2 abc")
    "'2 abc'"
    """
    text = line.decode("ascii", "replace").strip()
    return repr(text if len(text) <= 60 else text[:57] + "...")
