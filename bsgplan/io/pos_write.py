"""Writer of a size field as a Gmsh post-processing view: one scalar triangle a line, a background mesh.

A mesh in degrees is written in degrees with its sizes in true metres, as `--size-file` reads them back.
"""

from __future__ import annotations

import os

import numpy as np

from ..atomic import replacing
from ..errors import OutputError
from .file import MeshFile
from .text_write import table_lines

ARRAY = "target_size"
"""The point array that is written, in true length."""


def write_pos(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write the wanted edge length over the triangles; whole or not at all, raises OutputError."""
    mesh = mesh_file.mesh
    size = mesh_file.point_data.get(ARRAY)
    if size is None or size.shape != (mesh.n_points,):
        raise OutputError(f"{os.fspath(path)}: the mesh has no point array {ARRAY!r}; export a saved layout")
    own = mesh_file.file_points
    points = np.column_stack([own, np.zeros((len(own), 3 - own.shape[1]))])
    corners = points[mesh.triangles].reshape(-1, 9)
    line = "ST(%r,%r,%r,%r,%r,%r,%r,%r,%r){%r,%r,%r};\n"
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write('View "target size" {\n')
        stream.writelines(table_lines(line, corners, size[mesh.triangles]))
        stream.write("};\n")
