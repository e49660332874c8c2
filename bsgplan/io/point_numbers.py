"""Numbers that a file gives its points, and the way from such a number to an index."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .fort14 import MAX_ID, NodeNumbers


def point_numbers(ids: Ints, line_numbers: Ints) -> NodeNumbers:
    """Return the numbers of the points, (n_points,); raise MeshReadError where one stands twice."""
    numbers = NodeNumbers(ids)
    in_order = ids[numbers.order]
    is_repeated = in_order[1:] == in_order[:-1]
    if is_repeated.any():
        again = int(numbers.order[1:][is_repeated].min())
        before = int(np.flatnonzero(ids == ids[again])[0])
        raise MeshReadError(
            f"line {line_numbers[again]}: point {ids[again]} stands on line {line_numbers[before]} already; "
            "give each point a number of its own"
        )
    return numbers


def corner_indices(named: Ints, numbers: NodeNumbers, line_numbers: Ints) -> Ints:
    """Return the index of each named point, shaped like `named`; raise MeshReadError for an unknown one."""
    if not len(numbers.ids):
        raise MeshReadError("no line defines a point; fetch the whole file")
    index = numbers.index(named)
    if (index < 0).any():
        where = tuple(np.argwhere(index < 0)[0])
        raise MeshReadError(
            f"line {line_numbers[where[0]]}: names point {named[where]}, which no line defines "
            f"(points {numbers.ids.min()} .. {numbers.ids.max()}); repair the element or the points"
        )
    return index


def whole(values: Floats, line_numbers: Ints, what: str) -> Ints:
    """Return numbers, (n, ...), as integers; raise MeshReadError with the line of one that is none."""
    is_bad = (values != np.rint(values)) | (np.abs(values) > MAX_ID)
    if is_bad.any():
        where = tuple(np.argwhere(is_bad)[0])
        raise MeshReadError(
            f"line {line_numbers[where[0]]}: {what} {values[where]:g} is no whole number; repair the line"
        )
    return values.astype(np.int64)
