"""Rows of cells of mixed types, as SU2 and MFEM write them: a type, then as many corners as it has."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ..arrays import Ints
from ..errors import MeshReadError
from .rows import Rows


@dataclass(frozen=True, eq=False)
class Cells:
    """The cells of one section of a file: lines, triangles and quads apart, others counted."""

    lines: Ints
    """Ends of each line, (n_lines, 2)."""
    triangles: Ints
    """Corners of each triangle, (n_triangles, 3)."""
    quads: Ints
    """Corners of each quad, (n_quads, 4)."""
    line_tags: Ints
    """Number before the type in the row of each line, (n_lines,); 0 where the format has none."""
    triangle_tags: Ints
    """The same of each triangle, (n_triangles,)."""
    others: dict[str, int] = field(default_factory=dict)
    """Cells of all other types but points, by name, and how many."""

    @property
    def nodes(self) -> Ints:
        """Every corner of a line, triangle or quad once, sorted, (n_nodes,)."""
        return np.unique(np.concatenate([c.ravel() for c in (self.lines, self.triangles, self.quads)]))

    def check(self, n_points: int, where: str) -> None:
        """Raise MeshReadError at the first cell that names a point the file does not have."""
        for kind, corners in (("line", self.lines), ("triangle", self.triangles), ("quad", self.quads)):
            check_corners(corners, n_points, where + kind)


def cells(rows: Rows, types: Mapping[int, tuple[str, int]], what: str, *, has_tag: bool) -> Cells:
    """Return the cells of rows `[tag] type corner corner ...`; types gives name and corners of each type.

    Numbers after the last corner are left out. Raises MeshReadError with the line of the first row that is
    too short or of a type unknown.
    """
    first = int(has_tag)
    header = rows.integers(0, first + 1, what)
    types_found = set(np.unique(header[:, first]).tolist())
    unknown = types_found - set(types)
    if unknown:
        where = int(np.flatnonzero(np.isin(header[:, first], list(unknown)))[0])
        raise MeshReadError(
            f"line {rows.line_numbers[where]}: {what} of unknown type {header[where, first]}; "
            "repair the line or the header's counts"
        )
    corners = {name: np.empty((0, n), dtype=np.int64) for name, n in types.values()}
    tags = dict.fromkeys(corners, np.empty(0, dtype=np.int64))
    for number in sorted(types_found):
        name, n_corners = types[number]
        is_type = header[:, first] == number
        corners[name] = rows.of(is_type).integers(first + 1, first + 1 + n_corners, what)
        tags[name] = header[is_type, 0] if has_tag else np.zeros(np.count_nonzero(is_type), dtype=np.int64)
    others = {
        name: len(found)
        for name, found in corners.items()
        if len(found) and name not in ("vertex", "line", "triangle", "quad")
    }
    return Cells(
        corners["line"], corners["triangle"], corners["quad"], tags["line"], tags["triangle"], others
    )


def check_corners(corners: Ints, n_points: int, what: str) -> None:
    """Raise MeshReadError at the first cell that names a point outside 0 .. n_points - 1."""
    is_bad = ((corners < 0) | (corners >= n_points)).any(axis=1)
    if is_bad.any():
        first = int(np.flatnonzero(is_bad)[0])
        outside = next(c for c in corners[first].tolist() if not 0 <= c < n_points)
        raise MeshReadError(
            f"{what} {first} names point {outside}, the file has points 0 .. {n_points - 1}; repair the file"
        )
