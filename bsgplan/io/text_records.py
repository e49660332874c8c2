"""Text files read a bounded buffer at a time: single lines, and long blocks of rows of numbers.

Blank lines and comments are passed over but counted, so that every error names its line. Nothing is
allocated from the count that a header claims: rows are kept as they arrive.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .byte_order_mark import skip_mark
from .growing import Growing
from .number_table import shown, word_starts
from .rows import Rows, finite_numbers, joined, rows_of

BUFFER = 1 << 20
"""Bytes read at a time; no line may be longer, but where its numbers are read by `TextRecords.numbers`."""
WINDOW = 1 << 12
"""Bytes of the buffer looked at first: many short runs of rows cost no more than a long one."""
WORD = re.compile(rb"\s*+(\S*+)")
NUMBER = re.compile(rb"(?i)(nan|inf|infinity)(?!\S)")
"""Words that begin with a letter and are numbers."""
KEYWORD_BYTES = 64
"""Bytes of a keyword, at the most."""


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
        self._comment_goes_on = False

    def __enter__(self) -> TextRecords:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stream.close()

    def line(self) -> bytes | None:
        """Return the next line that says something, stripped, without its comment; None at the end."""
        while (line := self._raw_line()) is not None:
            said = line.strip()
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
            parts.append(rows_of(block, first, what))
            n_found += len(parts[-1].line_numbers)
        return joined(parts)

    def numbers(self, what: str, *, read: Callable[..., Floats | Ints] = finite_numbers) -> Floats:
        """Return all numbers up to the next word that begins with a letter, (n,), however they are broken.

        `read` makes numbers of words: `finite_numbers`, or `all_numbers` where NaN passes.
        """
        numbers, window = Growing(1), WINDOW
        while block := self._words(window):
            first = self.line_number + 1
            words = word_starts(np.frombuffer(block, dtype=np.uint8))
            stop = _keyword(block, words)
            is_last = stop < len(block)
            if is_last:
                words = words[: np.searchsorted(words, stop)]
            values = read(block[:stop], first, what, n_words=len(words)) if len(words) else np.empty(0)
            numbers.add(np.asarray(values, dtype=np.float64)[:, None])
            self._pass(stop)
            if is_last:
                break
            window = min(2 * window, BUFFER)
        return numbers.taken()[:, 0]

    def word(self) -> bytes:
        """Return the next word, empty at the end."""
        while True:
            found = next(WORD.finditer(self._text, self._position))  # the empty word is one too
            self._pass(found.start(1) - self._position)
            if found.end() < len(self._text) or not self._refill():
                self._pass(len(found[1]))
                return found[1]

    def skip_to(self, keyword: re.Pattern[bytes]) -> None:
        """Stand behind the next keyword, found with the blank behind it, or at the end."""
        while not (found := keyword.search(self._text, self._position)):
            self._pass(max(len(self._text) - KEYWORD_BYTES - self._position, 0))
            if not self._refill():
                self._pass(len(self._text) - self._position)
                return
        self._pass(found.end() - self._position)

    def _pass(self, n_bytes: int) -> None:
        stop = self._position + n_bytes
        self.line_number += self._text.count(b"\n", self._position, stop)
        self._position = stop

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
        window = max(WINDOW, 8 * min(n_lines, BUFFER))
        while True:
            text = np.frombuffer(self._text, dtype=np.uint8)[self._position : self._position + window]
            ends = np.flatnonzero(text == ord("\n"))[:n_lines]
            if len(ends) == n_lines or len(text) < window:
                break
            window *= 4
        stop = int(ends[-1]) + 1 if len(ends) else len(text)
        block = self._text[self._position : self._position + stop]
        self._position += stop
        self.line_number += len(ends) or bool(block)
        return block

    def _words(self, window: int) -> bytes:
        """Return whole words that come next, about a window of them, not yet passed; empty at the end."""
        while True:
            limit = self._position + window
            stop = 1 + max(self._text.rfind(blank, self._position, limit) for blank in (b"\n", b" ", b"\t"))
            if stop > self._position:
                return self._text[self._position : stop]
            if limit < len(self._text):
                window *= 4
            elif not self._refill():
                return self._text[self._position :]

    def _refill(self) -> bool:
        """Drop what was handed out and read on, a blank for each byte of a comment; False at the end."""
        rest = self._text[self._position :]
        if len(rest) > BUFFER:
            raise MeshReadError(
                f"line {self.line_number + 1} has more than {BUFFER} bytes, no line of a mesh; check the file"
            )
        more = self.stream.read(BUFFER)
        if self._comment_goes_on or self.comment in more:
            more = self._without_comments(more)
        if self.separator != b" ":
            more = more.replace(self.separator, b" ")
        self._text, self._position = rest + more, 0
        return bool(more)

    def _without_comments(self, text: bytes) -> bytes:
        lines = self.comment + text if self._comment_goes_on else text
        cleared = re.sub(re.escape(self.comment) + rb"[^\n]*+", lambda found: b" " * len(found[0]), lines)
        self._comment_goes_on = self.comment in lines[lines.rfind(b"\n") + 1 :]
        return cleared[len(lines) - len(text) :]


def _keyword(block: bytes, words: Ints) -> int:
    """Return where the first of the words begins that begins with a letter and is no number, or the end."""
    first = np.frombuffer(block, dtype=np.uint8)[words] | 32
    letters = words[(first >= ord("a")) & (first <= ord("z"))]
    return next((at for at in letters.tolist() if not NUMBER.match(block, at)), len(block))


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
