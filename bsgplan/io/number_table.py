"""Rows of numbers in a text file: read fast where clean, with a line number where not."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import numpy as np

from ..arrays import Floats
from ..errors import MeshReadError

FORTRAN_EXPONENT = bytes.maketrans(b"Dd", b"Ee")


def number_table(
    lines: Sequence[bytes], line_numbers: Sequence[int], columns: Sequence[str], what: str
) -> Floats:
    """Return the first numbers of each line, (n_lines, n_columns).

    Text after the last wanted column is a comment, Fortran's D exponents are understood. Raises
    MeshReadError at the first line that does not begin with that many finite numbers.
    """
    n_columns = len(columns)
    if not len(lines):
        return np.empty((0, n_columns))
    table = _exact(lines, n_columns)
    if table is None:  # comments or D exponents: cut every line to its columns, then once more
        cut = [
            b" ".join(line.split(None, n_columns)[:n_columns]).translate(FORTRAN_EXPONENT) for line in lines
        ]
        table = _exact(cut, n_columns)
    if table is None or not np.isfinite(table).all():
        raise _first_bad_line(lines, line_numbers, columns, what)
    return table


def _exact(lines: Sequence[bytes], n_columns: int) -> Floats | None:
    return table_of_text(b"\n".join(lines) + b"\n", len(lines), n_columns)


def table_of_text(text: bytes, n_lines: int, n_columns: int) -> Floats | None:
    """Return the table of lines that each hold n_columns numbers and nothing else; None for any other text.

    Each line ends in a newline. NaN passes as a number.
    """
    text = text.replace(b"\n", b" nan\n")  # a nan at each line's end proves that no line lends to the next
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            values = np.fromstring(text, dtype=np.float64, sep=" ")  # type: ignore[arg-type, unused-ignore]
        except (DeprecationWarning, ValueError):
            return None
    if values.size != n_lines * (n_columns + 1) or _n_words(text) != values.size:
        return None
    table: Floats = values.reshape(n_lines, n_columns + 1)
    return table[:, :-1] if np.isnan(table[:, -1]).all() else None


def _n_words(text: bytes) -> int:
    is_space = np.frombuffer(text, dtype=np.uint8) <= ord(" ")
    return int(np.count_nonzero(is_space[:-1] & ~is_space[1:])) + (not is_space[0])


def _first_bad_line(
    lines: Sequence[bytes], line_numbers: Sequence[int], columns: Sequence[str], what: str
) -> MeshReadError:
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
