"""`bsgplan convert`: a mesh in another format."""

from __future__ import annotations

import logging
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from ..words import counted
from .output import check_writable

if TYPE_CHECKING:
    from ..io import MeshFile

CARRIED = ("quad", "line", "line3", "vertex")
"""Cells beside triangles that are written as cells or boundaries, or that say nothing."""


def convert(
    file: Path,
    out: Path,
    /,
    *,
    format: str | None = None,
    split_quads: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
) -> None:
    """Write a mesh in another format, with its data and boundaries where they have a place there.

    Parameters
    ----------
    file
        The mesh file.
    out
        The file to write, its format told by the suffix.
    format
        The format to write, by its name in info --formats: needed where the suffix tells nothing or another.
    split_quads
        Split quads into triangles, for formats of triangles alone.
    """
    from ..io import read
    from ..io.companions import warn_of_companions
    from ..io.triangle import ELE, NODE, both_paths
    from ..io.write import n_boundaries_written, writable

    found = writable(out, format)
    outputs = both_paths(out) if found.name == "triangle" else (out,)
    check_writable(*outputs, sources=both_paths(file) if file.suffix.lower() in (NODE, ELE) else (file,))
    mesh_file = read(file, split_quads=split_quads)
    found.write(mesh_file, out)
    left = {name: n for name, n in mesh_file.ignored.items() if name not in CARRIED}
    if left:
        cells = ", ".join(counted(n, f"{name} cell") for name, n in left.items())
        logging.getLogger("bsgplan").warning("%s: left out %s", out, cells)
    warn_of_companions(mesh_file, out)
    told = [note for note in mesh_file.notes if not _concerns_the_plan(note, mesh_file)]
    sys.stdout.write(
        "\n".join(
            [f"{out}: {found.name}, {_contents(mesh_file, n_boundaries_written(mesh_file, found))}", *told]
        )
        + "\n"
    )


def _concerns_the_plan(note: str, mesh_file: MeshFile) -> bool:
    """Return whether a note tells what a plan leaves out and a file does not: quads and their boundaries."""
    return bool(len(mesh_file.quads)) and ("measured apart" in note or "boundary entr" in note)


def _contents(mesh_file: MeshFile, n_boundaries: int) -> str:
    mesh = mesh_file.mesh
    counts = (
        (mesh.n_points, "point", "points"),
        (mesh.n_triangles, "triangle", "triangles"),
        (len(mesh_file.quads), "quad", "quads"),
        (n_boundaries, "boundary", "boundaries"),
    )
    return ", ".join(counted(n, one, many) for n, one, many in counts if n)
