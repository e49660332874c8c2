"""Every format that meshio reads, made quiet: no prints, no exits, no exception but MeshReadError."""

from __future__ import annotations

import importlib
import re
import types
from collections.abc import Iterable
from os import SEEK_END
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Floats, Ints
from ..errors import BsgplanError, MeshReadError
from .boundary import Boundary
from .byte_order_mark import MARK, skip_mark
from .file import RawMesh
from .hush import hushed
from .sniff import HEAD, format_of

CORNERS = (("triangle", 3), ("quad", 4), ("VTK_LAGRANGE_TRIANGLE", 3), ("VTK_LAGRANGE_QUADRILATERAL", 4))
"""Cell types, by how their name begins, that are taken by their first corners: higher orders too."""
HIDDEN_ARRAYS = ("gmsh:dim_tags",)
"""Book-keeping of a reader, of no use as data."""
CLOSINGS = {
    "gmsh": rb"\n\$End\w+$",
    "vtk": b"",  # nothing closes it
    "vtu": b"</VTKFile>$",
    "xdmf": b"</Xdmf>$",
    "dolfin": b"</dolfin>$",
}
"""Formats that begin with a signature, and what stands at their end."""
LINE_TAGS = ("gmsh:physical", "medit:ref")
"""Arrays that hold the number of the boundary at line cells."""
PARTIAL_TAGS = "physical groups cover a part of the cells only; gmsh:physical is 0 at the others"
PARTIAL_DATA = "data cover a part of the points or cells only; those arrays were left out"


def read_through_meshio(path: Path, file_format: str) -> RawMesh:
    """Return what meshio's reader of that format finds in a file."""
    with path.open("rb") as stream:
        if skip_mark(stream):
            raise MeshReadError("begins with a byte order mark, which few readers know; save it without")
    with hushed():
        try:
            found, notes = _read_gmsh(path) if file_format == "gmsh" else (_read(path, file_format), ())
            return _converted(found, notes)
        except BsgplanError:
            raise
        except ModuleNotFoundError as error:
            raise MeshReadError(
                f"{file_format} files need the package {error.name}; pip install {error.name}"
            ) from None
        except (Exception, SystemExit) as error:  # readers raise anything, and exit
            raise MeshReadError(
                damage(path, file_format)
                or f"not readable as {file_format} ({reason(error)}); check or convert it"
            ) from None


def _read(path: Path, file_format: str) -> Any:
    return importlib.import_module(f"meshio.{file_format}").read(str(path))


def _read_gmsh(path: Path) -> tuple[Any, tuple[str, ...]]:
    """Return the mesh of a Gmsh file; never through meshio.read, which tries the Ansys reader first."""
    import meshio

    try:
        return meshio.gmsh.read(str(path)), ()
    except ValueError as error:  # meshio refuses tags or data that only some of the cells carry
        if "ata" not in str(error):
            raise
    from meshio.gmsh import _gmsh22, _gmsh41
    from meshio.gmsh.main import _read_header

    notes: list[str] = []

    def read_entities(*arguments: Any) -> Any:
        physical_tags, bounding_entities = _gmsh41._read_entities(*arguments)
        tags = [list(of_entity.values()) for of_entity in physical_tags]
        if any(any(t) for t in tags) and not all(all(t) for t in tags):
            notes.append(PARTIAL_TAGS)
        tagged = tuple({e: t or [0] for e, t in of_entity.items()} for of_entity in physical_tags)
        return tagged, bounding_entities

    def cell_data_by_block(cells: Any, arrays: Any) -> Any:
        lengths = [len(cell[1]) if isinstance(cell, tuple) else len(cell) for cell in cells]
        whole = {name: values for name, values in arrays.items() if len(values) == sum(lengths)}
        if len(whole) < len(arrays):
            notes.append(PARTIAL_DATA)
        return {name: np.split(values, np.cumsum(lengths)[:-1]) for name, values in whole.items()}

    def mesh_of_whole_data(points: Any, cells: Any, **data: Any) -> Any:
        whole = {name: values for name, values in data["point_data"].items() if len(values) == len(points)}
        if len(whole) < len(data["point_data"]):
            notes.append(PARTIAL_DATA)
        return meshio.Mesh(points, cells, **{**data, "point_data": whole, "cell_sets": None})

    with path.open("rb") as stream:
        while stream.readline().strip() != b"$MeshFormat":
            pass
        version, data_size, is_ascii = _read_header(stream)
        reader = (_gmsh22 if version.startswith("2") else _gmsh41).read_buffer
        own = {"cell_data_from_raw": cell_data_by_block, "Mesh": mesh_of_whole_data}
        if "_read_entities" in reader.__globals__:
            own["_read_entities"] = read_entities
        lenient = types.FunctionType(reader.__code__, {**reader.__globals__, **own})
        return lenient(stream, is_ascii, data_size), tuple(dict.fromkeys(notes))


def _converted(found: Any, notes: Iterable[str]) -> RawMesh:
    points = np.asarray(found.points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise MeshReadError(f"points have shape {points.shape}, not 2 or 3 coordinates; check the file")
    corners = [_n_corners(block.type) for block in found.cells]
    ignored: dict[str, int] = {}
    for block, n_corners in zip(found.cells, corners, strict=True):
        if n_corners != 3 and len(block.data):
            name = "quad" if n_corners == 4 else block.type
            ignored[name] = ignored.get(name, 0) + len(block.data)
    point_data = {name: _floats(v) for name, v in found.point_data.items() if name not in HIDDEN_ARRAYS}
    return RawMesh(
        points=points,
        triangles=_cells(found, corners, 3),
        quads=_cells(found, corners, 4),
        point_data={name: values for name, values in point_data.items() if values is not None},
        cell_data=_cell_data(found, corners, 3),
        quad_data=_cell_data(found, corners, 4),
        boundaries=_named_lines(found),
        ignored=ignored,
        midside=_midside(found, corners),
        notes=tuple(notes),
        cell_names={"gmsh:physical": names} if (names := _groups(found, 2)) else {},
    )


def _n_corners(cell_type: str) -> int:
    return next((n for start, n in CORNERS if cell_type.startswith(start)), 0)


def _cells(found: Any, corners: list[int], n_corners: int) -> Ints:
    """Return the corners of all blocks of triangles or quads, (n, n_corners), in the order of the file."""
    blocks = [
        np.asarray(b.data)[:, :n_corners] for b, n in zip(found.cells, corners, strict=True) if n == n_corners
    ]
    return np.concatenate([np.empty((0, n_corners), dtype=np.int64), *blocks]).astype(np.int64)


def _cell_data(found: Any, corners: list[int], n_corners: int) -> dict[str, Floats]:
    """Return the values at triangles or quads by name, in the order of `_cells`."""
    result = {}
    for name, values in found.cell_data.items():
        parts = [np.asarray(v) for v, n in zip(values, corners, strict=True) if n == n_corners]
        if parts and name not in HIDDEN_ARRAYS and (array := _floats(np.concatenate(parts))) is not None:
            result[name] = array
    return result


def _midside(found: Any, corners: list[int]) -> Ints:
    """Return the points that triangles and quads of higher order have beside their corners, each once."""
    beside = [
        np.asarray(b.data)[:, n:].ravel() for b, n in zip(found.cells, corners, strict=True) if n in (3, 4)
    ]
    return np.unique(np.concatenate([np.empty(0, dtype=np.int64), *beside])).astype(np.int64)


def _floats(values: Any) -> Floats | None:
    array = np.asarray(values)
    return array.astype(np.float64) if array.dtype.kind in "fiub" else None


def _groups(found: Any, dimension: int) -> dict[int, str]:
    """Return the names of the physical groups of one dimension by their tags."""
    return {
        int(pair[0]): name
        for name, pair in found.field_data.items()
        if np.size(pair) == 2 and pair[1] == dimension
    }


def _named_lines(found: Any) -> tuple[Boundary, ...]:
    """Return one boundary for each tag of the line cells but 0, which means none."""
    names = _groups(found, 1)
    edges_of: dict[int, list[Ints]] = {}
    all_tags: Any = next((found.cell_data[name] for name in LINE_TAGS if name in found.cell_data), [])
    for block, tags in zip(found.cells, all_tags, strict=False):
        if block.type.startswith("line"):
            edges = np.asarray(block.data)[:, :2].astype(np.int64)
            for tag in np.unique(tags).tolist():
                edges_of.setdefault(int(tag), []).append(edges[np.asarray(tags) == tag])
    joined = {tag: np.concatenate(edges) for tag, edges in sorted(edges_of.items())}
    return tuple(
        Boundary("named", np.unique(edges), tag, names.get(tag, ""), edges=edges)
        for tag, edges in joined.items()
        if (tag or tag in names) and (edges < len(found.points)).all()
    )


def reason(error: BaseException) -> str:
    """Return what an exception of a reader says in one short line; where it says nothing, what that means."""
    text = " ".join(str(error).split())
    if isinstance(error, SystemExit) or not text:
        return "damaged or cut short"
    return text if len(text) <= 120 else text[:117] + "..."


def damage(path: Path, file_format: str) -> str:
    """Return what is wrong with the ends of a file that could not be read, and the remedy; empty if nothing.

    The first bytes are those of the format, where it has a signature, and the last ones close it.
    """
    if file_format not in CLOSINGS:
        return ""
    with path.open("rb") as stream:
        head = stream.read(HEAD).removeprefix(MARK)
        n_bytes = stream.seek(0, SEEK_END)
        stream.seek(max(n_bytes - HEAD, 0))
        tail = stream.read().rstrip()
    if format_of(head, "") != file_format:
        begins = ascii(head[:20].decode("latin-1"))
        return f"no {file_format} file, it begins with {begins}; give one, or a suffix that tells its format"
    if not re.search(CLOSINGS[file_format], tail):
        ends = ascii(tail[-20:].decode("latin-1"))
        return (
            f"the {file_format} file ends early, after {n_bytes} bytes, with {ends}; fetch or save it again"
        )
    return ""
