"""Layouts for ParaView and PyVista: the blocks one cell each, and the grid with the block of each triangle.

Blocks carry `block`, `level` (0), `region` (component of the domain), `size` (wanted edge) and `quality`; the
grid the same of its triangles, and `i`, `j` inside the block. Points on curves carry `curve`, -1 inside.
"""

from __future__ import annotations

import os

import numpy as np

from ..arrays import Floats, Ints
from ..blocks.layout import BlockGrid, BlockLayout, interpolated
from ..blocks.placed import PlacedMesh
from ..mesh import Mesh
from .projection import Projection
from .vtk_cells import check_suffix, write_cells


def write_blocks(
    path: str | os.PathLike[str], layout: BlockLayout, projection: Projection | None = None
) -> None:
    """Write the blocks of a layout, straight, as .vtu, or .vtk by the suffix; whole or not at all."""
    block = np.arange(layout.n_blocks)
    _write(path, layout, layout.mesh, layout.placed, {"block": block, "level": 0 * block}, 1.0, projection)


def write_grid(path: str | os.PathLike[str], grid: BlockGrid, projection: Projection | None = None) -> None:
    """Write the triangles of a grid as .vtu, or .vtk by the suffix; whole or not at all."""
    side = grid.layout.side
    level = np.full(grid.n_triangles, round(np.log2(side)))
    arrays = {"block": grid.block, "level": level, "i": grid.i, "j": grid.j}
    _write(path, grid.layout, grid.mesh, grid.placed, arrays, 1.0 / side, projection)


def _write(
    path: str | os.PathLike[str],
    layout: BlockLayout,
    mesh: Mesh,
    placed: PlacedMesh,
    arrays: dict[str, Ints],
    factor: float,
    projection: Projection | None,
) -> None:
    check_suffix(path)
    domain = layout.domain
    wanted = np.empty(layout.size.mesh.n_points)
    wanted[domain.source] = np.log(layout.target.length)
    size: Floats = factor * np.exp(interpolated(domain, placed, wanted))
    points = mesh.points
    if projection is not None:
        size = size / projection.scale(points)
        points = projection.to_unbroken_degrees(points)
    triangle_size = np.exp(np.log(size)[mesh.triangles].mean(axis=1))
    cell_data: dict[str, list[Ints | Floats]] = {name: [values] for name, values in arrays.items()}
    cell_data |= {
        "region": [mesh.topology.component],
        "size": [triangle_size],
        "quality": [mesh.qualities],
    }
    write_cells(
        path,
        points,
        (("triangle", mesh.triangles),),
        point_data={"curve": placed.curves, "irregularity": mesh.vertex_irregularity, "size": size},
        cell_data=cell_data,
    )
