"""Writer of UGRID netCDF meshes (grammar in `ugrid`): classic netCDF, 64-bit offsets; no package needed."""

from __future__ import annotations

import os
import re
from typing import Any

import numpy as np

from ..arrays import Floats, Ints
from ..atomic import replacing
from ..errors import OutputError
from .boundary_edges import edge_groups
from .file import MeshFile
from .whole import warn_of_losses, whole_mesh

FILL = -1
"""Stands for the corner that a triangle lacks among quads."""
MAX_POINTS = 2**31 - 1
"""Points that the integers of a classic file can number."""


def write_ugrid(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write nodes, faces, point and cell arrays and the rim with its boundaries as flags.

    A projected mesh is written in degrees. Arrays of more than one number a point or cell have no place;
    cells of quads have no data. The file appears whole or not at all; raises OutputError.
    """
    whole = whole_mesh(mesh_file)
    if max(len(whole.points), len(whole.triangles) + len(whole.quads)) > MAX_POINTS:
        raise OutputError(f"{os.fspath(path)}: too many points for classic netCDF; write .vtu")
    points = {name: v for name, v in whole.point_data.items() if v.ndim == 1}
    cells = {name: v for name, v in mesh_file.cell_data.items() if v.ndim == 1}
    warn_of_losses(path, mesh_file, point_data=points, cell_data=cells, boundaries=("named", "open", "land"))
    from scipy.io import netcdf_file

    with replacing(path) as temporary, netcdf_file(temporary, "w", version=2, mmap=False) as file:
        file.Conventions = "CF-1.8 UGRID-1.0"
        if mesh_file.title:
            file.title = mesh_file.title
        _mesh(file, whole.points, _faces(whole.triangles, whole.quads), mesh_file.projection is not None)
        groups = edge_groups(whole.triangles, whole.quads, whole.boundaries, len(whole.points))
        if groups:
            _boundary(file, [(group.name, group.tag, group.edges) for group in groups])
        names: set[str] = set(file.variables)
        for name, values in points.items():
            _array(file, _unused(name, names), "node", values)
        for name, values in cells.items():
            n_quads = len(whole.quads)
            _array(file, _unused(name, names), "face", np.concatenate([values, np.full(n_quads, np.nan)]))


def _faces(triangles: Ints, quads: Ints) -> Ints:
    if not len(quads):
        return triangles
    padded = np.column_stack([triangles, np.full(len(triangles), FILL)])
    return np.concatenate([padded, quads])


def _mesh(file: Any, points: Floats, faces: Ints, is_lonlat: bool) -> None:
    names = [f"mesh_node_{axis}" for axis in (("lon", "lat", "z") if is_lonlat else ("x", "y", "z"))]
    names = names[: points.shape[1]]
    file.createDimension("mesh_n_node", len(points))
    file.createDimension("mesh_n_face", len(faces))
    file.createDimension("mesh_n_corner", faces.shape[1])
    topology = file.createVariable("mesh", "i4", ())
    topology.cf_role = "mesh_topology"
    topology.topology_dimension = np.int32(2)
    topology.node_coordinates = " ".join(names)
    topology.face_node_connectivity = "mesh_face_nodes"
    topology.face_dimension = "mesh_n_face"
    corners = file.createVariable("mesh_face_nodes", "i4", ("mesh_n_face", "mesh_n_corner"))
    corners.cf_role = "face_node_connectivity"
    corners.start_index = np.int32(0)
    corners._FillValue = np.int32(FILL)
    corners[:] = faces.astype(np.int32)
    plane = ("projection_x_coordinate", "projection_y_coordinate")
    for k, name in enumerate(names):
        values = file.createVariable(name, "f8", ("mesh_n_node",))
        if k < 2:
            values.standard_name = ("longitude", "latitude")[k] if is_lonlat else plane[k]
        if k < 2 and is_lonlat:
            values.units = ("degrees_east", "degrees_north")[k]
        values[:] = points[:, k]


def _boundary(file: Any, groups: list[tuple[str, int, Ints]]) -> None:
    ends = np.concatenate([edges for _, _, edges in groups])
    file.createDimension("mesh_n_boundary", len(ends))
    file.createDimension("two", 2)
    file.variables["mesh"].boundary_node_connectivity = "mesh_boundary_nodes"
    nodes = file.createVariable("mesh_boundary_nodes", "i4", ("mesh_n_boundary", "two"))
    nodes.cf_role = "boundary_node_connectivity"
    nodes.start_index = np.int32(0)
    nodes[:] = ends.astype(np.int32)
    flags = file.createVariable("mesh_boundary_flag", "i4", ("mesh_n_boundary",))
    flags.mesh = "mesh"
    flags.location = "boundary"
    flags.flag_values = np.array([tag for _, tag, _ in groups], dtype=np.int32)
    flags.flag_meanings = " ".join(name for name, _, _ in groups)
    flags[:] = np.concatenate([np.full(len(edges), tag, dtype=np.int32) for _, tag, edges in groups])


def _array(file: Any, name: str, location: str, values: Floats) -> None:
    variable = file.createVariable(name, "f8", (f"mesh_n_{location}",))
    variable.mesh = "mesh"
    variable.location = location
    variable._FillValue = np.nan
    variable[:] = values


def _unused(name: str, names: set[str]) -> str:
    """Return a name that netCDF takes and no variable has yet."""
    word = re.sub(r"[^A-Za-z0-9_.+@-]", "_", name)
    word = word if re.match(r"[A-Za-z_]", word) else f"_{word}"
    number, found = 2, word
    while found in names:
        found, number = f"{word}_{number}", number + 1
    names.add(found)
    return found
