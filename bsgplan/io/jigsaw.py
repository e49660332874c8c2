"""Reader and writer of the meshes of JIGSAW, .msh (not those of Gmsh).

Grammar, records on lines of their own, numbers parted by semicolons, `#` starts a comment:

    MSHID=3;EUCLIDEAN-MESH            or ELLIPSOID-MESH: longitude and latitude in radians
    NDIMS=2                           or 3
    RADII=a;b;c                       of the ellipsoid
    POINT=n                           then n times  x;y[;z];tag
    VALUE=n;k                         then n times  k numbers at the points; POWER and SLOPE alike
    EDGE2=n                           then n times  a;b;tag; points count from 0
    TRIA3=n                           then n times  a;b;c;tag
    QUAD4=n                           then n times  a;b;c;d;tag; TRIA4, HEXA8, PYRA5, WEDG6 alike
    BOUND=n, SEEDS=n                  geometry, skipped

Names are read in any case. Grids (EUCLIDEAN-GRID, ELLIPSOID-GRID) are size fields, not meshes.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints
from ..atomic import replacing
from ..errors import MeshReadError
from ..words import counted
from .boundary import Boundary, labels
from .cell_rows import check_corners
from .file import MeshFile, RawMesh
from .number_table import shown
from .text_records import TextRecords, counts
from .text_write import table_lines
from .whole import cell_regions, warn_of_losses, whole_mesh

CELLS = {"EDGE2": 2, "TRIA3": 3, "QUAD4": 4, "TRIA4": 4, "HEXA8": 8, "PYRA5": 5, "WEDG6": 6}
"""Corners of a cell by the name of its section."""
IGNORED = {
    "EDGE2": "line", "QUAD4": "quad", "TRIA4": "tetra", "HEXA8": "hexahedron",
    "PYRA5": "pyramid", "WEDG6": "wedge",
}  # fmt: skip
"""What the cells that are not triangles are called."""
ARRAYS = ("VALUE", "SLOPE", "POWER")
MOST_COLUMNS = 1000
"""More numbers at a point than this are a mistake in the header."""
DEGREES = "longitude and latitude, radians in the file, are told in degrees"


@dataclass
class _Found:
    """The sections of a file."""

    kind: str = "euclidean-mesh"
    n_dimensions: int = 0
    points: Floats | None = None
    point_tags: Ints | None = None
    arrays: dict[str, Floats] = field(default_factory=dict)
    cells: dict[str, Ints] = field(default_factory=dict)
    """Corners and a tag, (n, k + 1)."""


def read_jigsaw(path: Path) -> RawMesh:
    """Return the points, cells, tags and values of a JIGSAW mesh; one on an ellipsoid in degrees."""
    found = _Found()
    with TextRecords(path, comment=b"#", separator=b";") as records:
        while (line := records.line()) is not None:
            _read_section(found, records, line)
    if found.kind.endswith("-grid"):
        raise MeshReadError("a JIGSAW grid, a size field without cells; give it with --size-file")
    if found.points is None:
        raise MeshReadError("no POINT section; fetch the whole file")
    n_points = len(found.points)
    for name, values in found.arrays.items():
        if len(values) != n_points:
            raise MeshReadError(f"{len(values)} rows of {name} for {n_points} points; repair the file")
    cells = {name: _corners(found, name, n_points) for name in ("EDGE2", "TRIA3", "QUAD4")}
    is_ellipsoid = found.kind == "ellipsoid-mesh"
    tags, quad_tags = _tags(found, "TRIA3"), _tags(found, "QUAD4")
    has_tags = bool(tags.any() or quad_tags.any())
    point_data = {name.lower(): values for name, values in found.arrays.items()}
    if found.point_tags is not None and found.point_tags.any():
        point_data["tag"] = found.point_tags.astype(np.float64)
    return RawMesh(
        points=np.rad2deg(found.points) if is_ellipsoid else found.points,
        triangles=cells["TRIA3"],
        quads=cells["QUAD4"],
        point_data=point_data,
        cell_data={"tag": tags.astype(np.float64)} if has_tags else {},
        quad_data={"tag": quad_tags.astype(np.float64)} if has_tags else {},
        boundaries=tuple(
            Boundary("named", np.unique(edges), tag, edges=edges)
            for tag in np.unique(_tags(found, "EDGE2")).tolist()
            for edges in [cells["EDGE2"][_tags(found, "EDGE2") == tag]]
        ),
        ignored={IGNORED[name]: len(rows) for name, rows in found.cells.items() if name in IGNORED},
        notes=(DEGREES,) if is_ellipsoid else (),
    )


def _read_section(found: _Found, records: TextRecords, line: bytes) -> None:
    name_text, equals, rest = line.partition(b"=")
    name, where = name_text.strip().decode("ascii", "replace").upper(), records.line_number
    if not equals:
        raise MeshReadError(f"line {where}: needs NAME=.., got {shown(line)}; repair the count above")
    if name == "MSHID":
        words = rest.decode("ascii", "replace").lower().split()
        found.kind = words[1] if len(words) > 1 else found.kind
    elif name == "NDIMS":
        (found.n_dimensions,) = counts(rest, where, ("the number of dimensions",))
        if found.n_dimensions not in (2, 3):
            raise MeshReadError(f"line {where}: {found.n_dimensions} dimensions; needs 2 or 3")
    elif name in ("POINT", "SEEDS"):
        _read_points(found, records, name, rest)
    elif name in ARRAYS:
        n_rows, n_columns = counts(rest, where, ("the number of rows", "the numbers on each"))
        if not 0 < n_columns <= MOST_COLUMNS:
            raise MeshReadError(f"line {where}: {n_columns} numbers at a point; needs 1 .. {MOST_COLUMNS}")
        table = records.rows(n_rows, name).columns(0, n_columns, name)
        if not found.kind.endswith("-grid"):
            found.arrays[name] = table[:, 0].copy() if n_columns == 1 else table
    elif name in CELLS:
        (n_rows,) = counts(rest, where, (f"the number of {name}",))
        found.cells[name] = records.rows(n_rows, name).integers(0, CELLS[name] + 1, name)
    elif name == "BOUND":
        records.rows(counts(rest, where, ("the number of rows",))[0], name)
    elif name == "COORD":
        records.rows(counts(rest, where, ("the axis", "the number of rows"))[1], name)
    elif name != "RADII":
        raise MeshReadError(f"line {where}: no section of JIGSAW is called {shown(name_text)}; delete it")


def _read_points(found: _Found, records: TextRecords, name: str, rest: bytes) -> None:
    where = records.line_number
    if not found.n_dimensions:
        raise MeshReadError(f"line {where}: {name} before NDIMS; put NDIMS=2 or NDIMS=3 above it")
    (n_rows,) = counts(rest, where, (f"the number of {name}",))
    rows = records.rows(n_rows, name)
    if name == "POINT":
        found.points = rows.columns(0, found.n_dimensions, name)
        found.point_tags = rows.integers(found.n_dimensions, found.n_dimensions + 1, name)[:, 0]


def _corners(found: _Found, name: str, n_points: int) -> Ints:
    if name not in found.cells:
        return np.empty((0, CELLS[name]), dtype=np.int64)
    corners = np.ascontiguousarray(found.cells[name][:, :-1])
    check_corners(corners, n_points, name)
    return corners


def _tags(found: _Found, name: str) -> Ints:
    return found.cells[name][:, -1] if name in found.cells else np.empty(0, dtype=np.int64)


def write_jigsaw(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write a Euclidean mesh with the point arrays value, slope, power and tag, regions as tags.

    Boundaries become edges whose tag is their number. What has no place is named in a warning. The file
    appears whole or not at all; raises OutputError where it cannot be written.
    """
    array = cell_regions(mesh_file).array
    n_named = len(mesh_file.boundaries)
    warn_of_losses(
        path,
        mesh_file,
        point_data=("value", "slope", "power", "tag"),
        cell_data=() if array is None else (array,),
        boundaries=("open", "land", "named"),
        also=[f"the names of {counted(n_named, 'boundary', 'boundaries')}, whose numbers are the tags"]
        * bool(n_named),
    )
    text = _text(mesh_file)
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        stream.writelines(text)


def _text(mesh_file: MeshFile) -> Iterator[str]:
    whole_of_file, regions = whole_mesh(mesh_file), cell_regions(mesh_file)
    points, data = whole_of_file.points, whole_of_file.point_data
    yield f"# written by bsgplan\nMSHID=3;EUCLIDEAN-MESH\nNDIMS={points.shape[1]}\nPOINT={len(points)}\n"
    tags = data.get("tag", np.zeros(len(points)))
    yield from table_lines("%r;" * points.shape[1] + "%d\n", points, np.rint(tags).astype(np.int64))
    for name in ("POWER", "VALUE", "SLOPE"):
        if name.lower() in data:
            values = data[name.lower()].reshape(len(points), -1)
            yield f"{name}={len(points)};{values.shape[1]}\n"
            yield from table_lines(";".join(["%r"] * values.shape[1]) + "\n", values)
    boundaries = whole_of_file.boundaries
    pairs = zip(boundaries, labels(boundaries), strict=True)
    edges = [np.column_stack([b.segments, np.full(len(b.segments), tag)]) for b, (tag, _) in pairs]
    rows = np.concatenate([np.empty((0, 3), dtype=np.int64), *edges])
    if len(rows):
        yield f"EDGE2={len(rows)}\n"
        yield from table_lines("%d;%d;%d\n", rows)
    ids = regions.ids if regions.array else np.zeros_like(regions.ids)
    yield f"TRIA3={len(ids)}\n"
    yield from table_lines("%d;%d;%d;%d\n", whole_of_file.triangles, ids)
    if len(whole_of_file.quads):
        yield f"QUAD4={len(whole_of_file.quads)}\n"
        yield from table_lines("%d;%d;%d;%d;0\n", whole_of_file.quads)
