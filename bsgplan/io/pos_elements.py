"""The elements of a Gmsh view as tables: brackets and commas of a text found, numbers read at once."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .number_table import numbers_with_commas
from .pos_text import BETWEEN, shown

CORNERS = {b"SP": 1, b"SL": 2, b"ST": 3, b"SQ": 4, b"SL2": 2, b"ST2": 3, b"SQ2": 4}
"""Kinds of element that carry a scalar, and their corners."""
KIND = re.compile(rb"[\s;}]*+([A-Z]+\d?)\s*+")
TIME = re.compile(rb"TIME\s*+\{[^{}]*+\}")
MARKS = bytes(byte in b"(){}," for byte in range(256))
"""1 for every byte that parts an element, 0 for all others."""
COMMA, CLOSING = ord(","), ord("}")
ORDER = np.frombuffer(b"(){}", dtype=np.uint8)
"""The brackets of every element."""
JOINS = bytes.maketrans(b"){", b" ,")
"""Values follow the coordinates as one more number after a comma."""


class Elements(NamedTuple):
    """Elements of one kind."""

    kind: str
    places: Floats
    """Corner coordinates, (n, n_corners, 3)."""
    values: Floats
    """Values of the first time step at the corners, (n, n_corners)."""


class ElementReader:
    """Reads the elements of one view, part by part; of every element of a kind as many numbers are wanted."""

    def __init__(self) -> None:
        self.kinds: set[str] = set()
        """All kinds seen so far, those without scalars too."""
        self._widths: dict[bytes, tuple[int, int]] = {}

    def read(self, text: bytes) -> Iterator[Elements]:
        """Give the scalar elements of a text kind by kind, in alphabetical order; raises MeshReadError."""
        text = TIME.sub(b"", text) if b"TIME" in text else text
        ends, n_commas = _brackets(text)
        if not len(ends):
            return
        kinds = _kinds(text, ends)
        there = set(kinds)
        self.kinds.update(kind.decode() for kind in there)
        for kind in sorted(there & set(CORNERS)):
            which = slice(None) if len(there) == 1 else np.array([k == kind for k in kinds])
            yield self._table(text, kind, ends[which], n_commas[which])

    def _table(self, text: bytes, kind: bytes, ends: Ints, n_commas: Ints) -> Elements:
        n = CORNERS[kind]
        least = n_commas.min(axis=0) + 1
        n_coordinates, n_values = self._widths.setdefault(kind, (int(least[0]), int(least[1])))
        width = n_coordinates + n_values
        is_even = (n_commas == (n_coordinates - 1, n_values - 1)).all() and n_coordinates >= 3 * n
        numbers = (
            numbers_with_commas(_rows(text, ends), width * len(ends)) if is_even and n_values >= n else None
        )
        if numbers is None:
            raise _wrong(text, kind, ends, n_coordinates, n_values)
        table = numbers.reshape(-1, width)
        places = table[:, : 3 * n].reshape(-1, n, 3)
        return Elements(kind.decode(), places, table[:, n_coordinates : n_coordinates + n])


def _brackets(text: bytes) -> tuple[Ints, Ints]:
    """Return where the four brackets of each element are, (n, 4), and the commas in both pairs, (n, 2)."""
    marks = np.flatnonzero(np.frombuffer(text.translate(MARKS), dtype=bool))
    codes = np.frombuffer(text, dtype=np.uint8)[marks]
    brackets = np.flatnonzero(codes != COMMA)
    codes = codes[brackets]
    is_end_of_view = (codes == CLOSING) & (np.concatenate([[CLOSING], codes[:-1]]) == CLOSING)
    if is_end_of_view.any():
        brackets, codes = brackets[~is_end_of_view], codes[~is_end_of_view]
    n = len(codes) // 4
    is_element = (codes[: 4 * n].reshape(n, 4) == ORDER).all(axis=1)
    ends = marks[brackets[: 4 * n]].reshape(n, 4)
    after = text[ends[-1, 3] + 1 :] if n else text
    if not is_element.all():
        first = int(np.flatnonzero(~is_element)[0])
        raise _stray(text[ends[first - 1, 3] + 1 :] if first else text)
    if after.strip(BETWEEN):
        raise _stray(after)
    for k in np.flatnonzero(ends[:, 2] != ends[:, 1] + 1).tolist():
        if text[ends[k, 1] + 1 : ends[k, 2]].strip():
            raise _stray(text[ends[k, 0] : ends[k, 3]])
    return ends, np.diff(brackets[: 4 * n].reshape(n, 4), axis=1)[:, ::2] - 1


def _kinds(text: bytes, ends: Ints) -> list[bytes]:
    """Return the kind of each element."""
    starts = np.concatenate([[0], ends[:-1, 3] + 1])
    heads = [text[start:stop] for start, stop in zip(starts.tolist(), ends[:, 0].tolist(), strict=True)]
    kinds: dict[bytes, bytes] = {}
    for head in dict.fromkeys(heads):
        found = KIND.fullmatch(head)
        if not found:
            raise _stray(head + b"(")
        kinds[head] = found[1]
    return [kinds[head] for head in heads]


def _rows(text: bytes, ends: Ints) -> bytes:
    """Return the coordinates and values of elements, commas between all of them."""
    starts, stops = (ends[:, 0] + 1).tolist(), ends[:, 3].tolist()
    return b",".join([text[start:stop] for start, stop in zip(starts, stops, strict=True)]).translate(JOINS)


def _stray(text: bytes) -> MeshReadError:
    return MeshReadError(f"{shown(text)} stands between the elements of a view; repair the file")


def _wrong(text: bytes, kind: bytes, ends: Ints, n_coordinates: int, n_values: int) -> MeshReadError:
    """Return the error of the first element without the wanted numbers, coordinates before values."""
    n = CORNERS[kind]
    sides = (("coordinates", max(n_coordinates, 3 * n), 3 * n, 0), ("values", max(n_values, n), n, 2))
    rows = ends.tolist()
    what, least, words = next(
        (
            (what, least, text[row[first] + 1 : row[first + 1]])
            for what, wanted, least, first in sides
            for row in rows
            if not _is_row(text[row[first] + 1 : row[first + 1]].split(b","), wanted)
        ),
        ("coordinates", 3 * n, text[rows[0][0] + 1 : rows[0][1]]),
    )
    return MeshReadError(
        f"{kind.decode()} with {what} {shown(words)}; {least} plain numbers with commas between "
        "are needed, and of every element as many"
    )


def _is_row(words: Sequence[bytes], n: int) -> bool:
    try:
        return len([float(word) for word in words]) == n
    except ValueError:
        return False
