"""`bsgplan info`: what is in a mesh file."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from ..errors import InvalidOption
from .output import show

if TYPE_CHECKING:
    from ..io import MeshFile
    from ..io.file import RawMesh

SCHEMA = "bsgplan.info/1"
FORMATS_SCHEMA = "bsgplan.formats/1"


def info(
    file: Path | None = None,
    /,
    *,
    formats: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    lonlat: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    split_quads: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    json: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
) -> None:
    """Show what is in a mesh: counts, topology, quality, sizes, irregularity, boundaries, arrays.

    Parameters
    ----------
    file
        The mesh file.
    formats
        Instead: list the formats that are read and written.
    lonlat
        The coordinates are degrees of longitude and latitude: project them, and give lengths in metres.
    split_quads
        Split each quad into two triangles along its better diagonal, and measure those.
    json
        Write one JSON document instead of the table.
    """
    if formats and file is None:
        _show_formats(is_json=json)
        return
    if formats or file is None:
        raise InvalidOption("info takes a mesh file or --formats, one of the two; see bsgplan info --help")
    from ..report import mesh_report
    from ..result import dumps

    mesh = describe(file, is_lonlat=lonlat, split_quads=split_quads)
    if json:
        sys.stdout.write(dumps({"schema": SCHEMA, "mesh": mesh}))
    else:
        show([mesh_report.mesh_table(mesh)])


def _show_formats(*, is_json: bool) -> None:
    from ..result import dumps
    from .formats import format_document, format_table

    if is_json:
        sys.stdout.write(dumps({"schema": FORMATS_SCHEMA, "formats": format_document()}))
    else:
        show([format_table()])


def describe(file: Path, *, is_lonlat: bool, split_quads: bool) -> dict[str, Any]:
    """Return the document of the mesh in a file, of its quads where it has nothing else."""
    from ..errors import InvalidMesh
    from ..io.projection import project_raw
    from ..io.read import read_raw
    from ..result import mesh_document, quads_document

    file_format, raw = read_raw(file)
    if len(raw.triangles) or split_quads or not len(raw.quads):
        return mesh_document(cleaned(file, file_format, raw, is_lonlat=is_lonlat, split_quads=split_quads))
    try:
        if is_lonlat:
            return quads_document(file, file_format, *project_raw(raw))
        return quads_document(file, file_format, raw)
    except InvalidMesh as error:
        raise InvalidMesh(f"{file}: {error}") from None


def open_mesh(file: Path, *, is_lonlat: bool, split_quads: bool = False) -> MeshFile:
    """Return the mesh of a file; warn where it looks like degrees and --lonlat was not given."""
    from ..io.read import read_raw

    return cleaned(file, *read_raw(file), is_lonlat=is_lonlat, split_quads=split_quads)


def cleaned(file: Path, file_format: str, raw: RawMesh, *, is_lonlat: bool, split_quads: bool) -> MeshFile:
    """Return the mesh of what stands in a file; warn where it looks like degrees without --lonlat."""
    from ..io.projection import warn_of_degrees
    from ..io.read import assembled

    mesh_file = assembled(file, file_format, raw, is_lonlat=is_lonlat, split_quads=split_quads)
    warn_of_degrees(mesh_file)
    return mesh_file
