"""`bsgplan info`: what is in a mesh file."""

from __future__ import annotations

import logging
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from ..errors import InvalidOption
from .output import show

if TYPE_CHECKING:
    from ..io import MeshFile

SCHEMA = "bsgplan.info/1"
FORMATS_SCHEMA = "bsgplan.formats/1"


def info(
    file: Path | None = None,
    /,
    *,
    formats: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    lonlat: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
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
    json
        Write one JSON document instead of the table.
    """
    if formats and file is None:
        _show_formats(is_json=json)
        return
    if formats or file is None:
        raise InvalidOption("info takes a mesh file or --formats, one of the two; see bsgplan info --help")
    from ..report import mesh_report
    from ..result import dumps, mesh_document

    mesh = mesh_document(open_mesh(file, is_lonlat=lonlat))
    if json:
        sys.stdout.write(dumps({"schema": SCHEMA, "mesh": mesh}))
    else:
        sys.stdout.write(mesh_report.text(mesh_report.rows(mesh)) + "\n")


def _show_formats(*, is_json: bool) -> None:
    from ..result import dumps
    from .formats import format_document, format_table

    if is_json:
        sys.stdout.write(dumps({"schema": FORMATS_SCHEMA, "formats": format_document()}))
    else:
        show([format_table()])


def open_mesh(file: Path, *, is_lonlat: bool) -> MeshFile:
    """Return the mesh of a file; warn where it looks like degrees and --lonlat was not given."""
    from ..io import looks_like_degrees, read, read_lonlat

    if is_lonlat:
        return read_lonlat(file)
    mesh_file = read(file)
    if looks_like_degrees(mesh_file):
        logging.getLogger("bsgplan").warning(
            "%s: the coordinates look like degrees, lengths are then no lengths; give --lonlat", file
        )
    return mesh_file
