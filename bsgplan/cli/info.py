"""`bsgplan info`: what is in a mesh file."""

from __future__ import annotations

import logging
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

if TYPE_CHECKING:
    from ..io import MeshFile

SCHEMA = "bsgplan.info/1"


def info(
    file: Path,
    /,
    *,
    lonlat: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    json: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
) -> None:
    """Show what is in a mesh: counts, topology, quality, sizes, irregularity, boundaries, arrays.

    Parameters
    ----------
    file
        The mesh file.
    lonlat
        The coordinates are degrees of longitude and latitude: project them, and give lengths in metres.
    json
        Write one JSON document instead of the table.
    """
    from ..report import mesh_report
    from ..result import dumps, mesh_document

    mesh = mesh_document(open_mesh(file, is_lonlat=lonlat))
    if json:
        sys.stdout.write(dumps({"schema": SCHEMA, "mesh": mesh}))
    else:
        sys.stdout.write(mesh_report.text(mesh_report.rows(mesh)) + "\n")


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
