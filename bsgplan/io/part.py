"""A part of a mesh file: some of its triangles with everything that belongs to them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Bools, Ints
from ..mesh import clean
from .file import MeshFile


def part_of(mesh_file: MeshFile, inside: Bools) -> tuple[MeshFile, Ints]:
    """Return a mesh file of triangles alone cut down to some, (n_triangles,), and the points kept, (k,).

    Data, boundaries, numbers and degrees follow their points and triangles.
    """
    cleaned = clean(mesh_file.mesh.points, mesh_file.mesh.triangles[inside])
    kept = cleaned.kept_points
    new_index = np.full(mesh_file.mesh.n_points, -1, dtype=np.int64)
    new_index[kept] = np.arange(len(kept))
    part = replace(
        mesh_file,
        mesh=cleaned.mesh,
        point_data={name: values[kept] for name, values in mesh_file.point_data.items()},
        cell_data={name: values[inside] for name, values in mesh_file.cell_data.items()},
        boundaries=tuple(boundary.renumbered(new_index) for boundary in mesh_file.boundaries),
        kept_points=mesh_file.kept_points[kept] if len(mesh_file.kept_points) else mesh_file.kept_points,
        degrees=mesh_file.degrees[kept] if len(mesh_file.degrees) else mesh_file.degrees,
    )
    return part, kept
