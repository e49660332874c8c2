"""Writer of the ADCIRC and SCHISM text mesh (grammar in `fort14`): what `read` kept, it gives back."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..atomic import replacing
from ..errors import OutputError
from .boundary import Boundary, n_nodes
from .file import MeshFile


def write_fort14(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write nodes, depth, triangles and the open and land boundaries; coordinates to the last bit.

    A projected mesh is written in degrees. Depth is the point array of that name, else 0. The file
    appears whole or not at all; raises OutputError when it cannot be written.
    """
    target = Path(path)
    if len(mesh_file.quads):
        raise OutputError(
            f"{target}: the mesh has {len(mesh_file.quads)} quads, which are not written; split them first"
        )
    if not mesh_file.mesh.is_planar:
        raise OutputError(f"{target}: the mesh is a surface in space, a fort.14 is planar; write VTK instead")
    with replacing(target) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        stream.writelines(line + "\n" for line in _lines(mesh_file))


def _lines(mesh_file: MeshFile) -> Iterator[str]:
    mesh = mesh_file.mesh
    points = mesh.points if mesh_file.projection is None else mesh_file.projection.to_degrees(mesh.points)
    depth = _depth(mesh_file)
    yield " ".join(mesh_file.title.splitlines()) or "mesh"
    yield f"{mesh.n_triangles} {mesh.n_points}"
    for i, ((x, y), z) in enumerate(zip(points.tolist(), depth.tolist(), strict=True), 1):
        yield f"{i} {x!r} {y!r} {z!r}"
    for i, (a, b, c) in enumerate((mesh.triangles + 1).tolist(), 1):
        yield f"{i} 3 {a} {b} {c}"
    for kind in ("open", "land"):
        segments = tuple(boundary for boundary in mesh_file.boundaries if boundary.kind == kind)
        yield f"{len(segments)} = Number of {kind} boundaries"
        yield f"{n_nodes(segments)} = Total number of {kind} boundary nodes"
        for number, segment in enumerate(segments, 1):
            yield from _segment(segment, number)


def _segment(segment: Boundary, number: int) -> Iterator[str]:
    code = segment.code if segment.code is not None or segment.kind == "open" else 0
    counts = f"{segment.n_nodes}" if code is None else f"{segment.n_nodes} {code}"
    yield f"{counts} = Number of nodes for {segment.kind} boundary {number}"
    ids = [segment.nodes] if segment.partners is None else [segment.nodes, segment.partners]
    columns = np.empty((segment.n_nodes, 0)) if segment.columns is None else segment.columns
    for nodes, values in zip((np.column_stack(ids) + 1).tolist(), columns.tolist(), strict=True):
        yield " ".join([*map(str, nodes), *map(repr, values)])


def _depth(mesh_file: MeshFile) -> Floats:
    depth = mesh_file.point_data.get("depth")
    return np.zeros(mesh_file.mesh.n_points) if depth is None or depth.ndim != 1 else depth
