"""Writer of the SMS two-dimensional mesh, .2dm (grammar in `sms`)."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..atomic import replacing
from ..errors import OutputError
from .boundary import Boundary, labels, paths
from .file import MeshFile
from .text_write import counting, table_lines
from .whole import cell_regions, warn_of_losses, whole_mesh

NODES_PER_LINE = 10


def write_2dm(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write points with depth, triangles and quads with material, and boundaries as nodestrings.

    Coordinates to the last bit, in degrees where the mesh is projected; depth is the point array of that
    name, else 0; quads have material 1. What has no place is named in a warning. The file appears whole
    or not at all; raises OutputError for a surface in space or where it cannot be written.
    """
    if not mesh_file.mesh.is_planar:
        raise OutputError(f"{Path(path)}: the mesh is a surface in space, a .2dm is planar; write .vtu")
    array = cell_regions(mesh_file).array
    warn_of_losses(
        path,
        mesh_file,
        point_data=("depth",),
        cell_data=() if array is None else (array,),
        boundaries=("open", "land", "named"),
    )
    text = _text(mesh_file)
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        stream.writelines(text)


def _text(mesh_file: MeshFile) -> Iterator[str]:
    whole, regions = whole_mesh(mesh_file), cell_regions(mesh_file)
    depth = whole.point_data.get("depth")
    if depth is None or depth.ndim != 1:
        depth = np.zeros(len(whole.points))
    n_triangles, n_quads = len(whole.triangles), len(whole.quads)
    title = " ".join(mesh_file.title.replace('"', "'").split())
    yield f'MESH2D\nMESHNAME "{title or "mesh"}"\n'
    yield from table_lines("E3T %d %d %d %d %d\n", counting(n_triangles), whole.triangles + 1, regions.ids)
    numbers = counting(n_quads, n_triangles + 1)
    yield from table_lines("E4Q %d %d %d %d %d 1\n", numbers, whole.quads + 1)
    yield from table_lines("ND %d %r %r %r\n", counting(len(whole.points)), whole.points, depth)
    for boundary, (tag, name) in zip(whole.boundaries, labels(whole.boundaries), strict=True):
        yield from _nodestrings(boundary, tag, name)
    for number, name in regions.names.items():
        yield f'MAT {number} "{name}"\n'


def _nodestrings(boundary: Boundary, tag: int, name: str) -> Iterator[str]:
    for nodes in paths(boundary):
        ids = (nodes + 1).tolist()
        words = [*map(str, ids[:-1]), f"-{ids[-1]}", str(tag), f'"{name}"']
        ends = [*range(NODES_PER_LINE, len(ids), NODES_PER_LINE), len(words)]
        for start, end in zip([0, *ends], ends, strict=False):
            yield f"NS {' '.join(words[start:end])}\n"
