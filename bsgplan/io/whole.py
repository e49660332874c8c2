"""What a writer writes: triangles and quads over one set of points, and the warning of what has no place."""

from __future__ import annotations

import logging
import os
from collections.abc import Collection, Iterable
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..errors import OutputError
from .boundary import Boundary
from .file import MeshFile

log = logging.getLogger("bsgplan")

EVERY = "every"
"""In place of names: arrays of any name have a place."""


@dataclass(frozen=True, eq=False)
class WholeMesh:
    """The mesh of a file with its quads, in the coordinates of the file: degrees where it was projected."""

    points: Floats
    """First the points of the triangles, in their order, then those of quads alone, (n, 2 or 3)."""
    triangles: Ints
    """(n_triangles, 3)."""
    quads: Ints
    """(n_quads, 4)."""
    point_data: dict[str, Floats]
    """Values at all points by name, (n, ...)."""
    boundaries: tuple[Boundary, ...]
    """The boundaries, their nodes indices into `points`."""

    @property
    def spatial_points(self) -> Floats:
        """The points with a third coordinate, 0 where the mesh is planar, (n, 3)."""
        return np.column_stack([self.points, np.zeros((len(self.points), 3 - self.points.shape[1]))])


def whole_mesh(mesh_file: MeshFile) -> WholeMesh:
    """Return the triangles and quads of a mesh file over one set of points.

    Raises OutputError where the triangles lie in a plane and the quads in space, or the other way round.
    """
    mesh, index = mesh_file.mesh, mesh_file.quad_nodes
    points, data = mesh.points, dict(mesh_file.point_data)
    quads = np.empty((0, 4), dtype=np.int64)
    if len(mesh_file.quads):
        if mesh_file.quad_points.shape[1] != points.shape[1]:
            raise OutputError(
                f"{mesh_file.path}: its triangles have {points.shape[1]} coordinates, "
                f"its quads {mesh_file.quad_points.shape[1]}; write the triangles and the quads apart"
            )
        is_own = index < 0
        numbers = np.where(is_own, mesh.n_points + np.cumsum(is_own) - 1, index)
        quads = numbers[mesh_file.quads]
        points = np.concatenate([points, mesh_file.quad_points[is_own]])
        data = {n: np.concatenate([v, mesh_file.quad_point_data[n][is_own]]) for n, v in data.items()}
    if mesh_file.projection is not None:
        own = mesh_file.projection.to_degrees(points[mesh.n_points :])
        points = np.concatenate([mesh_file.file_points, own])
    boundaries = mesh_file.all_boundaries if len(quads) else mesh_file.boundaries
    return WholeMesh(points, mesh.triangles, quads, data, boundaries)


REGION_ARRAYS = ("gmsh:physical", "material", "medit:ref", "attribute", "tag", "netgen:index")
"""What formats call the number of the region (material, physical group) that a cell belongs to."""

MATERIAL_ARRAYS = (*REGION_ARRAYS, "region")
"""Cell arrays that tell materials apart: also what bsgplan itself calls them."""


@dataclass(frozen=True, eq=False)
class CellRegions:
    """The number of a region at each triangle, where a file has one."""

    array: str | None
    """Name of the cell array; None where no array holds such numbers."""
    ids: Ints
    """(n_triangles,); all 1 where there is no such array."""
    names: dict[int, str]
    """Names by number."""


def cell_regions(mesh_file: MeshFile) -> CellRegions:
    """Return the first array of `REGION_ARRAYS` that the mesh file has and that holds whole numbers."""
    for name in REGION_ARRAYS:
        values = mesh_file.cell_data.get(name)
        if values is not None and values.ndim == 1 and (np.abs(values) < 2**31).all():
            ids = values.astype(np.int64)
            if (ids == values).all():
                return CellRegions(name, ids, mesh_file.cell_names.get(name, {}))
    return CellRegions(None, np.ones(mesh_file.mesh.n_triangles, dtype=np.int64), {})


def warn_of_losses(
    path: str | os.PathLike[str],
    mesh_file: MeshFile,
    *,
    point_data: Collection[str] | str = (),
    cell_data: Collection[str] | str = (),
    boundaries: Collection[str] = (),
    has_barriers: bool = False,
    also: Iterable[str] = (),
) -> None:
    """Warn once of all that a mesh file holds and a format has no place for.

    Given are the names of the arrays that have a place (`EVERY` for all) the kinds of boundaries, and
    whether the partners and heights at their nodes have one; `also` names what else is lost.
    """
    lost = [*also]
    lost += [f"point array {name}" for name in mesh_file.point_data if not _has_place(name, point_data)]
    lost += [f"cell array {name}" for name in mesh_file.cell_data if not _has_place(name, cell_data)]
    kinds = [boundary.kind for boundary in mesh_file.boundaries if boundary.kind not in boundaries]
    counts = [(kind, kinds.count(kind)) for kind in dict.fromkeys(kinds)]
    lost += [f"{count} {kind} boundar{'y' if count == 1 else 'ies'}" for kind, count in counts]
    told = [b for b in mesh_file.boundaries if b.kind in boundaries]
    n_barriers = sum(b.partners is not None or b.columns is not None for b in told)
    if n_barriers and not has_barriers:
        lost.append(f"the heights and pairs of {n_barriers} barrier{'' if n_barriers == 1 else 's'}")
    if len(mesh_file.quads) and mesh_file.cell_data:
        lost.append("cell arrays at the quads")
    if lost:
        log.warning("%s: this format has no place for %s", os.fspath(path), ", ".join(lost))


def _has_place(name: str, names: Collection[str] | str) -> bool:
    return names == EVERY or name in names
