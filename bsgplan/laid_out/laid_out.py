"""The noun LaidOut: a grid of blocks and the file it was made from, as files that solvers read."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from math import log2
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints, sums_by
from ..blocks import BlockGrid
from ..blocks.kinds import HALF_EDGE
from ..blocks.layout import interpolated
from ..blocks.placed import PlacedMesh
from ..io import MeshFile
from ..mesh import Mesh
from .carried import carried, unpaired_nodes
from .features import region_array
from .tracks import Tracks, find_tracks

FORMAT = "layout"
"""The `format` of mesh files made here."""

MARKERS = ("marker", "medit:ref", "gmsh:physical", "boundary")
"""Point arrays of labels: taken from the nearest corner, not interpolated."""

DROPPED = ("ipobo", "gmsh:geometrical")
"""Arrays that number the input's own parts, without meaning for another mesh."""


@dataclass(frozen=True, eq=False)
class LaidOut:
    """A block-structured grid and the mesh file that it was laid out for."""

    grid: BlockGrid
    """The grid and, in it, the layout of blocks."""
    mesh_file: MeshFile = field(repr=False)
    """The input; the grid's size field lies on its mesh."""

    @cached_property
    def _tracks(self) -> Tracks:
        return find_tracks(self.mesh_file.mesh, self.mesh_file.boundaries)

    @cached_property
    def block_region(self) -> Ints:
        """Material of each block, (n_blocks,): the one most of its triangles lie in; 1 where there is one."""
        name, grid = region_array(self.mesh_file), self.grid
        n_blocks = grid.layout.n_blocks
        if name is None:
            return np.ones(n_blocks, dtype=np.int64)
        ids, own = np.unique(self.mesh_file.cell_data[name][self._cells_under_grid], return_inverse=True)
        votes = np.bincount(grid.block * len(ids) + own, minlength=n_blocks * len(ids))
        return np.asarray(ids[votes.reshape(n_blocks, -1).argmax(axis=1)], dtype=np.int64)

    @cached_property
    def _cells_under_grid(self) -> Ints:
        """The input's triangle that holds the centroid of each triangle of the grid, (n_triangles,)."""
        return _cells_under(self.grid, self.grid.placed)

    @cached_property
    def unpaired_nodes(self) -> Ints:
        """Points to keep as well, (k,), so that barriers get their pairs back; none where all have them.

        Lay out again with these beside the kept ones: both sides are then cut where either was.
        """
        source, layout = self.mesh_file, self.grid.layout
        return unpaired_nodes(source.mesh, source.boundaries, self._tracks, layout.domain, layout.placed)

    def blocks_file(self) -> MeshFile:
        """Return the blocks as a mesh file: one triangle a block, boundaries and data carried over.

        Cell arrays `block`, `level` (uniform refinements that make the grid, log2 of side), `region`, `size`
        (edge of the equilateral triangle of the same area, true length) and `quality` (mean ratio); point
        arrays `irregularity` (valence off what the place wants) and `target_size` (edge wanted, true length).
        """
        layout = self.grid.layout
        cells: dict[str, Floats | Ints] = {
            "block": np.arange(layout.n_blocks),
            "level": np.full(layout.n_blocks, log2(layout.side)),
            "region": self.block_region,
            "size": self._sizes(layout.mesh),
            "quality": layout.mesh.qualities,
        }
        under = _cells_under(self.grid, layout.placed)
        points: dict[str, Floats | Ints] = {
            "irregularity": _irregularity(layout.placed),
            "target_size": self._target(layout.placed, 1),
        }
        return self._file(layout.mesh, layout.placed, under, self.block_region, cells, points)

    def grid_file(self) -> MeshFile:
        """Return the grid as a mesh file; cell arrays `block`, `i`, `j`, `region`, `size` and `quality`.

        Triangles with the same i and j that point the other way follow those that point the block's way.
        """
        grid = self.grid
        region = self.block_region[grid.block]
        cells: dict[str, Floats | Ints] = {
            "block": grid.block,
            "i": grid.i,
            "j": grid.j,
            "region": region,
            "size": self._sizes(grid.mesh),
            "quality": grid.mesh.qualities,
        }
        side = grid.layout.side
        points: dict[str, Floats | Ints] = {
            "irregularity": _irregularity(grid.placed),
            "target_size": self._target(grid.placed, side),
        }
        return self._file(grid.mesh, grid.placed, self._cells_under_grid, region, cells, points)

    def _file(
        self,
        mesh: Mesh,
        placed: PlacedMesh,
        under: Ints,
        region: Ints,
        cells: dict[str, Floats | Ints],
        points: dict[str, Floats | Ints],
    ) -> MeshFile:
        source, domain = self.mesh_file, self.grid.layout.domain
        name = region_array(source)
        cell_data = {n: v[under] for n, v in source.cell_data.items() if n not in DROPPED}
        if name is not None:
            cell_data[name] = region.astype(np.float64)
        point_data = {}
        for n, values in source.point_data.items():
            if n in MARKERS:
                point_data[n] = _nearest(self.grid, placed, values)
            elif n not in DROPPED:
                point_data[n] = interpolated(domain, placed, values)
        return MeshFile(
            path=source.path,
            format=FORMAT,
            mesh=mesh,
            quads=np.empty((0, 4), dtype=np.int64),
            quad_points=np.empty((0, 2)),
            point_data={**point_data, **{n: np.asarray(v) for n, v in points.items()}},
            cell_data={**cell_data, **{n: np.asarray(v) for n, v in cells.items()}},
            cell_names={n: names for n, names in source.cell_names.items() if n in cell_data},
            boundaries=carried(source.mesh, source.boundaries, self._tracks, domain, placed),
            title=source.title or Path(source.path).name,
            projection=source.projection,
        )

    def _sizes(self, mesh: Mesh) -> Floats:
        size = np.sqrt(mesh.areas * 4 / np.sqrt(3))
        projection = self.mesh_file.projection
        return size if projection is None else size / projection.scale(mesh.centroids)

    def _target(self, placed: PlacedMesh, side: int) -> Floats:
        """Return the wanted edge of a block over side at the vertices, (n_points,), true length."""
        layout = self.grid.layout
        domain = layout.domain
        at_input = np.zeros(self.mesh_file.mesh.n_points)
        at_input[domain.source] = layout.target.length
        wanted = interpolated(domain, placed, at_input) / side
        projection = self.mesh_file.projection
        return wanted if projection is None else wanted / projection.scale(domain.to_mesh(placed.points))


def _cells_under(grid: BlockGrid, placed: PlacedMesh) -> Ints:
    from ..blocks.kernel.walk import locate

    domain = grid.layout.domain
    centroids = placed.points[placed.triangles].mean(axis=1)
    return locate(domain.points, domain.triangles, centroids, placed.hints[placed.triangles[:, 0]])[0]


def _nearest(grid: BlockGrid, placed: PlacedMesh, values: Floats) -> Floats:
    from ..blocks.kernel.walk import locate

    domain = grid.layout.domain
    triangle, shares = locate(domain.points, domain.triangles, placed.points, placed.hints)
    return np.asarray(values[domain.source[domain.triangles[triangle, shares.argmax(axis=1)]]])


def _irregularity(placed: PlacedMesh) -> Ints:
    """Return the edges of each vertex beyond those its place wants, (n_points,): 0 where it is regular.

    6 inside, 4 on the boundary, what the angle wants at a corner, regular there within half an edge.
    """
    count = sums_by(placed.triangles, np.ones(placed.triangles.shape), len(placed.points))
    off = placed.topology.valence - placed.goals
    rounded = np.sign(off) * np.ceil(np.abs(off) - HALF_EDGE)
    return np.where(placed.is_irregular & (count > 0), rounded, 0).astype(np.int64)
