"""Reader of MFEM meshes: conforming, versions 1.0, 1.2 and 1.3, planar, a surface, or the faces of a volume.

Grammar, free format, `#` begins a comment:

    MFEM mesh v1.0 | v1.2 | v1.3
    dimension   d
    elements    n     then n lines  attribute geometry vertex vertex ...
    attribute_sets    n      (1.3)  then n times  "name" count attribute attribute ...
    boundary    n     then n lines  attribute geometry vertex vertex ...
    bdr_attribute_sets  n    (1.3)  the same for the attributes of the boundary
    vertices    n     then  space_dimension  and n lines  x y [z];  or instead of these
    nodes             FiniteElementSpace, FiniteElementCollection: name, VDim: k, Ordering: 0 | 1, numbers
    mfem_mesh_end     (1.2, 1.3)

Vertices count from 0. Geometries: 0 point, 1 segment, 2 triangle, 3 square, 4 tetrahedron, 5 cube, 6 prism,
7 pyramid. Continuous nodes number the vertices first, whatever their order: curved meshes are taken by their
corners. Each boundary attribute becomes a boundary with the name of the first set that has it.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .boundary import Boundary
from .cell_rows import Cells, cells
from .file import RawMesh
from .number_table import shown
from .rows import NO_ROWS
from .text_records import TextRecords

GEOMETRIES = {
    0: ("vertex", 1), 1: ("line", 2), 2: ("triangle", 3), 3: ("quad", 4),
    4: ("tetra", 4), 5: ("hexahedron", 8), 6: ("wedge", 6), 7: ("pyramid", 5),
}  # fmt: skip
"""Name and number of corners of each geometry."""
VERSIONS = (b"v1.0", b"v1.2", b"v1.3")
CONTINUOUS = re.compile(rb"(H1_|H1Pos_|H1Ser_|H1@)|(Linear|Quadratic|QuadraticPos|Cubic)$")
"""Collections whose first degrees of freedom are the vertices."""
SET_NAME = re.compile(rb'"([^"]*)"')


def read_mfem(path: Path) -> RawMesh:
    """Return vertices, triangles, squares, attributes and the boundary of an MFEM mesh."""
    with TextRecords(path, comment=b"#") as records:
        _check_version(records.line() or b"")
        sections = _sections(records)
    return sections.raw_mesh()


class _Sections:
    """What the sections of a file hold, as they are read."""

    def __init__(self) -> None:
        self.dimension = 0
        self.elements: Cells | None = None
        self.boundary: Cells | None = None
        self.points: Floats | None = None
        self.n_vertices = -1
        self.names: dict[int, str] = {}

    def raw_mesh(self) -> RawMesh:
        """Return everything as one mesh; faces of a volume mesh come from its boundary."""
        if self.elements is None or self.points is None:
            missing = "elements" if self.elements is None else "vertices"
            raise MeshReadError(f"no section {missing!r}; fetch the whole file")
        boundary = self.boundary or cells(NO_ROWS, GEOMETRIES, "", has_tag=True)
        others = dict(self.elements.others)
        for part, where in ((self.elements, ""), (boundary, "boundary ")):
            part.check(len(self.points), where)
        triangles = np.concatenate([self.elements.triangles, boundary.triangles])
        quads = np.concatenate([self.elements.quads, boundary.quads])
        attributes = np.concatenate([self.elements.triangle_tags, boundary.triangle_tags])
        return RawMesh(
            points=self.points,
            triangles=triangles,
            quads=quads,
            cell_data={"attribute": attributes.astype(np.float64)},
            boundaries=_boundaries(boundary.lines, boundary.line_tags, self.names),
            ignored={"quad": len(quads), **others} if len(quads) else others,
        )


def _check_version(line: bytes) -> None:
    words = line.split()
    if words[:2] == [b"MFEM", b"mesh"] and words[2:] and words[2] in VERSIONS:
        return
    if words[:2] == [b"MFEM", b"mesh"] and words[2:3] != [b"v1.1"]:
        raise MeshReadError(f"line 1: version {shown(line)} is not known; save it as MFEM mesh v1.0")
    raise MeshReadError(
        f"line 1: {shown(line)}, only conforming meshes with vertices are read; save it with "
        "mesh.Print() as MFEM mesh v1.0, or as VTK with mesh.PrintVTK()"
    )


def _sections(records: TextRecords) -> _Sections:
    found = _Sections()
    while (line := records.line()) is not None:
        keyword = line.split()[0]
        if keyword == b"mfem_mesh_end":
            break
        if keyword == b"dimension":
            found.dimension = _count(records, "the dimension")
            if found.dimension not in (2, 3):
                raise MeshReadError(f"a mesh of dimension {found.dimension}; give one of triangles")
        elif keyword == b"elements":
            found.elements = _cells(records, "an element")
        elif keyword == b"boundary":
            found.boundary = _cells(records, "a boundary element")
        elif keyword == b"attribute_sets":
            _sets(records)
        elif keyword == b"bdr_attribute_sets":
            found.names = _sets(records)
        elif keyword == b"vertices":
            found.n_vertices = _count(records, "the number of vertices")
            if not records.peek()[:1].isalpha():
                n_columns = _count(records, "the space dimension")
                if n_columns not in (2, 3):
                    raise MeshReadError(f"line {records.line_number}: {n_columns} coordinates; repair it")
                rows = records.rows(found.n_vertices, "a vertex")
                found.points = rows.columns(0, n_columns, "a vertex")
        elif keyword == b"nodes":
            found.points = _nodes(records, found.n_vertices)
        else:
            raise MeshReadError(
                f"line {records.line_number}: {shown(line)} where a section begins; "
                "repair the count before it, or save the mesh as MFEM mesh v1.0"
            )
    return found


def _count(records: TextRecords, what: str) -> int:
    line = records.line() or b""
    count = _number(line)
    if count < 0:
        raise MeshReadError(f"line {records.line_number}: needs {what}, got {shown(line)}; repair it")
    return count


def _cells(records: TextRecords, what: str) -> Cells:
    n_rows = _count(records, f"the number of {what.split(' ', 1)[1]}s")
    return cells(records.rows(n_rows, what) if n_rows else NO_ROWS, GEOMETRIES, what, has_tag=True)


def _sets(records: TextRecords) -> dict[int, str]:
    """Return the name of each attribute: that of the first set that has it."""
    names: dict[int, str] = {}
    for _ in range(_count(records, "the number of sets")):
        line = records.line() or b""
        quoted = SET_NAME.match(line)
        words = line[quoted.end() :].split() if quoted else []
        while quoted and (not words or len(words) <= _number(words[0])) and records.peek()[:1].isdigit():
            words += (records.line() or b"").split()
        attributes = [_number(word) for word in words]
        if quoted is None or not attributes or attributes[0] != len(attributes) - 1 or min(attributes) < 0:
            raise MeshReadError(
                f'line {records.line_number}: needs a set ("name", count, attributes), got {shown(line)}; '
                "repair it"
            )
        for attribute in attributes[1:]:
            names.setdefault(attribute, quoted[1].decode("utf-8", "replace"))
    return names


def _number(word: bytes) -> int:
    return int(word) if word.isdigit() and len(word) <= 18 else -1


def _nodes(records: TextRecords, n_vertices: int) -> Floats:
    """Return the vertices among the nodes of a continuous finite element space."""
    header: dict[bytes, bytes] = {}
    records.line()  # FiniteElementSpace
    for _ in range(3):
        key, _, value = (records.line() or b"").partition(b":")
        header[key.strip()] = value.strip()
    collection = header.get(b"FiniteElementCollection", b"")
    dimension, ordering = header.get(b"VDim", b""), header.get(b"Ordering", b"")
    if not CONTINUOUS.match(collection) or dimension not in (b"2", b"3") or ordering not in (b"0", b"1"):
        raise MeshReadError(
            f"nodes of the collection {shown(collection)} with VDim {shown(dimension)} are no continuous "
            "points; save it without nodes (mesh.SetCurvature(-1)), or as VTK"
        )
    values, n_columns = records.numbers("a node"), int(dimension)
    n_nodes = len(values) // n_columns
    if len(values) != n_nodes * n_columns or not 0 <= n_vertices <= n_nodes:
        raise MeshReadError(
            f"{len(values)} numbers are no nodes of {n_vertices} vertices with {n_columns} coordinates; "
            "fetch the whole file"
        )
    table = values.reshape(n_columns, n_nodes).T if ordering == b"0" else values.reshape(n_nodes, n_columns)
    return np.ascontiguousarray(table[:n_vertices])


def _boundaries(lines: Ints, tags: Ints, names: dict[int, str]) -> tuple[Boundary, ...]:
    order = np.argsort(tags, kind="stable")
    found, starts = np.unique(tags[order], return_index=True)
    parts = np.split(lines[order], starts[1:])
    return tuple(
        Boundary("named", np.unique(part), tag, names.get(tag, ""), edges=part)
        for tag, part in zip(found.tolist(), parts, strict=False)
    )
