"""Every text reader of ours, of meshes and sizes, against meshio's of ASCII MSH 2.2: time and memory."""

from __future__ import annotations

import math
import tempfile
import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import meshio
import numpy as np

import bsgplan
from bsgplan.io import write
from bsgplan.io.formats import BY_NAME
from bsgplan.io.pos_write import ARRAY, write_pos
from bsgplan.io.size_jigsaw import read_grid
from bsgplan.io.size_pos import read_pos
from bsgplan.io.size_sol import read_sol
from bsgplan.mesh.mesh import Mesh
from bsgplan.sizing import size_field

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

SIZES: dict[str, tuple[str, Callable[[Path], object], float | None]] = {
    "sizes in .pos": ("sizes.pos", lambda path: read_pos(path, None), None),
    "sizes in .sol": ("sizes.sol", read_sol, 1.0),
    "a grid of sizes": ("grid.msh", lambda path: read_grid(path, is_lonlat=False), 1.0),
}
"""A file of every text format of sizes: on each triangle, at each vertex, at as many crossings.

Last what it may cost beside the mesh, if that compares: a view has twelve decimals a triangle, a mesh one."""


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
        readers: list[tuple[str, Callable[[Path], object], str, float | None]] = [
            *((name, BY_NAME[name].read, file, 1.0) for name, file in FILES.items()),
            *((what, read, file, demand) for what, (file, read, demand) in SIZES.items()),
        ]
        for what, reader, file, demand in readers:
            read = partial(reader, folder / file)
            ours = least(lambda read=read: cpu_of(read)[1])
            yield Row(f"bsgplan reads {what}", ours / millions, "s CPU a million")
            yield Row(f"bsgplan reads {what}: over meshio's", ours / theirs, "x", below=demand)
            peak = peak_of(read)
            yield Row(f"bsgplan reads {what}: peak memory", peak / mesh.n_triangles, "B a triangle")
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
    """Write a mesh and its sizes in MSH 2.2 and in every text format with a reader of ours."""
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
    write_sizes(folder, mesh)


def write_sizes(folder: Path, mesh: Mesh) -> None:
    """Write the sizes of a mesh in every format of sizes, those of its points on a grid too."""
    size = size_field(mesh).h
    write_pos(replace(fresh(mesh), point_data={ARRAY: size}), folder / "sizes.pos")
    with (folder / "sizes.sol").open("w") as stream:
        stream.write(f"MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n{mesh.n_points}\n1 1\n")
        np.savetxt(stream, size, fmt="%.16g")
        stream.write("End\n")
    n = math.isqrt(mesh.n_points)
    with (folder / "grid.msh").open("w") as stream:
        stream.write("MSHID=3;EUCLIDEAN-GRID\nNDIMS=2\n")
        for axis in (1, 2):
            stream.write(f"COORD={axis};{n}\n")
            np.savetxt(stream, np.arange(n), fmt="%d")
        stream.write(f"VALUE={n * n};1\n")
        np.savetxt(stream, size[: n * n], fmt="%.16g")
