"""Reader of Gmsh meshes of version 1.0.

Grammar, records on lines of their own:

    $NOD
    n
    id x y z                                       n times; ids distinct, in any order
    $ENDNOD
    $ELM
    n
    id type physical elementary n_points points    n times
    $ENDELM
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..arrays import Ints
from ..errors import MeshReadError
from .boundary import Boundary
from .file import RawMesh
from .number_table import shown
from .point_numbers import corner_indices, point_numbers
from .rows import Rows
from .text_records import TextRecords, counts

CORNERS = {2: 3, 9: 3, 3: 4, 10: 4, 16: 4, 1: 2, 8: 2}
"""Corners of the elements that are taken, lines and second order among them, by their type."""
N_POINTS = {1: 2, 2: 3, 3: 4, 4: 4, 5: 8, 6: 6, 7: 5, 8: 3, 9: 6, 10: 9, 15: 1, 16: 8}
NAMES = {1: "line", 8: "line3", 3: "quad", 10: "quad", 16: "quad", 15: "vertex",
    4: "tetra", 5: "hexahedron", 6: "wedge", 7: "pyramid"}  # fmt: skip
"""What the elements that are no triangles are called."""
PHYSICAL = "gmsh:physical"
FIXED = 5
"""Numbers of an element before its points."""


def read_gmsh1(path: Path) -> RawMesh:
    """Return the points, elements and physical groups of an MSH 1.0 file."""
    with TextRecords(path, comment=b"#") as records:
        points = records.rows(_open(records, b"$NOD"), "a point")
        _close(records, b"$ENDNOD")
        elements = records.rows(_open(records, b"$ELM"), "an element")
        _close(records, b"$ENDELM")
    numbers = point_numbers(points.integers(0, 1, "a point")[:, 0], points.line_numbers)
    rows = _by_type(elements)
    cells = {k: _cells(rows, k) for k in (2, 3, 4)}
    corners = {k: corner_indices(cell[:, 2:], numbers, cell[:, 0]) for k, cell in cells.items()}
    physical, of_quads = cells[3][:, 1], cells[4][:, 1]
    has_groups = bool(physical.any() or of_quads.any())
    groups = np.unique(cells[2][:, 1])
    ignored: dict[str, int] = {}
    for type_, of_type in rows.items():
        if CORNERS.get(type_) != 3:
            name = NAMES[type_]
            ignored[name] = ignored.get(name, 0) + len(of_type)
    return RawMesh(
        points=points.columns(1, 4, "a point"),
        triangles=corners[3],
        quads=corners[4],
        cell_data={PHYSICAL: physical.astype(np.float64)} if has_groups else {},
        quad_data={PHYSICAL: of_quads.astype(np.float64)} if has_groups else {},
        boundaries=tuple(
            Boundary("named", np.unique(edges), tag, edges=edges)
            for tag in groups[groups != 0].tolist()
            for edges in [corners[2][cells[2][:, 1] == tag]]
        ),
        ignored=ignored,
        is_counting=numbers.is_counting,
    )


def _open(records: TextRecords, keyword: bytes) -> int:
    line = records.line()
    if line != keyword:
        got = "the end of the file" if line is None else f"line {records.line_number}: {shown(line)}"
        raise MeshReadError(f"needs {keyword.decode()}, got {got}; fetch the whole file")
    header = records.line()
    return counts(header or b"", records.line_number, ("a count",))[0]


def _close(records: TextRecords, keyword: bytes) -> None:
    line = records.line()
    if line != keyword:
        got = "the end of the file" if line is None else shown(line)
        raise MeshReadError(
            f"line {records.line_number}: needs {keyword.decode()}, got {got}; repair the count above"
        )


def _by_type(elements: Rows) -> dict[int, Ints]:
    """Return line number, physical group and corners of the elements of each type, (n, 2 + k)."""
    header = elements.integers(0, FIXED, "an element")
    types, n_points = header[:, 1], header[:, 4]
    result = {}
    for type_ in np.unique(types).tolist():
        is_type = types == type_
        is_bad = is_type & (n_points != N_POINTS.get(type_, -1))
        if is_bad.any():
            k = int(np.flatnonzero(is_bad)[0])
            raise MeshReadError(
                f"line {elements.line_numbers[k]}: an element of type {type_} with {n_points[k]} points is "
                "none of Gmsh's; open the file in Gmsh and save it as MSH 2.2"
            )
        of_type = elements.of(is_type)
        corners = of_type.integers(FIXED, FIXED + CORNERS.get(type_, 0), "an element")
        result[type_] = np.column_stack([of_type.line_numbers, header[is_type, 2], corners])
    return result


def _cells(rows: dict[int, Ints], n_corners: int) -> Ints:
    """Return the elements with so many corners, in the order of the file, (n, 2 + n_corners)."""
    parts = [part for type_, part in rows.items() if CORNERS.get(type_) == n_corners]
    joined = np.concatenate([np.empty((0, 2 + n_corners), dtype=np.int64), *parts])
    return joined[np.argsort(joined[:, 0], kind="stable")]
