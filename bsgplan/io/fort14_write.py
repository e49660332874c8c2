"""Writer of the ADCIRC and SCHISM text mesh (grammar in `fort14`): what `read` kept, it gives back."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..atomic import replacing
from ..errors import OutputError
from .boundary import Boundary, n_nodes
from .file import MeshFile
from .text_write import counting, table_lines
from .whole import WholeMesh, warn_of_losses, whole_mesh


def write_fort14(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write nodes, depth, triangles, quads and the open and land boundaries; coordinates to the last bit.

    A projected mesh is written in degrees. Depth is the point array of that name, else 0. Quads, which SCHISM
    reads and ADCIRC does not, follow the triangles. What has no place is named in a warning. The file appears
    whole or not at all; raises OutputError when it cannot be written.
    """
    target = Path(path)
    if not mesh_file.mesh.is_planar:
        raise OutputError(f"{target}: the mesh is a surface in space, a fort.14 is planar; write VTK instead")
    warn_of_losses(path, mesh_file, point_data=("depth",), boundaries=("open", "land"), has_barriers=True)
    text = _text(mesh_file, whole_mesh(mesh_file))
    with replacing(target) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        stream.writelines(text)


def _text(mesh_file: MeshFile, whole: WholeMesh) -> Iterator[str]:
    n_points, n_triangles, n_quads = len(whole.points), len(whole.triangles), len(whole.quads)
    depth = whole.point_data.get("depth")
    if depth is None or depth.ndim != 1:
        depth = np.zeros(n_points)
    yield (" ".join(mesh_file.title.splitlines()) or "mesh") + "\n"
    yield f"{n_triangles + n_quads} {n_points}\n"
    yield from table_lines("%d %r %r %r\n", counting(n_points), whole.points, depth)
    yield from table_lines("%d 3 %d %d %d\n", counting(n_triangles), whole.triangles + 1)
    yield from table_lines("%d 4 %d %d %d %d\n", counting(n_quads, n_triangles + 1), whole.quads + 1)
    for kind in ("open", "land"):
        segments = tuple(boundary for boundary in whole.boundaries if boundary.kind == kind)
        yield f"{len(segments)} = Number of {kind} boundaries\n"
        yield f"{n_nodes(segments)} = Total number of {kind} boundary nodes\n"
        for number, segment in enumerate(segments, 1):
            yield from (line + "\n" for line in _segment(segment, number))


def _segment(segment: Boundary, number: int) -> Iterator[str]:
    code = segment.code if segment.code is not None or segment.kind == "open" else 0
    counts = f"{segment.n_nodes}" if code is None else f"{segment.n_nodes} {code}"
    yield f"{counts} = Number of nodes for {segment.kind} boundary {number}"
    ids = [segment.nodes] if segment.partners is None else [segment.nodes, segment.partners]
    columns = np.empty((segment.n_nodes, 0)) if segment.columns is None else segment.columns
    for nodes, values in zip((np.column_stack(ids) + 1).tolist(), columns.tolist(), strict=True):
        yield " ".join([*map(str, nodes), *map(repr, values)])
