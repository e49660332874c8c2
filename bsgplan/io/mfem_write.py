"""Writer of MFEM meshes (grammar in `mfem`): version 1.0, or 1.3 where boundaries have names or kinds."""

from __future__ import annotations

import os
from collections.abc import Iterator

import numpy as np

from ..arrays import Ints
from ..atomic import replacing
from .boundary_edges import edge_groups
from .file import MeshFile
from .text_write import table_lines
from .whole import cell_regions, warn_of_losses, whole_mesh


def write_mfem(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write vertices, triangles, squares, attributes and the rim with an attribute for each boundary.

    Attributes of triangles are the numbers of their regions where those are positive, else 1; squares have 1.
    A projected mesh is written in degrees. The file appears whole or not at all; raises
    OutputError.
    """
    lines = _lines(mesh_file)
    kept = (str(cell_regions(mesh_file).array),) if _attributes(mesh_file).any() else ()
    warn_of_losses(path, mesh_file, cell_data=kept, boundaries=("named", "open", "land"))
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        stream.writelines(lines)


def _lines(mesh_file: MeshFile) -> Iterator[str]:
    whole = whole_mesh(mesh_file)
    n_points, dimension = whole.points.shape
    groups = edge_groups(whole.triangles, whole.quads, whole.boundaries, n_points)
    has_names = any(b.name or b.kind != "named" for b in whole.boundaries)
    yield f"MFEM mesh v1.{3 if has_names else 0}\n\ndimension\n2\n\n"
    yield f"elements\n{len(whole.triangles) + len(whole.quads)}\n"
    yield from table_lines("%d 2 %d %d %d\n", np.maximum(_attributes(mesh_file), 1), *whole.triangles.T)
    yield from table_lines("1 3 %d %d %d %d\n", *whole.quads.T)
    if has_names:
        yield "\nattribute_sets\n0\n"
    yield f"\nboundary\n{sum(len(group.edges) for group in groups)}\n"
    for group in groups:
        yield from table_lines(f"{group.tag} 1 %d %d\n", *group.edges.T)
    if has_names:
        yield f"\nbdr_attribute_sets\n{len(groups)}\n"
        for group in groups:
            name = group.name.replace('"', "_")
            yield f'"{name}"\n1\n{group.tag}\n'
    yield f"\nvertices\n{n_points}\n{dimension}\n"
    yield from table_lines(" ".join(["%r"] * dimension) + "\n", *whole.points.T)
    if has_names:
        yield "\nmfem_mesh_end\n"


def _attributes(mesh_file: MeshFile) -> Ints:
    """Return the numbers of the regions as integers, zeros where MFEM cannot have them."""
    regions = cell_regions(mesh_file)
    is_valid = regions.array is not None and bool((regions.ids >= 1).all())
    return regions.ids if is_valid else np.zeros(mesh_file.mesh.n_triangles, dtype=np.int64)
