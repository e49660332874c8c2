"""The noun Rows: rows of numbers of a text, each with the number of its line."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .number_table import LARGEST_WHOLE, numbers_of, shown, word_starts


class Rows(NamedTuple):
    """Rows of numbers, not all of the same length, one after the other."""

    values: Floats | Ints
    """All numbers, (n_values,), as integers where all are whole."""
    starts: Ints
    """Where each row begins in `values`, and the end, (n_rows + 1,)."""
    line_numbers: Ints
    """Line of each row in the file, (n_rows,), from 1."""

    @property
    def lengths(self) -> Ints:
        """Number of values in each row, (n_rows,)."""
        return np.diff(self.starts)

    def columns(self, first: int, stop: int, what: str) -> Floats:
        """Return values first .. stop - 1 of every row, (n_rows, stop - first)."""
        return np.ascontiguousarray(self._table(first, stop, what), dtype=np.float64)

    def integers(self, first: int, stop: int, what: str) -> Ints:
        """Return values first .. stop - 1 of every row as whole numbers, (n_rows, stop - first)."""
        table = self._table(first, stop, what)
        if table.dtype.kind == "i":
            return np.ascontiguousarray(table, dtype=np.int64)
        is_bad = (table != np.rint(table)) | (np.abs(table) > LARGEST_WHOLE)
        if is_bad.any():
            row, column = np.argwhere(is_bad)[0]
            raise MeshReadError(
                f"line {self.line_numbers[row]}: {what} has {table[row, column]:g} for a whole number; "
                "repair the line or the header's counts"
            )
        return table.astype(np.int64)

    def _table(self, first: int, stop: int, what: str) -> Floats | Ints:
        is_short = self.lengths < stop
        if is_short.any():
            where = int(np.flatnonzero(is_short)[0])
            raise MeshReadError(
                f"line {self.line_numbers[where]}: {what} needs {stop} numbers, got {self.lengths[where]}; "
                "repair the line or the header's counts"
            )
        n_rows = len(self.line_numbers)
        if n_rows and (self.lengths == self.lengths[0]).all():
            return self.values.reshape(n_rows, -1)[:, first:stop]
        return self.values[self.starts[:-1, None] + np.arange(first, stop)]

    def of(self, is_wanted: np.ndarray) -> Rows:
        """Return the rows where is_wanted is true, (n_rows,)."""
        kept = np.repeat(is_wanted, self.lengths)
        starts = np.concatenate([[0], np.cumsum(self.lengths[is_wanted])])
        return Rows(self.values[kept], starts, self.line_numbers[is_wanted])


NO_ROWS = Rows(np.empty(0), np.zeros(1, dtype=np.int64), np.empty(0, dtype=np.int64))


def rows_of(block: bytes, first: int, what: str) -> Rows:
    """Return the rows of whole lines of text, of which the first has that line number."""
    text = np.frombuffer(block, dtype=np.uint8)
    words = word_starts(text)
    if not len(words):
        return NO_ROWS
    values = finite_numbers(block, first, what, n_words=len(words))
    ends = np.append(np.flatnonzero(text == ord("\n")), len(text))
    lengths = np.diff(np.searchsorted(words, ends), prepend=0)
    is_row = lengths > 0
    starts = np.concatenate([[0], np.cumsum(lengths[is_row])])
    return Rows(values, starts, first + np.flatnonzero(is_row))


def finite_numbers(block: bytes, first: int, what: str, *, n_words: int) -> Floats | Ints:
    """Return the numbers of words, (n_words,), the first of them on that line; raises MeshReadError."""
    values = all_numbers(block, first, what, n_words=n_words)
    if not np.isfinite(values).all():
        raise _first_bad_word(block, first, what, math.isfinite)
    return values


def all_numbers(block: bytes, first: int, what: str, *, n_words: int) -> Floats | Ints:
    """Return the numbers of words as `finite_numbers` does, those that are NaN or infinite too."""
    values = numbers_of(block)
    if values is None or len(values) != n_words:
        raise _first_bad_word(block, first, what, lambda _: True)
    return values


def joined(parts: list[Rows]) -> Rows:
    """Return the rows of all parts, one after the other."""
    parts = [part for part in parts if len(part.values)] or [NO_ROWS]
    offsets = np.cumsum([0] + [len(part.values) for part in parts])
    starts = [part.starts[:-1] + offset for part, offset in zip(parts, offsets, strict=False)]
    return Rows(
        np.concatenate([part.values for part in parts]),
        np.concatenate([*starts, offsets[-1:]]),
        np.concatenate([part.line_numbers for part in parts]),
    )


def _first_bad_word(block: bytes, first: int, what: str, is_good: Callable[[float], bool]) -> MeshReadError:
    for number, line in enumerate(block.split(b"\n"), first):
        for word in line.split():
            values = numbers_of(word)
            if values is None or len(values) != 1 or not is_good(values[0]):
                return MeshReadError(
                    f"line {number}: {what} has {shown(word)}, not a finite number; "
                    "repair the line or the header's counts"
                )
    return MeshReadError(f"line {first}: no numbers of a {what} from there on; repair the lines")
