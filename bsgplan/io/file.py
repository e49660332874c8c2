"""The noun MeshFile: a mesh and everything else its file holds, and the clean-up that makes it.

Invariants: rows of `point_data` are the mesh's points, rows of `cell_data` its triangles, indices of
`boundaries` its points; whatever was turned, dropped or left out is told in `notes` and `ignored`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import Floats, Ints, frozen_floats, frozen_ints
from ..errors import InvalidMesh, MeshReadError
from ..memory import reused
from ..mesh import Mesh, clean
from ..mesh.check import is_planar
from ..words import counted
from .boundary import Boundary, n_nodes

if TYPE_CHECKING:
    from .projection import Projection


@dataclass(frozen=True, eq=False)
class RawMesh:
    """What a reader found, as it stands in the file."""

    points: Floats
    triangles: Ints
    quads: Ints
    point_data: dict[str, Floats] = field(default_factory=dict)
    cell_data: dict[str, Floats] = field(default_factory=dict)
    """Values at the triangles."""
    quad_data: dict[str, Floats] = field(default_factory=dict)
    """Values at the quads, where the reader has them."""
    boundaries: tuple[Boundary, ...] = ()
    ignored: dict[str, int] = field(default_factory=dict)
    """Cells of other types and how many."""
    midside: Ints = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    """Points that cells of higher order have beside their corners."""
    notes: tuple[str, ...] = ()
    title: str = ""
    cell_names: dict[str, dict[int, str]] = field(default_factory=dict)
    """Names of the values of a cell array, by array and value."""
    is_counting: bool = True
    """False where the points are not numbered one by one in the order of the file."""


@dataclass(frozen=True, eq=False)
class MeshFile:
    """A mesh as read from a file, cleaned, with its data, its boundaries and its quads beside it."""

    path: str
    """The path as it was given."""
    format: str
    """Name of the file format: "gmsh", "fort.14", "su2", ..."""
    mesh: Mesh
    """The triangles, cleaned."""
    quads: Ints
    """Corner indices into `quad_points`, (n_quads, 4); quads are not planned, only measured."""
    quad_points: Floats
    """Points of the quads, (n_quad_points, 2 or 3), in the unit of the mesh."""
    point_data: dict[str, Floats] = field(default_factory=dict)
    """Values at the points by name, (n_points, ...)."""
    cell_data: dict[str, Floats] = field(default_factory=dict)
    """Values at the triangles by name, (n_triangles, ...)."""
    boundaries: tuple[Boundary, ...] = ()
    """Open and land segments of ADCIRC and SCHISM, physical groups and markers of others."""
    ignored: dict[str, int] = field(default_factory=dict)
    """Cells that are not triangles, by type, and how many; quads among them."""
    notes: tuple[str, ...] = ()
    """One sentence for each thing that the clean-up did or left."""
    title: str = ""
    """First line of a fort.14 file."""
    projection: Projection | None = None
    """The map from degrees to the plane of `mesh`; None where the file's own coordinates are kept."""
    quad_nodes: Ints = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    """Index in the points of the mesh of each quad point, (n_quad_points,); -1 where no triangle has it."""
    quad_point_data: dict[str, Floats] = field(default_factory=dict)
    """Values at the points of the quads by name, (n_quad_points, ...)."""
    all_boundaries: tuple[Boundary, ...] = ()
    """The boundaries of triangles and quads together: points of quads alone follow those of the mesh,
    in the order of `quad_points`. Empty where there are no quads: then `boundaries` says it all."""
    kept_points: Ints = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    """Place in the file of each point, (n_points,), counted from 0."""
    n_file_points: int = 0
    """Points in the file, used or not."""
    cell_names: dict[str, dict[int, str]] = field(default_factory=dict)
    """Names of the values of a cell array (physical groups, materials), by array and value."""
    degrees: Floats = field(default_factory=lambda: np.empty((0, 2)))
    """Longitude and latitude of the points as the file has them, (n_points, 2), where they were projected."""
    is_renumbered: bool = False
    """True where the points are not numbered as in the file: dropped ones, or numbers in another order."""

    @cached_property
    def scale(self) -> Floats | None:
        """Plane metres per true metre at each point, (n_points,); None without a projection."""
        return None if self.projection is None else self.projection.scale(self.mesh.points)

    @property
    def file_points(self) -> Floats:
        """The points in the file's own coordinates, (n_points, 2 or 3): degrees where they were projected."""
        if self.projection is None:
            return self.mesh.points
        return self.degrees if len(self.degrees) else self.projection.to_degrees(self.mesh.points)

    def __repr__(self) -> str:
        return f"MeshFile({self.path!r}, {self.format}, {self.mesh!r})"

    def description(self) -> dict[str, Any]:
        """Return what the file holds beside the mesh, as plain data for a JSON document."""
        return {
            "path": self.path,
            "format": self.format,
            "title": self.title,
            "ignored": dict(self.ignored),
            "boundaries": [
                {"kind": b.kind, "code": b.code, "name": b.name, "n_nodes": b.n_nodes}
                for b in self.boundaries
            ],
            "arrays": {"points": sorted(self.point_data), "cells": sorted(self.cell_data)},
            "notes": list(self.notes),
            "projection": None if self.projection is None else self.projection.description(),
        }


@reused()
def assemble(path: str, format: str, raw: RawMesh, projection: Projection | None = None) -> MeshFile:
    """Return the cleaned MeshFile of what a reader found; data and boundaries follow their points."""
    if not len(raw.triangles):
        remedy = "split its quads with --split-quads" if len(raw.quads) else "give a mesh of triangles"
        raise MeshReadError(f"{path}: no triangles, it holds {_contents(raw)}; {remedy}")
    try:
        check_quads(raw)
        cleaned = clean(raw.points, raw.triangles)
        _check_duplicates(cleaned.mesh)
    except InvalidMesh as error:
        base = "numbers count from 0" + ("" if _all_used(raw) else ", unused points left out")
        raise InvalidMesh(f"{path}: {error} ({base})") from None
    new_index = np.full(len(raw.points), -1, dtype=np.int64)
    new_index[cleaned.kept_points] = np.arange(len(cleaned.kept_points))
    boundaries = tuple(boundary.renumbered(new_index) for boundary in raw.boundaries)
    quad_points, quads, used = quads_apart(raw)
    is_own = new_index[used] < 0
    all_index = new_index.copy()
    all_index[used[is_own]] = len(cleaned.kept_points) + np.arange(np.count_nonzero(is_own))
    is_used = new_index >= 0
    is_used[raw.quads] = is_used[raw.midside] = True
    n_unused = len(raw.points) - int(np.count_nonzero(is_used))
    n_lost = n_nodes(raw.boundaries) - n_nodes(boundaries)
    n_coincident = _n_coincident(cleaned.mesh.points)
    n_flipped = cleaned.n_flipped
    turned = "clockwise triangle{} turned counter-clockwise"
    if not cleaned.mesh.is_planar:
        turned = "triangle{} turned to run as the others of the surface"
    n_folds = int(np.count_nonzero(cleaned.mesh.topology.runs_alike)) if cleaned.mesh.is_planar else 0
    told = {
        "cells of higher order are taken by their corners": len(raw.midside),
        f"{n_flipped} {turned.format(_s(n_flipped))}": n_flipped,
        f"{n_folds} edge{_s(n_folds)} with both triangles on one side: the mesh is folded there": n_folds,
        f"{n_unused} point{_s(n_unused)} of no cell dropped": n_unused,
        f"{counted(n_lost, 'boundary entry', 'boundary entries')} dropped, of points in no triangle": n_lost,
        "constant third coordinate dropped": cleaned.is_flattened,
        f"{counted(n_coincident, 'point coincides', 'points coincide')} with another point; they stay apart, "
        "none was merged": n_coincident,
        f"{len(quads)} quad{_s(len(quads))} measured apart; --split-quads makes them triangles": len(quads),
    }
    return MeshFile(
        path=path,
        format=format,
        mesh=cleaned.mesh,
        quads=frozen_ints(quads),
        quad_points=frozen_floats(quad_points),
        quad_nodes=frozen_ints(new_index[used]),
        all_boundaries=tuple(b.renumbered(all_index) for b in raw.boundaries) if len(quads) else (),
        quad_point_data={name: frozen_floats(v[used]) for name, v in raw.point_data.items()},
        point_data={name: frozen_floats(v[cleaned.kept_points]) for name, v in raw.point_data.items()},
        cell_data={name: frozen_floats(v) for name, v in raw.cell_data.items()},
        boundaries=boundaries,
        ignored=dict(raw.ignored),
        notes=(*raw.notes, *(sentence for sentence, happened in told.items() if happened)),
        title=raw.title,
        projection=projection,
        kept_points=frozen_ints(cleaned.kept_points),
        n_file_points=len(raw.points),
        cell_names={name: dict(names) for name, names in raw.cell_names.items()},
        is_renumbered=not raw.is_counting or len(cleaned.kept_points) < len(raw.points),
    )


def _contents(raw: RawMesh) -> str:
    cells = ", ".join(f"{count} {name} cells" for name, count in raw.ignored.items()) or "no cells"
    return f"{len(raw.points)} points, {cells}"


def _all_used(raw: RawMesh) -> bool:
    return len(np.unique(raw.triangles)) == len(raw.points)


def check_quads(raw: RawMesh) -> None:
    """Raise InvalidMesh where a quad names a point that is not there."""
    is_bad = ((raw.quads < 0) | (raw.quads >= len(raw.points))).any(axis=1)
    if is_bad.any():
        first = int(np.flatnonzero(is_bad)[0])
        raise InvalidMesh(f"quad {first} names a point outside 0 .. {len(raw.points) - 1}; repair the file")


def _check_duplicates(mesh: Mesh) -> None:
    """Raise InvalidMesh where two triangles have the same corners: where they share all of their edges."""
    topology, own = mesh.topology, np.arange(mesh.n_triangles)
    both = topology.edge_cells[:, 0] + topology.edge_cells[:, 1]
    beside = [both[edges] - own for edges in topology.cell_edges.T]
    is_same = (beside[0] == beside[1]) & (beside[1] == beside[2]) & (beside[0] > own)
    if is_same.any():
        first, n = int(np.flatnonzero(is_same)[0]), int(np.count_nonzero(is_same))
        raise InvalidMesh(
            f"{n} triangle{_s(n)} stand{'s' if n == 1 else ''} in the file twice, the first {first} and "
            f"{beside[0][first]}; save each triangle once (one physical group each)"
        )


def quads_apart(raw: RawMesh) -> tuple[Floats, Ints, Ints]:
    """Return points of the quads, (n, 2 or 3), the quads, (n_quads, 4), by them, and their places, (n,)."""
    check_quads(raw)
    used, quads = np.unique(raw.quads, return_inverse=True)
    points = raw.points[used]
    if len(used) and points.shape[1] == 3 and is_planar(points):
        points = points[:, :2]
    return points, quads.reshape(-1, 4).astype(np.int64), used.astype(np.int64)


def _n_coincident(points: Floats) -> int:
    if points.shape[1] == 2:  # complex numbers are sorted in one go, by x and then by y
        places = np.sort(np.ascontiguousarray(points).view(np.complex128)[:, 0])
        return int(np.count_nonzero(places[1:] == places[:-1]))
    ordered = points[np.lexsort(points.T)]
    return int(np.count_nonzero((ordered[1:] == ordered[:-1]).all(axis=1)))


def _s(count: int) -> str:
    return "" if count == 1 else "s"
