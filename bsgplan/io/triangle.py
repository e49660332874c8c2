"""Reader and writer of the files of Triangle (Shewchuk): points in .node, triangles in .ele, side by side.

Grammar, records on lines of their own, `#` starts a comment:

    n_points 2 n_attributes n_markers         .node; markers 0 or 1
    id x y [attributes] [marker]                n_points times; ids count from 0 or 1
    n_triangles n_corners n_attributes        .ele; 3 corners, or 6 with the points on the sides after them
    id n1 n2 n3 [n4 n5 n6] [attributes]         n_triangles times

Attributes become the arrays `attribute`, or `attribute 1`, `attribute 2`, .., markers the array `marker`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints
from ..atomic import replacing
from ..errors import MeshReadError, OutputError
from ..words import counted
from .boundary import labels
from .file import MeshFile, RawMesh
from .point_numbers import corner_indices, point_numbers
from .text_records import TextRecords, counts
from .text_write import counting, table_lines
from .whole import warn_of_losses, whole_mesh

MARKER = "marker"
NODE, ELE = ".node", ".ele"
MOST_ATTRIBUTES = 1000
"""More columns than this are a mistake in the header."""


def read_triangle(path: Path) -> RawMesh:
    """Return the points, triangles, attributes and markers of a .node and its .ele, whichever is named."""
    points_path, cells_path = both_paths(path)
    other = points_path if path.suffix.lower() == ELE else cells_path
    if not other.exists():
        raise MeshReadError(f"needs {other.name} beside it, which is not there; put both into one folder")
    try:
        points, point_columns, ids, point_lines = _read_points(points_path)
        numbers = point_numbers(ids, point_lines)
    except MeshReadError as error:
        raise _of_file(error, points_path, path) from None
    try:
        named, cell_columns, cell_lines = _read_cells(cells_path)
        triangles = corner_indices(named, numbers, cell_lines)
    except MeshReadError as error:
        raise _of_file(error, cells_path, path) from None
    return RawMesh(
        points=points,
        triangles=triangles,
        quads=np.empty((0, 4), dtype=np.int64),
        point_data=point_columns,
        cell_data=cell_columns,
        is_counting=bool((np.diff(ids) == 1).all() and ids[0] in (0, 1)),
    )


def both_paths(path: Path) -> tuple[Path, Path]:
    """Return the path of the points and the path of the triangles, of which one is given."""
    upper = path.suffix.isupper()
    suffixes = (NODE.upper(), ELE.upper()) if upper else (NODE, ELE)
    return path.with_suffix(suffixes[0]), path.with_suffix(suffixes[1])


def _of_file(error: MeshReadError, found_in: Path, given: Path) -> MeshReadError:
    return error if found_in == given else MeshReadError(f"in {found_in.name}: {error}")


def _read_points(path: Path) -> tuple[Floats, dict[str, Floats], Ints, Ints]:
    with TextRecords(path, comment=b"#") as records:
        n_points, dimension, n_attributes, n_markers = _header(
            records, ("the number of points", "the dimension", "attributes", "markers"), (2, 0, 0)
        )
        if dimension != 2:
            raise MeshReadError(
                f"line {records.line_number}: points of dimension {dimension}; Triangle's have 2, "
                "TetGen's 3: save the surface as .off or .vtk"
            )
        if not n_points:
            raise MeshReadError(
                f"line {records.line_number}: no points, they are in the .poly; run Triangle on it"
            )
        names = _attributes(n_attributes) + [MARKER] * min(n_markers, 1)
        rows = records.rows(n_points, "a point")
    values = rows.columns(1, 3 + len(names), "a point")
    columns = {name: values[:, 2 + k].copy() for k, name in enumerate(names)}
    points = np.ascontiguousarray(values[:, :2])
    return points, columns, rows.integers(0, 1, "a point")[:, 0], rows.line_numbers


def _read_cells(path: Path) -> tuple[Ints, dict[str, Floats], Ints]:
    with TextRecords(path, comment=b"#") as records:
        n_cells, n_corners, n_attributes = _header(
            records, ("the number of triangles", "points of each", "attributes"), (3, 0)
        )
        if n_corners not in (3, 6):
            raise MeshReadError(
                f"line {records.line_number}: cells of {n_corners} points; Triangle's have 3 or 6, "
                "TetGen's 4: save the surface as .off or .vtk"
            )
        names = _attributes(n_attributes)
        rows = records.rows(n_cells, "a triangle")
    first = 1 + n_corners
    values = rows.columns(first, first + len(names), "a triangle")
    columns = {name: values[:, k].copy() for k, name in enumerate(names)}
    return rows.integers(1, 4, "a triangle"), columns, rows.line_numbers


def _header(records: TextRecords, names: tuple[str, ...], defaults: tuple[int, ...]) -> list[int]:
    line = records.line()
    if line is None:
        raise MeshReadError("the file is empty; fetch the whole file")
    n_given = min(len(line.split()), len(names))
    found = counts(line, records.line_number, names[:n_given])
    return found + list(defaults[len(found) - 1 :])


def _attributes(n: int) -> list[str]:
    if n > MOST_ATTRIBUTES:
        raise MeshReadError(f"{n} attributes are more than {MOST_ATTRIBUTES}; repair the header")
    return ["attribute"] if n == 1 else [f"attribute {k}" for k in range(1, n + 1)]


def write_triangle(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write a .node and an .ele, whichever is named, with scalar arrays as attributes.

    The marker of a point is the array of that name, else the number of its boundary. What has no place is
    named in a warning. Each file appears whole or not at all; raises OutputError for quads and for surfaces
    in space.
    """
    points_path, cells_path = both_paths(Path(path))
    if len(mesh_file.quads):
        raise OutputError(
            f"{Path(path)}: {len(mesh_file.quads)} quads, .ele has none; split them with --split-quads"
        )
    if not mesh_file.mesh.is_planar:
        raise OutputError(f"{Path(path)}: the mesh is a surface in space, a .node is planar; write .vtu")
    scalars = {name: v for name, v in mesh_file.point_data.items() if v.ndim == 1 and name != MARKER}
    cells = {name: v for name, v in mesh_file.cell_data.items() if v.ndim == 1}
    is_marked = MARKER in mesh_file.point_data
    n_named = 0 if is_marked else len(mesh_file.boundaries)
    warn_of_losses(
        path,
        mesh_file,
        point_data=(*scalars, MARKER),
        cell_data=tuple(cells),
        boundaries=() if is_marked else ("open", "land", "named"),
        also=[f"the names of {counted(n_named, 'boundary', 'boundaries')}, whose numbers are the markers"]
        * bool(n_named),
    )
    with replacing(points_path) as points, replacing(cells_path) as triangles:
        with points.open("w", encoding="utf-8", newline="\n") as stream:
            stream.writelines(_points_text(mesh_file, scalars))
        with triangles.open("w", encoding="utf-8", newline="\n") as stream:
            stream.writelines(_cells_text(mesh_file, cells))


def _points_text(mesh_file: MeshFile, scalars: dict[str, Floats]) -> Iterator[str]:
    points = whole_mesh(mesh_file).points
    columns = np.column_stack([points, *scalars.values()])
    markers = _markers(mesh_file)
    yield from _comment(scalars)
    yield f"{len(points)} 2 {len(scalars)} {int(markers is not None)}\n"
    template = "%d" + " %r" * columns.shape[1]
    if markers is None:
        yield from table_lines(template + "\n", counting(len(points)), columns)
    else:
        yield from table_lines(template + " %d\n", counting(len(points)), columns, markers)


def _markers(mesh_file: MeshFile) -> Ints | None:
    values = mesh_file.point_data.get(MARKER)
    if values is not None:
        return np.rint(values).astype(np.int64)
    if not mesh_file.boundaries:
        return None
    markers = np.zeros(mesh_file.mesh.n_points, dtype=np.int64)
    for boundary, (tag, _) in zip(mesh_file.boundaries, labels(mesh_file.boundaries), strict=True):
        markers[boundary.nodes] = tag
    return markers


def _cells_text(mesh_file: MeshFile, cells: dict[str, Floats]) -> Iterator[str]:
    triangles = mesh_file.mesh.triangles
    yield from _comment(cells)
    yield f"{len(triangles)} 3 {len(cells)}\n"
    template = "%d %d %d %d" + " %r" * len(cells) + "\n"
    yield from table_lines(template, counting(len(triangles)), triangles + 1, *cells.values())


def _comment(arrays: dict[str, Floats]) -> Iterator[str]:
    if arrays:
        yield f"# attributes: {', '.join(' '.join(name.split()) for name in arrays)}\n"
