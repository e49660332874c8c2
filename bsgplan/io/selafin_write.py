"""Writer of TELEMAC Selafin files (grammar in `selafin`): one frame, double precision, big-endian."""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator

import numpy as np

from ..arrays import Ints
from ..atomic import replacing
from ..errors import OutputError
from ..mesh import Mesh
from .boundary_edges import rim
from .file import MeshFile
from .selafin import NAME
from .whole import warn_of_losses, whole_mesh

TITLE = 72
"""Characters of the title that are free."""


def write_selafin(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write the triangles with every scalar point array as a variable, and `ipobo` from the rim or the file.

    A projected mesh is written in degrees. The file appears whole or not at all; raises OutputError for quads
    and surfaces in space, which have no place there.
    """
    if len(mesh_file.quads) or not mesh_file.mesh.is_planar:
        what = f"{len(mesh_file.quads)} quads" if len(mesh_file.quads) else "a surface in space"
        raise OutputError(f"{os.fspath(path)}: the mesh has {what}, Selafin has plane triangles; write .vtu")
    scalars = [name for name, values in mesh_file.point_data.items() if values.ndim == 1]
    warn_of_losses(path, mesh_file, point_data=scalars)
    with replacing(path) as temporary, temporary.open("wb") as stream:
        for content in _records(mesh_file, [name for name in scalars if name != "ipobo"]):
            length = struct.pack(">i", len(content))
            stream.writelines((length, content, length))


def boundary_numbers(mesh: Mesh) -> Ints:
    """Return for each point its place on the rim, counted from 1 loop by loop, 0 inside, (n_points,).

    Loops of larger area come first, the mesh on the left of each: outlines counter-clockwise, islands
    clockwise. A point where the rim touches itself is counted once.
    """
    edges = rim(mesh.triangles, np.empty((0, 4), dtype=np.int64), mesh.n_points)
    after: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        after.setdefault(a, []).append(b)
    numbers = np.zeros(mesh.n_points, dtype=np.int64)
    loops = []
    for start in after:
        while after[start]:
            loop, at = [start], after[start].pop()
            while at != start:
                loop.append(at)
                at = after[at].pop()
            loops.append(np.array(loop))
    loops.sort(key=lambda loop: -abs(_area(mesh, loop)))
    order = np.concatenate([np.empty(0, dtype=np.int64), *loops])
    _, first = np.unique(order, return_index=True)
    numbers[order[np.sort(first)]] = np.arange(1, len(first) + 1)
    return numbers


def _area(mesh: Mesh, loop: Ints) -> float:
    x, y = (mesh.points[loop] - mesh.points[loop[0]]).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _records(mesh_file: MeshFile, names: list[str]) -> Iterator[bytes]:
    whole, mesh = whole_mesh(mesh_file), mesh_file.mesh
    yield _text(mesh_file.title, TITLE) + b"SERAFIND"
    yield _integers(len(names), 0)
    for name in names:
        yield _text(name, NAME // 2) + b" " * (NAME // 2)
    yield _integers(1, 0, 0, 0, 0, 0, 0, 0, 0, 0)
    yield _integers(mesh.n_triangles, mesh.n_points, 3, 1)
    yield (mesh.triangles + 1).astype(">i4").tobytes()
    given = mesh_file.point_data.get("ipobo")
    yield (boundary_numbers(mesh) if given is None else given).astype(">i4").tobytes()
    for coordinate in whole.points.T:
        yield coordinate.astype(">f8").tobytes()
    yield struct.pack(">d", 0.0)
    for name in names:
        yield mesh_file.point_data[name].astype(">f8").tobytes()


def _integers(*values: int) -> bytes:
    return struct.pack(f">{len(values)}i", *values)


def _text(text: str, length: int) -> bytes:
    return text.encode("latin-1", "replace")[:length].ljust(length)
