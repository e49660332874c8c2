"""Text files of cards, lines that begin with a word for their kind, read in chunks of bounded size.

A `Chunk` is about a megabyte of whole lines. Its `select` takes the lines of one kind out of it, its `table`
makes numbers of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..arrays import Bools, Floats, Ints
from ..errors import MeshReadError
from .byte_order_mark import skip_mark
from .number_table import FORTRAN_EXPONENT, first_bad_line, table_of_text, word_starts

CHUNK_BYTES = 2**20
"""Bytes read at once: the arrays made of a chunk stay near a processor's cache."""
LONGEST_LINE = 2**20
"""Bytes of a line: no text mesh has longer ones."""
WORD = 8
"""Characters of a line's first word that tell its kind."""


@dataclass(frozen=True, eq=False)
class Chunk:
    """Whole lines of a text file, each ending in a newline."""

    text: bytes
    line_numbers: Ints
    """Number of each line in its file, (n_lines,), from 1."""

    @property
    def n_lines(self) -> int:
        """Number of lines."""
        return len(self.line_numbers)

    @cached_property
    def characters(self) -> NDArray[np.uint8]:
        """The text as codes, (n,)."""
        return np.frombuffer(self.text, dtype=np.uint8)

    @cached_property
    def starts(self) -> Ints:
        """Where each line starts, and where the last one ends, (n_lines + 1,)."""
        ends = np.flatnonzero(self.characters == ord("\n")) + 1
        return np.concatenate([[0], ends]).astype(np.int64)

    @cached_property
    def first_characters(self) -> Ints:
        """Where the first word of each line starts, (n_lines,); the line's end where it is blank."""
        starts = self.starts[:-1]
        if (self.characters[starts] > ord(" ")).all():
            return starts
        words = np.append(np.flatnonzero(self.characters > ord(" ")), len(self.text))
        return np.minimum(words[np.searchsorted(words, starts)], self.starts[1:] - 1)

    @cached_property
    def kinds(self) -> NDArray[np.bytes_]:
        """The first characters of the first word of each line, (n_lines,), "" where it is blank."""
        if not self.n_lines:
            return np.empty(0, dtype=f"S{WORD}")
        place = self.first_characters[:, None] + np.arange(WORD)
        letters = self.characters[np.minimum(place, len(self.text) - 1)]
        is_word = np.logical_and.accumulate(letters > ord(" "), axis=1)
        return np.ascontiguousarray(np.where(is_word, letters, 0)).view(f"S{WORD}")[:, 0]

    @property
    def lines(self) -> list[bytes]:
        """The lines without their ends."""
        return self.text.split(b"\n")[:-1]

    def select(self, is_wanted: Bools, *, blank: int = 0) -> Chunk:
        """Return the chunk of the wanted lines, the first `blank` characters of their first words blanked."""
        if is_wanted.all():
            characters = self.characters.copy()
        else:
            characters = self.characters[np.repeat(is_wanted, np.diff(self.starts))]
        lengths = np.diff(self.starts)[is_wanted]
        if blank and len(lengths):
            starts = np.cumsum(lengths) - lengths
            words = starts + self.first_characters[is_wanted] - self.starts[:-1][is_wanted]
            characters[words[:, None] + np.arange(blank)] = ord(" ")
        return Chunk(characters.tobytes(), self.line_numbers[is_wanted])

    def part(self, first: int, stop: int) -> Chunk:
        """Return the chunk of lines first .. stop - 1."""
        return Chunk(self.text[self.starts[first] : self.starts[stop]], self.line_numbers[first:stop])

    def table(self, columns: Sequence[str], what: str) -> Floats | Ints:
        """Return the first numbers of each line, (n_lines, n_columns), as integers where all are whole.

        Text after the last wanted column is a comment, Fortran's D exponents are understood. Raises
        MeshReadError at the first line that does not begin with that many finite numbers.
        """
        if not self.n_lines:
            return np.empty((0, len(columns)))
        table = table_of_text(self.text, self.n_lines, len(columns))
        if table is None:
            cut = self._cut(len(columns)).translate(FORTRAN_EXPONENT)
            table = table_of_text(cut, self.n_lines, len(columns))
        if table is None or not np.isfinite(table).all():
            raise first_bad_line(self.lines, self.line_numbers.tolist(), columns, what)
        return table

    def _cut(self, n_words: int) -> bytes:
        """Return the text with only the first words of each line, blanks in the place of others."""
        words = word_starts(self.characters)
        first, after = np.searchsorted(words, self.starts[:-1]), np.searchsorted(words, self.starts[1:])
        is_long = after - first > n_words
        depth = np.zeros(len(self.text) + 1, dtype=np.int8)
        depth[words[first[is_long] + n_words]] = 1
        depth[self.starts[1:][is_long] - 1] -= 1
        is_over = np.cumsum(depth[:-1], dtype=np.int8).astype(bool)
        return np.where(is_over, np.uint8(ord(" ")), self.characters).tobytes()


def chunks(path: Path) -> Iterator[Chunk]:
    """Give the text of a file chunk by chunk; raises MeshReadError where it is no text."""
    first, rest = 1, b""
    for piece in pieces(path, CHUNK_BYTES):
        if b"\0" in piece:
            raise MeshReadError(f"binary data after line {first}, not a text; give the text file")
        end = piece.rfind(b"\n") + 1
        if not end:
            rest += piece
            if len(rest) > LONGEST_LINE:
                raise MeshReadError(f"line {first}: longer than {LONGEST_LINE} bytes; break it up")
            continue
        text, rest = rest + piece[:end], piece[end:]
        n_lines = text.count(b"\n")
        yield Chunk(text, np.arange(first, first + n_lines))
        first += n_lines
    if rest.strip():
        yield Chunk(rest + b"\n", np.array([first]))


def pieces(path: Path, n_bytes: int) -> Iterator[bytes]:
    """Give the bytes of a text file, so many at a time, without the mark before them."""
    with path.open("rb") as stream:
        skip_mark(stream)
        while piece := stream.read(n_bytes):
            yield piece


class Lines:
    """The lines of a text file from the first to the last, handed out in runs of as many as asked for."""

    def __init__(self, path: Path) -> None:
        self._chunks = chunks(path)
        self._rest = NOTHING

    def take(self, n_lines: int | None = None) -> Iterator[Chunk]:
        """Give the next n_lines in chunks, all that are left by default; fewer where the file ends."""
        left = n_lines
        while left is None or left > 0:
            chunk = self._rest if self._rest.n_lines else next(self._chunks, NOTHING)
            if not chunk.n_lines:
                return
            stop = chunk.n_lines if left is None else min(left, chunk.n_lines)
            self._rest = chunk.part(stop, chunk.n_lines)
            left = None if left is None else left - stop
            yield chunk.part(0, stop)


NOTHING = Chunk(b"", np.empty(0, dtype=np.int64))


def n_lines_of(path: Path) -> int:
    """Return the number of lines of a file up to the last that is not blank."""
    n_lines = n_ended = 0
    with path.open("rb") as stream:
        while piece := stream.read(CHUNK_BYTES):
            said = len(piece.rstrip())
            if said:
                n_lines = n_ended + piece.count(b"\n", 0, said) + 1
            n_ended += piece.count(b"\n")
    return n_lines
