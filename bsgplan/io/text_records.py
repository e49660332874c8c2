"""Text files read a bounded buffer at a time: single lines, and long blocks of rows of numbers.

Blank lines and comments are passed over but counted, so that every error names its line. Nothing is
allocated from the count that a header claims: rows are kept as they arrive.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import NamedTuple

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .byte_order_mark import skip_mark
from .number_table import LARGEST_WHOLE, numbers_of, shown, word_starts

BUFFER = 1 << 20
"""Bytes read at a time; no line may be longer."""
LETTER = re.compile(rb"(?m)^[ \t\r]*[A-Za-z]")


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


class TextRecords:
    """A text file open for reading; a context manager. `line_number` is that of the last line handed out."""

    def __init__(self, path: Path, *, comment: bytes, separator: bytes = b" ") -> None:
        self.stream = path.open("rb")
        skip_mark(self.stream)
        self.comment, self.separator = comment, separator
        self.line_number = 0
        self._text = b""
        self._position = 0
        self._line_start = 0

    def __enter__(self) -> TextRecords:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stream.close()

    def line(self) -> bytes | None:
        """Return the next line that says something, stripped, without its comment; None at the end."""
        while (line := self._raw_line()) is not None:
            said = line.partition(self.comment)[0].strip()
            if said:
                return said
        return None

    def peek(self) -> bytes:
        """Return what `line` would, without passing it; empty at the end."""
        line = self.line()
        if line is None:
            return b""
        self._position = self._line_start
        self.line_number -= 1
        return line

    def rows(self, n_rows: int, what: str) -> Rows:
        """Return the next n_rows rows of numbers; `what` names one of them in a message."""
        parts, n_found = list[Rows](), 0
        while n_found < n_rows:
            first = self.line_number + 1
            block = self._block(n_rows - n_found)
            if not block:
                raise MeshReadError(
                    f"the file ends after {n_found} of {n_rows} lines, {what} each; "
                    "repair the count or fetch the whole file"
                )
            parts.append(_rows(block, first, self.comment, what))
            n_found += len(parts[-1].line_numbers)
        return _joined(parts)

    def numbers(self, what: str) -> Floats:
        """Return all numbers up to the next line that begins with a letter, (n,), however they are broken."""
        parts: list[Floats | Ints] = [np.empty(0)]
        while (head := self.peek()) and not head[:1].isalpha():
            first = self.line_number + 1
            block = self._block(BUFFER)
            stop = LETTER.search(block)
            if stop:
                self._position -= len(block) - stop.start()
                self.line_number -= block.count(b"\n", stop.start()) + (not block.endswith(b"\n"))
                block = block[: stop.start()]
            parts.append(_rows(block, first, self.comment, what).values)
        return np.concatenate(parts)

    def _raw_line(self) -> bytes | None:
        while not (end := self._text.find(b"\n", self._position) + 1):
            if not self._refill():
                end = len(self._text)
                break
        if end == self._position:
            return None
        self._line_start, self._position = self._position, end
        self.line_number += 1
        return self._text[self._line_start : end]

    def _block(self, n_lines: int) -> bytes:
        """Return at most so many whole lines of the buffer, at least one; empty at the end of the file."""
        while self._text.find(b"\n", self._position) < 0 and self._refill():
            pass
        text = np.frombuffer(self._text, dtype=np.uint8)[self._position :]
        ends = np.flatnonzero(text == ord("\n"))[:n_lines]
        stop = int(ends[-1]) + 1 if len(ends) else len(text)
        block = self._text[self._position : self._position + stop]
        self._position += stop
        self.line_number += len(ends) or bool(block)
        return block

    def _refill(self) -> bool:
        """Drop what was handed out and read on; False at the end of the file."""
        rest = self._text[self._position :]
        if len(rest) > BUFFER:
            raise MeshReadError(
                f"line {self.line_number + 1} has more than {BUFFER} bytes, no line of a mesh; check the file"
            )
        more = self.stream.read(BUFFER)
        if self.separator != b" ":
            more = more.replace(self.separator, b" ")
        self._text, self._position = rest + more, 0
        return bool(more)


NO_ROWS = Rows(np.empty(0), np.zeros(1, dtype=np.int64), np.empty(0, dtype=np.int64))


def _rows(block: bytes, first: int, comment: bytes, what: str) -> Rows:
    """Return the rows of whole lines of text, of which the first has that line number."""
    if comment in block:
        block = re.sub(re.escape(comment) + rb"[^\n]*", b"", block)
    text = np.frombuffer(block, dtype=np.uint8)
    words = word_starts(text)
    if not len(words):
        return NO_ROWS
    values = numbers_of(block)
    if values is None or len(values) != len(words) or not np.isfinite(values).all():
        raise _first_bad_word(block, first, what)
    ends = np.append(np.flatnonzero(text == ord("\n")), len(text))
    lengths = np.diff(np.searchsorted(words, ends), prepend=0)
    is_row = lengths > 0
    starts = np.concatenate([[0], np.cumsum(lengths[is_row])])
    return Rows(values, starts, first + np.flatnonzero(is_row))


def _first_bad_word(block: bytes, first: int, what: str) -> MeshReadError:
    for number, line in enumerate(block.split(b"\n"), first):
        for word in line.split():
            values = numbers_of(word)
            if values is None or len(values) != 1 or not np.isfinite(values[0]):
                return MeshReadError(
                    f"line {number}: {what} has {shown(word)}, not a finite number; "
                    "repair the line or the header's counts"
                )
    return MeshReadError(f"line {first}: no numbers of a {what} from there on; repair the lines")


def _joined(parts: list[Rows]) -> Rows:
    parts = [part for part in parts if len(part.values)] or [NO_ROWS]
    offsets = np.cumsum([0] + [len(part.values) for part in parts])
    starts = [part.starts[:-1] + offset for part, offset in zip(parts, offsets, strict=False)]
    return Rows(
        np.concatenate([part.values for part in parts]),
        np.concatenate([*starts, offsets[-1:]]),
        np.concatenate([part.line_numbers for part in parts]),
    )


def counts(line: bytes, line_number: int, names: Sequence[str]) -> list[int]:
    """Return the whole numbers that a header line begins with; raise MeshReadError where they are missing."""
    words = line.split()[: len(names)]
    try:
        found = [int(word) for word in words]
    except ValueError:
        found = []
    if len(found) < len(names) or min(found) < 0:
        raise MeshReadError(
            f"line {line_number}: needs {', '.join(names)}, got {shown(line)}; repair the line"
        )
    return found
