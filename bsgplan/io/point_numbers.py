"""Numbers that a file gives its points, and the way from such a number to an index."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .number_table import LARGEST_WHOLE


class NodeNumbers:
    """The ids of a file's nodes, and the way from an id to an index."""

    def __init__(self, ids: Ints) -> None:
        self.ids = ids
        self.is_counting = bool((ids == np.arange(1, len(ids) + 1)).all())
        self.order = np.empty(0, np.int64) if self.is_counting else np.argsort(ids, kind="stable")

    def repeated(self) -> tuple[int, int] | None:
        """Return where the first id that stands a second time does, and where it stood; None if none does."""
        if self.is_counting:
            return None
        in_order = self.ids[self.order]
        is_repeated = in_order[1:] == in_order[:-1]
        if not is_repeated.any():
            return None
        again = int(self.order[1:][is_repeated].min())
        return again, int(np.flatnonzero(self.ids == self.ids[again])[0])

    def index(self, named: Ints) -> Ints:
        """Return the index of each id, -1 where no node has it."""
        if self.is_counting:
            return np.where((named >= 1) & (named <= len(self.ids)), named - 1, -1)
        place = np.minimum(np.searchsorted(self.ids, named, sorter=self.order), len(self.ids) - 1)
        found = self.order[place]
        return np.where(self.ids[found] == named, found, -1)


def point_numbers(ids: Ints, line_numbers: Ints) -> NodeNumbers:
    """Return the numbers of the points, (n_points,); raise MeshReadError where one stands twice."""
    numbers = NodeNumbers(ids)
    if (repeated := numbers.repeated()) is not None:
        again, before = repeated
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


def whole(values: Floats | Ints, line_numbers: Ints, what: str) -> Ints:
    """Return numbers, (n, ...), as integers; raise MeshReadError with the line of one that is none."""
    if values.dtype.kind == "i":
        return np.asarray(values, dtype=np.int64)
    is_bad = (values != np.rint(values)) | (np.abs(values) > LARGEST_WHOLE)
    if is_bad.any():
        where = tuple(np.argwhere(is_bad)[0])
        raise MeshReadError(
            f"line {line_numbers[where[0]]}: {what} {values[where]:g} is no whole number; repair the line"
        )
    return values.astype(np.int64)
