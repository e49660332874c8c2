"""`bsgplan export`: the blocks or the grid of a saved layout as a file for a solver."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from ..words import counted


def export(
    file: Path,
    /,
    *,
    what: Literal["blocks", "grid"] = "grid",
    format: str | None = None,
    output: Annotated[Path, Parameter(name=["--output", "-o"])],
) -> None:
    """Write the blocks or the grid of a saved layout for a solver.

    Parameters
    ----------
    file
        The layout, written by bsgplan layout --save.
    what
        The blocks, for a solver that refines by itself, or the grid.
    format
        msh22, msh41, hyteg, vtu, vtm, fort14 or pos; default: what the suffix means.
    output
        The file to write.
    """
    from ..laid_out.export import FORMATS, flavour, n_boundaries_written
    from ..laid_out.saved import load_layout
    from .output import check_writable

    name = flavour(output, format)
    check_writable(output, sources=[file])
    mesh_file = load_layout(file, what)
    FORMATS[name][1](mesh_file, output)
    mesh = mesh_file.mesh
    told = [name, counted(mesh.n_points, "point"), counted(mesh.n_triangles, "triangle")]
    if n_boundaries := n_boundaries_written(mesh_file, name):
        told.append(counted(n_boundaries, "boundary", "boundaries"))
    sys.stdout.write(f"{output}: {', '.join(told)}\n")
