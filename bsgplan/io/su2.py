"""Reader of SU2 meshes: one zone or several, planar or a surface in space.

Grammar, one record a line, `%` begins a comment, sections in any order:

    NZONE= n                       several zones: each begins with  IZONE= k  and has points of its own
    NDIME= 2 | 3
    NELEM= n                       then n lines  type node node ... [index]
    NPOIN= n [n_without_halo]      then n lines  x y [z] [index]
    NMARK= n
    MARKER_TAG= name
    MARKER_ELEMS= n                [SEND_RECV= k]  then n lines  type node node ... [index]

Nodes count from 0 in each zone. Types are those of VTK: 3 line, 5 triangle, 9 quad, 10 tetrahedron, ...
Other keywords (FFD_.., NPERIODIC, NCHUNK, ..) and their lines are passed over. Zones are joined: their points
stay apart, and the cell array `zone` tells them. Triangles of markers in space are part of the mesh.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import MeshReadError
from .boundary import Boundary
from .cell_rows import Cells, cells
from .file import RawMesh
from .number_table import shown
from .rows import NO_ROWS
from .text_records import TextRecords

TYPES = {
    1: ("vertex", 1), 3: ("line", 2), 5: ("triangle", 3), 9: ("quad", 4),
    10: ("tetra", 4), 12: ("hexahedron", 8), 13: ("wedge", 6), 14: ("pyramid", 5),
}  # fmt: skip
"""Name and number of corners of each type of cell."""
SECTIONS = (b"NELEM", b"NPOIN", b"MARKER_ELEMS", b"SEND_RECV")
"""Keywords after which a line of numbers would be one too many."""


@dataclass
class Zone:
    """What one zone of a file holds, as it is read."""

    number: int
    dimension: int = 0
    points: Floats | None = None
    elements: Cells | None = None
    markers: list[tuple[str, Cells]] = field(default_factory=list)


def read_su2(path: Path) -> RawMesh:
    """Return points, cells and markers of all zones of an SU2 mesh."""
    with TextRecords(path, comment=b"%") as records:
        zones = _zones(records)
    return _joined(zones)


def _zones(records: TextRecords) -> list[Zone]:
    zones, n_zones = [Zone(1)], 1
    name, last_key = "", b""
    while (line := records.line()) is not None:
        key, equals, value = (part.strip() for part in line.partition(b"="))
        key, number = key.upper(), records.line_number
        if not equals:
            if last_key in SECTIONS and (line[:1].isdigit() or line[:1] in b"+-."):
                raise MeshReadError(
                    f"line {records.line_number}: {shown(line)} after the last line that {last_key.decode()} "
                    "counts; repair that count"
                )
            continue
        last_key, zone = key, zones[-1]
        if key == b"NZONE":
            n_zones = _count(records, key, value)
        elif key == b"IZONE":
            if zone.points is not None or zone.elements is not None:
                zones.append(Zone(len(zones) + 1))
        elif key == b"NDIME":
            zone.dimension = _count(records, key, value)
            if zone.dimension not in (2, 3):
                raise MeshReadError(f"line {number}: NDIME= {zone.dimension} is not 2 or 3; repair it")
        elif key == b"NELEM":
            _once(records, key, zone.elements)
            zone.elements = _cells(records, _count(records, key, value), "an element")
        elif key == b"NPOIN":
            _once(records, key, zone.points)
            if not zone.dimension:
                raise MeshReadError(f"line {number}: NPOIN= stands before NDIME=; put NDIME= first")
            rows = records.rows(_count(records, key, value), "a point")
            zone.points = rows.columns(0, zone.dimension, "a point")
        elif key == b"MARKER_TAG":
            name = value.decode("utf-8", "replace")
        elif key == b"MARKER_ELEMS":
            n_elements = _count(records, key, value)
            if records.peek().partition(b"=")[0].strip().upper() == b"SEND_RECV":
                records.line()
            zone.markers.append((name, _cells(records, n_elements, f"marker {name!r}")))
    if len(zones) != n_zones:
        raise MeshReadError(f"NZONE= {n_zones}, but {len(zones)} zones follow; fetch the whole file")
    return zones


def _count(records: TextRecords, key: bytes, value: bytes) -> int:
    words = value.split()
    if not words or not words[0].isdigit() or len(words[0]) > 18:
        what = key.decode("ascii", "replace")
        raise MeshReadError(f"line {records.line_number}: {what}= {shown(value)} is no count; repair it")
    return int(words[0])


def _once(records: TextRecords, key: bytes, found: object) -> None:
    if found is not None:
        raise MeshReadError(
            f"line {records.line_number}: {key.decode()}= stands twice in one zone; "
            "begin each zone with IZONE="
        )


def _cells(records: TextRecords, n_rows: int, what: str) -> Cells:
    return cells(records.rows(n_rows, what) if n_rows else NO_ROWS, TYPES, what, has_tag=False)


def _joined(zones: list[Zone]) -> RawMesh:
    """Return all zones as one mesh; markers keep their names, tags count up unless names are numbers."""
    dimension = max(zone.dimension for zone in zones)
    points, triangles, quads, zone_of, marker_of = [np.empty((0, dimension))], [], [], [], []
    boundaries: list[Boundary] = []
    ignored: dict[str, int] = {}
    n_points = tag = 0
    for zone in zones:
        if zone.points is None or zone.elements is None:
            missing = "NPOIN" if zone.points is None else "NELEM"
            raise MeshReadError(f"zone {zone.number} has no {missing}= section; fetch the whole file")
        where = f"zone {zone.number}, " if len(zones) > 1 else ""
        points.append(_in_dimension(zone.points, dimension))
        for name, found in [("", zone.elements), *zone.markers]:
            found.check(len(zone.points), where + (f"marker {name!r}, " if name else ""))
            triangles.append(found.triangles + n_points)
            quads.append(found.quads + n_points)
            zone_of.append(np.full(len(found.triangles), zone.number))
            if found is not zone.elements:
                tag = int(name) if _is_small_number(name) else tag + 1
                boundaries.append(
                    Boundary("named", found.nodes + n_points, tag, name, edges=found.lines + n_points)
                )
            marker_of.append(np.full(len(found.triangles), 0 if found is zone.elements else tag))
            for kind, count in (("quad", len(found.quads)), *found.others.items()):
                ignored[kind] = ignored.get(kind, 0) + count
        n_points += len(zone.points)
    cell_data = {"zone": np.concatenate(zone_of)} if len(zones) > 1 else {}
    if np.any(markers := np.concatenate(marker_of)):
        cell_data["marker"] = markers
    return RawMesh(
        points=np.concatenate(points),
        triangles=np.concatenate(triangles),
        quads=np.concatenate(quads),
        cell_data={key: values.astype(np.float64) for key, values in cell_data.items()},
        boundaries=tuple(boundaries),
        ignored={kind: count for kind, count in ignored.items() if count},
        notes=(f"{len(zones)} zones joined, their points stay apart",) if len(zones) > 1 else (),
    )


def _in_dimension(points: Floats, dimension: int) -> Floats:
    return np.column_stack([points, np.zeros((len(points), dimension - points.shape[1]))])


def _is_small_number(name: str) -> bool:
    digits = name.removeprefix("-")
    return digits.isascii() and digits.isdigit() and len(digits) < 18
