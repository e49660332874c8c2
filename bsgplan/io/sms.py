"""Reader of the SMS two-dimensional mesh, .2dm (Aquaveo SMS, BlueKenue, QGIS, BASEMENT, SCHISM tools).

Grammar, one card a line, in any order, words parted by blanks:

    MESH2D                                first line
    MESHNAME "name"
    ND id x y z                           a point; ids distinct, in any order; z is depth or elevation
    E3T id n1 n2 n3 [material]            a triangle; quads are E4Q
    E6T id n1 .. n6 [material]            with a point on each side: corner, side, corner, ..; E8Q, E9Q alike
    NS n1 n2 .. n10                       a nodestring, over as many lines as it needs; its last point is
    NS n11 -n12 [id] [name]               negative, an id and a name may follow
    MAT id "name"                         name of a material

Lines of elements (E2L, E3L) are counted; other cards concern SMS alone.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .boundary import Boundary
from .chunks import Chunk, chunks
from .file import RawMesh
from .number_table import shown
from .point_numbers import NodeNumbers, corner_indices, point_numbers, whole

CORNERS = {
    b"E3T": (1, 2, 3), b"E6T": (1, 3, 5),
    b"E4Q": (1, 2, 3, 4), b"E8Q": (1, 3, 5, 7), b"E9Q": (1, 3, 5, 7),
}  # fmt: skip
"""Which of its points are the corners of an element, by its card."""
N_POINTS = {b"E3T": 3, b"E6T": 6, b"E4Q": 4, b"E8Q": 8, b"E9Q": 9}
LINES = {b"E2L": "line", b"E3L": "line3"}
NO_MATERIAL = 0
"""Material of an element whose card names none."""


@dataclass
class _Found:
    """What the chunks hold, gathered card by card."""

    points: list[Floats] = field(default_factory=list)
    point_lines: list[Ints] = field(default_factory=list)
    cells: dict[int, list[Ints]] = field(default_factory=lambda: {3: [], 4: []})
    cell_lines: dict[int, list[Ints]] = field(default_factory=lambda: {3: [], 4: []})
    materials: dict[int, list[Floats]] = field(default_factory=lambda: {3: [], 4: []})
    strings: list[tuple[int, bytes]] = field(default_factory=list)
    names: dict[int, str] = field(default_factory=dict)
    ignored: dict[str, int] = field(default_factory=dict)
    title: str = ""


def read_2dm(path: Path) -> RawMesh:
    """Return the points with their third number as depth, elements, materials and nodestrings of a .2dm."""
    found = _Found()
    for chunk in chunks(path):
        kinds = chunk.kinds
        for kind in np.unique(kinds).tolist():
            if kind in (b"ND", b"NS", b"MAT", b"MESHNAME") or kind in CORNERS or kind in LINES:
                _take(found, kind, chunk.select(kinds == kind, blank=len(kind)))
    if not found.points:
        raise MeshReadError("no ND line defines a point; fetch the whole file")
    table, lines = np.concatenate(found.points), np.concatenate(found.point_lines)
    numbers = point_numbers(whole(table[:, 0], lines, "the number of a point"), lines)
    triangles, materials = _cells(found, 3, numbers)
    quads, of_quads = _cells(found, 4, numbers)
    has_materials = bool((materials != NO_MATERIAL).any() or (of_quads != NO_MATERIAL).any())
    return RawMesh(
        points=np.ascontiguousarray(table[:, 1:3]),
        triangles=triangles,
        quads=quads,
        point_data={"depth": table[:, 3].copy()},
        cell_data={"material": materials} if has_materials else {},
        quad_data={"material": of_quads} if has_materials else {},
        boundaries=_nodestrings(found.strings, numbers),
        ignored={**({"quad": len(quads)} if len(quads) else {}), **found.ignored},
        title=found.title,
        is_counting=numbers.is_counting,
        cell_names={"material": found.names} if found.names else {},
    )


def _take(found: _Found, kind: bytes, chunk: Chunk) -> None:
    if kind == b"ND":
        found.points.append(chunk.table(("id", "x", "y", "z"), "a point (ND)").astype(np.float64))
        found.point_lines.append(chunk.line_numbers)
    elif kind in CORNERS:
        _take_elements(found, kind, chunk)
    elif kind in LINES:
        found.ignored[LINES[kind]] = found.ignored.get(LINES[kind], 0) + chunk.n_lines
    elif kind == b"NS":
        found.strings += zip(chunk.line_numbers.tolist(), chunk.lines, strict=True)
    elif kind == b"MESHNAME":
        found.title = _unquoted(chunk.lines[0])
    else:
        for line in chunk.lines:
            words = line.split(None, 1)
            if len(words) == 2 and words[0].lstrip(b"-").isdigit():
                found.names[int(words[0])] = _unquoted(words[1])


def _take_elements(found: _Found, kind: bytes, chunk: Chunk) -> None:
    n = N_POINTS[kind]
    columns = ("id", *(f"point {k}" for k in range(1, n + 1)))
    what = f"an element ({kind.decode()})"
    try:
        table = chunk.table((*columns, "material"), what)
        material = table[:, n + 1].astype(np.float64)
    except MeshReadError:
        table = chunk.table(columns, what)
        material = np.full(chunk.n_lines, float(NO_MATERIAL))
    corners = CORNERS[kind]
    found.cells[len(corners)].append(whole(table[:, corners], chunk.line_numbers, "a point"))
    found.cell_lines[len(corners)].append(chunk.line_numbers)
    found.materials[len(corners)].append(material)


def _cells(found: _Found, n_corners: int, numbers: NodeNumbers) -> tuple[Ints, Floats]:
    """Return the corners of the cells as indices and their materials, both in the order of the file."""
    named = np.concatenate([np.empty((0, n_corners), dtype=np.int64), *found.cells[n_corners]])
    lines = np.concatenate([np.empty(0, dtype=np.int64), *found.cell_lines[n_corners]])
    order = np.argsort(lines, kind="stable")
    materials = np.concatenate([np.empty(0), *found.materials[n_corners]])
    return corner_indices(named[order], numbers, lines[order]), materials[order]


def _nodestrings(rows: Sequence[tuple[int, bytes]], numbers: NodeNumbers) -> tuple[Boundary, ...]:
    result: list[Boundary] = []
    named: list[int] = []
    lines: list[int] = []
    for line_number, line in rows:
        words = line.split()
        while words:
            word = words.pop(0)
            try:
                number = int(word)
            except ValueError:
                raise MeshReadError(
                    f"line {line_number}: a nodestring names points, got {shown(word)}; repair the line"
                ) from None
            named.append(abs(number))
            lines.append(line_number)
            if number < 0:
                code, name = _label(words, len(result) + 1)
                nodes = corner_indices(np.array(named), numbers, np.array(lines))
                result.append(Boundary("named", nodes, code, name))
                named, lines = [], []
                break
    if named:
        raise MeshReadError(
            f"line {lines[-1]}: the nodestring has no end; make its last point negative, as -{named[-1]}"
        )
    return tuple(result)


def _label(words: Sequence[bytes], number: int) -> tuple[int, str]:
    """Return the id and the name that follow a nodestring, its place in the file where there is no id."""
    code, rest = number, list(words)
    if rest and re.fullmatch(rb"\d+", rest[0]):
        code = int(rest.pop(0))
    return code, _unquoted(b" ".join(rest))


def _unquoted(text: bytes) -> str:
    return text.decode("utf-8", "replace").strip().strip("\"'").strip()
