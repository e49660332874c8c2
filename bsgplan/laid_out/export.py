"""The verb `export`: blocks or grid to a file of a solver, by the name of its flavour."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..errors import InvalidOption, OutputError
from ..io import Boundary, MeshFile
from ..io.boundary import labels
from ..io.boundary_edges import UNMARKED, rim
from ..io.fort14_boundaries import PAIRED
from ..io.fort14_write import write_fort14
from ..io.gmsh_write import write_msh22, write_msh41
from ..io.hyteg_write import write_hyteg
from ..io.pos_write import write_pos
from ..io.vtm_write import write_arrays, write_vtm
from ..io.whole import MATERIAL_ARRAYS
from ..mesh import Mesh
from ..mesh.edges import edge_keys
from .features import region_array
from .tracks import find_tracks

ALL = "boundary"
"""Name of the whole rim in Gmsh files where the mesh has no groups."""


def _fort14(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    for boundary, (_, name) in zip(mesh_file.boundaries, labels(mesh_file.boundaries), strict=True):
        if boundary.code in PAIRED and boundary.kind == "land" and boundary.partners is None:
            raise OutputError(
                f"{os.fspath(path)}: barrier {name} (IBTYPE {boundary.code}) has {boundary.n_nodes} nodes on "
                "one side that do not pair with the other; lay out with another --seed or smaller blocks"
            )
    depth = {name: values for name, values in mesh_file.point_data.items() if name == "depth"}
    write_fort14(replace(mesh_file, point_data=depth, cell_data={}), path)


def _groups_only(write: Callable[[MeshFile, Path], None]) -> Callable[[MeshFile, Path], None]:
    """Return a writer of points, groups and point arrays: meshio reads no data of cells in groups."""

    def written(mesh_file: MeshFile, path: Path) -> None:
        there = (name for name in MATERIAL_ARRAYS if name in mesh_file.cell_data)
        array = region_array(mesh_file) or next(there, None)
        kept = {} if array is None else {array: mesh_file.cell_data[array]}
        if array == "region":  # the writers know it by Gmsh's name
            kept = {"gmsh:physical": mesh_file.cell_data[array]}
        write(replace(mesh_file, cell_data=kept, boundaries=_groups(mesh_file)), path)

    return written


def _groups(mesh_file: MeshFile) -> tuple[Boundary, ...]:
    boundaries = tuple(_as_edges(mesh_file, boundary) for boundary in mesh_file.boundaries)
    return (*boundaries, *_rest(mesh_file.mesh, boundaries))


def _as_edges(mesh_file: MeshFile, boundary: Boundary) -> Boundary:
    """Return a boundary with every edge of the mesh on it: islands closed, both sides of a barrier."""
    tracks = find_tracks(mesh_file.mesh, (boundary,))
    ends = mesh_file.mesh.topology.edges[tracks.edge]
    is_along = tracks.start == ends[:, 0]
    return replace(boundary, edges=np.where(is_along[:, None], ends, ends[:, ::-1]))


def _rest(mesh: Mesh, boundaries: tuple[Boundary, ...]) -> tuple[Boundary, ...]:
    """Return the sides of the rim that no boundary has, as one more."""
    sides = rim(mesh.triangles, np.empty((0, 4), dtype=np.int64), mesh.n_points)
    taken = np.concatenate([np.empty((0, 2), dtype=np.int64), *(b.segments for b in boundaries)])
    sides = sides[~np.isin(edge_keys(sides, mesh.n_points), edge_keys(taken, mesh.n_points))]
    if not len(sides):
        return ()
    return (Boundary("named", np.unique(sides), name=UNMARKED if boundaries else ALL, edges=sides),)


FORMATS: dict[str, tuple[str, Callable[[MeshFile, Path], None]]] = {
    "msh22": (
        "Gmsh MSH 2.2, groups with names, tags above 0: MFEM, NGSolve, FEniCS",
        _groups_only(write_msh22),
    ),
    "msh41": ("Gmsh MSH 4.1, the same", _groups_only(write_msh41)),
    "hyteg": ("Gmsh MSH 2.2 without names, two tags, boundary lines flagged 1: HyTeG", write_hyteg),
    "vtu": ("VTK XML with every array: ParaView, PyVista", write_arrays),
    "vtm": ("VTK multi-block, one .vtu a block in a folder beside it", write_vtm),
    "fort14": ("ADCIRC and SCHISM, with depth and boundary lists", _fort14),
    "pos": ("Gmsh post-processing view of the wanted edge length", write_pos),
}
"""What each flavour is, and its writer."""

SUFFIXES = {".vtu": "vtu", ".vtm": "vtm", ".pos": "pos", ".14": "fort14", ".grd": "fort14", ".msh": "msh22"}
"""The flavour that a suffix means."""


def export(mesh_file: MeshFile, path: str | os.PathLike[str], *, format: str | None = None) -> None:
    """Write blocks or grid in a flavour, by default that of the suffix; whole or not at all.

    Raises InvalidOption for no such flavour and OutputError where the file cannot be written or, as fort.14,
    a barrier has lost its pairs.
    """
    FORMATS[flavour(path, format)][1](mesh_file, Path(path))


def n_boundaries_written(mesh_file: MeshFile, name: str) -> int:
    """Return how many boundaries a flavour writes: none, those of the mesh, or with the rest of its rim."""
    if name in ("msh22", "msh41"):
        return len(_groups(mesh_file))
    return len(mesh_file.boundaries) if name == "fort14" else 0


def flavour(path: str | os.PathLike[str], format: str | None = None) -> str:
    """Return the name of the flavour meant; raises InvalidOption.

    >>> flavour("grid.vtu")
    'vtu'
    """
    name = SUFFIXES.get(Path(path).suffix.lower()) if format is None else format
    if name not in FORMATS:
        what = (
            f"suffix {Path(path).suffix!r} tells no format"
            if format is None
            else f"format {format!r} is unknown"
        )
        raise InvalidOption(f"{os.fspath(path)}: {what}; give a --format of {', '.join(FORMATS)}")
    return name
