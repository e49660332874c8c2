"""Writer of SU2 meshes (grammar in `su2`): one zone, every edge of the rim in a marker."""

from __future__ import annotations

import os
from collections.abc import Iterator

import numpy as np

from ..atomic import replacing
from .boundary_edges import edge_groups
from .file import MeshFile
from .text_write import table_lines
from .whole import warn_of_losses, whole_mesh


def write_su2(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write points, triangles, quads and boundaries as markers; edges of no boundary are `unmarked`.

    A projected mesh is written in degrees. The file appears whole or not at all; raises OutputError.
    """
    lines = _lines(mesh_file)
    warn_of_losses(path, mesh_file, boundaries=("named", "open", "land"))
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        stream.writelines(lines)


def _lines(mesh_file: MeshFile) -> Iterator[str]:
    whole = whole_mesh(mesh_file)
    n_triangles, n_cells = len(whole.triangles), len(whole.triangles) + len(whole.quads)
    n_points, dimension = whole.points.shape
    yield f"NDIME= {dimension}\nNELEM= {n_cells}\n"
    yield from table_lines("5 %d %d %d %d\n", *whole.triangles.T, np.arange(n_triangles))
    yield from table_lines("9 %d %d %d %d %d\n", *whole.quads.T, np.arange(n_triangles, n_cells))
    yield f"NPOIN= {n_points}\n"
    yield from table_lines("%r " * dimension + "%d\n", *whole.points.T, np.arange(n_points))
    groups = edge_groups(whole.triangles, whole.quads, whole.boundaries, n_points)
    yield f"NMARK= {len(groups)}\n"
    for group in groups:
        yield f"MARKER_TAG= {group.name.replace('%', '_')}\nMARKER_ELEMS= {len(group.edges)}\n"
        yield from table_lines("3 %d %d\n", *group.edges.T)
