"""Our own text reader against meshio's ASCII MSH 2.2, on the same mesh."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import meshio

import bsgplan
from bsgplan.io.fort14_write import write_fort14

from .cost import cpu_of
from .meshes import stripes
from .planning import fresh, write_msh22
from .row import Row

TITLE = "Reading"

N_TRIANGLES = 300_000


def rows() -> Iterator[Row]:
    """Measure both readers on files of the same mesh; ours checks and cleans it too."""
    mesh = stripes(N_TRIANGLES)
    with tempfile.TemporaryDirectory() as folder:
        gmsh, fort = Path(folder) / "mesh.msh", Path(folder) / "fort.14"
        write_msh22(gmsh, mesh)
        write_fort14(fresh(mesh), fort)
        _, theirs = cpu_of(lambda: meshio.gmsh.read(str(gmsh)))
        _, ours = cpu_of(lambda: bsgplan.read(fort))
    millions = mesh.n_triangles / 1e6
    yield Row("meshio reads MSH 2.2 (ASCII)", theirs / millions, "s CPU a million")
    yield Row("bsgplan reads fort.14, checks and cleans it", ours / millions, "s CPU a million")
    yield Row("ours / meshio's", ours / theirs, "x", below=1)
