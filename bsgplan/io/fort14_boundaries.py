"""The boundary lists at the end of a fort.14: open segments, then land segments with their weirs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import takewhile

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .boundary import Boundary, Kind
from .number_table import FORTRAN_EXPONENT, shown

BARRIER_COLUMNS = {3: 3, 13: 3, 23: 3, 4: 5, 14: 5, 24: 5, 64: 5, 5: 8, 25: 8}
"""Numbers at each node of a segment with this IBTYPE; other types have the node alone."""
PAIRED = (4, 14, 24, 64, 5, 25)
"""IBTYPEs whose second number is the node on the other side."""
REMEDY = "complete the boundary lists, or delete them all"


def read_boundaries(
    lines: Sequence[bytes], first: int, index: Callable[[Ints], Ints]
) -> tuple[Boundary, ...]:
    """Return the segments of the lines from line number `first` on; index gives a node's index by id."""
    records = [(number, line) for number, line in enumerate(lines, first) if line.strip()]
    boundaries: list[Boundary] = []
    position = 0
    kinds: tuple[Kind, ...] = ("open", "land")
    for kind in kinds:
        if position == len(records):  # no lists at all, or no land after the open ones
            break
        n_segments = _count(records, position, f"the number of {kind} boundaries")[0]
        if n_segments or position + 1 < len(records):
            _count(records, position + 1, f"the total number of {kind} boundary nodes")
        position += 2
        for segment in range(1, n_segments + 1):
            what = f"the number of nodes of {kind} boundary {segment}"
            n_nodes, code = _count(records, position, what)
            if n_nodes > len(records) - position - 1:
                raise MeshReadError(
                    f"line {records[position][0]}: {kind} boundary {segment} claims {n_nodes} nodes, "
                    f"only {len(records) - position - 1} lines follow; {REMEDY}"
                )
            rows = records[position + 1 : position + 1 + n_nodes]
            boundaries.append(_segment(kind, code, rows, index))
            position += 1 + n_nodes
    return tuple(boundaries)


def _count(records: Sequence[tuple[int, bytes]], position: int, what: str) -> tuple[int, int | None]:
    if position >= len(records):
        raise MeshReadError(f"the file ends before {what}; {REMEDY}")
    number, line = records[position]
    values = [_integer(word) for word in _before_comment(line)[:2]]
    if not values or values[0] is None or values[0] < 0:
        raise MeshReadError(f"line {number}: needs {what}, got {shown(line)}; {REMEDY}")
    return values[0], values[1] if len(values) > 1 else None


def _segment(
    kind: Kind, code: int | None, rows: Sequence[tuple[int, bytes]], index: Callable[[Ints], Ints]
) -> Boundary:
    n_columns = BARRIER_COLUMNS.get(code, 1) if kind == "land" and code is not None else 1
    table = [_row(number, line, n_columns) for number, line in rows]
    values = np.array(table, dtype=np.float64).reshape(len(rows), n_columns)
    nodes = _indices(values[:, 0], rows, index)
    is_paired = n_columns > 1 and code in PAIRED
    partners = _indices(values[:, 1], rows, index) if is_paired else None
    columns = values[:, 2 if is_paired else 1 :]
    return Boundary(kind, nodes, code, partners=partners, columns=columns if columns.shape[1] else None)


def _row(number: int, line: bytes, n_columns: int) -> list[float]:
    words = _before_comment(line)[:n_columns]
    values = [_number(word) for word in words]
    if len(values) < n_columns or not np.isfinite(values).all():
        wanted = "a node" if n_columns == 1 else f"a barrier with {n_columns} numbers"
        raise MeshReadError(f"line {number}: needs {wanted}, got {shown(line)}; {REMEDY}")
    return values


def _indices(named: Floats, rows: Sequence[tuple[int, bytes]], index: Callable[[Ints], Ints]) -> Ints:
    is_whole = (named == np.rint(named)) & (np.abs(named) <= 2**53)
    found = np.where(is_whole, index(np.where(is_whole, named, 0).astype(np.int64)), -1)
    if (found < 0).any():
        where = int(np.flatnonzero(found < 0)[0])
        raise MeshReadError(
            f"line {rows[where][0]}: the boundary names node {named[where]:g}, "
            f"which is not in the file; {REMEDY}"
        )
    return found


def _before_comment(line: bytes) -> list[bytes]:
    words = line.replace(b"!", b" ! ").replace(b"=", b" = ").split()
    return list(takewhile(lambda word: word not in (b"!", b"="), words))


def _integer(word: bytes) -> int | None:
    try:
        return int(word)
    except ValueError:
        return None


def _number(word: bytes) -> float:
    try:
        return float(word.translate(FORTRAN_EXPONENT))
    except ValueError:
        return float("nan")
