"""Every text reader of ours against meshio's of ASCII MSH 2.2, on the same mesh: time and memory."""

from __future__ import annotations

import tempfile
import tracemalloc
from collections.abc import Callable, Iterator
from pathlib import Path

import meshio
import numpy as np

import bsgplan
from bsgplan.io import write
from bsgplan.io.formats import BY_NAME
from bsgplan.mesh.mesh import Mesh

from .cost import cpu_of
from .meshes import stripes
from .planning import fresh, write_msh22
from .row import Row, least

TITLE = "Reading"

N_TRIANGLES = 300_000

FILES = {
    "fort.14": "fort.14",
    "2dm": "mesh.2dm",
    "triangle": "mesh.ele",
    "jigsaw": "jigsaw.msh",
    "gmsh1": "gmsh1.msh",
    "su2": "mesh.su2",
    "mfem": "mfem.mesh",
}
"""A file of every text format with a reader of ours."""


def rows() -> Iterator[Row]:
    """Measure the readers on files of the same mesh: the reader alone, and one with check and clean-up."""
    mesh = stripes(N_TRIANGLES)
    millions = mesh.n_triangles / 1e6
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_files(folder, mesh)
        gmsh = str(folder / "mesh.msh")
        theirs = least(lambda: cpu_of(lambda: meshio.gmsh.read(gmsh))[1])
        yield Row("meshio reads MSH 2.2 (ASCII)", theirs / millions, "s CPU a million")
        peak = peak_of(lambda: meshio.gmsh.read(gmsh))
        yield Row("meshio reads MSH 2.2 (ASCII): peak memory", peak / mesh.n_triangles, "B a triangle")
        for format_name, file in FILES.items():
            path = folder / file

            def read(format_name: str = format_name, path: Path = path) -> object:
                return BY_NAME[format_name].read(path)

            ours = least(lambda read=read: cpu_of(read)[1])
            yield Row(f"bsgplan reads {format_name}", ours / millions, "s CPU a million")
            yield Row(f"bsgplan reads {format_name}: over meshio's", ours / theirs, "x", below=1)
            peak = peak_of(read)
            yield Row(f"bsgplan reads {format_name}: peak memory", peak / mesh.n_triangles, "B a triangle")
        _, whole = cpu_of(lambda: bsgplan.read(folder / FILES["fort.14"]))
        what = "bsgplan reads fort.14, checks and cleans it"
        yield Row(what, whole / millions, "s CPU a million")
        yield Row(f"{what}: over meshio's", whole / theirs, "x", below=1)


def peak_of(call: Callable[[], object]) -> int:
    """Return the most memory that a call holds at a time, bytes, as Python's allocators count it."""
    tracemalloc.start()
    try:
        call()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def write_files(folder: Path, mesh: Mesh) -> None:
    """Write a mesh in MSH 2.2 and in every text format with a reader of ours."""
    write_msh22(folder / "mesh.msh", mesh)
    for name, file in FILES.items():
        if BY_NAME[name].writer is not None:
            write(fresh(mesh), folder / file, format=name)
    nodes = np.column_stack([np.arange(1, mesh.n_points + 1), mesh.points, np.zeros(mesh.n_points)])
    numbers = np.arange(1, mesh.n_triangles + 1)
    head = np.column_stack([numbers, np.tile([2, 1, 1, 3], (mesh.n_triangles, 1))])
    with (folder / FILES["gmsh1"]).open("w") as stream:
        stream.write(f"$NOD\n{mesh.n_points}\n")
        np.savetxt(stream, nodes, fmt="%d %.16g %.16g %d")
        stream.write(f"$ENDNOD\n$ELM\n{mesh.n_triangles}\n")
        np.savetxt(stream, np.column_stack([head, mesh.triangles + 1]), fmt="%d")
        stream.write("$ENDELM\n")
