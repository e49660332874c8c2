"""`bsgplan info`: what is in a mesh file."""

from __future__ import annotations

import json
import logging
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

if TYPE_CHECKING:
    from ..io import MeshFile

SCHEMA = "bsgplan.info/1"


def info(
    file: Path,
    /,
    *,
    lonlat: Annotated[bool, Parameter(negative=())] = False,
    json: Annotated[bool, Parameter(negative=())] = False,
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

    mesh = describe(open_mesh(file, is_lonlat=lonlat))
    text = _dumps({"schema": SCHEMA, "mesh": mesh}) if json else mesh_report.text(mesh_report.rows(mesh))
    sys.stdout.write(text + "\n")


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


def describe(mesh_file: MeshFile) -> dict[str, Any]:
    """Return the document of a mesh: what its file holds and what can be measured on it."""
    from ..report import mesh_report

    projection, mesh = mesh_file.projection, mesh_file.mesh
    scale = None if projection is None else projection.scale(mesh.points)
    quad_scale = None if projection is None else projection.scale(mesh_file.quad_points)
    found = mesh_file.description()
    return {
        "path": found["path"],
        "format": found["format"],
        **mesh_report.measures(mesh, scale=scale),
        "quads": mesh_report.quad_measures(mesh_file.quad_points, mesh_file.quads, scale=quad_scale),
        **found,
    }


def _dumps(document: dict[str, Any]) -> str:
    return json.dumps(document, indent=2, allow_nan=False)
