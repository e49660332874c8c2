"""Reader of UGRID netCDF meshes: two-dimensional topology, its node and face data, its boundary.

Grammar [UGRID conventions 1.0]: a variable with cf_role = "mesh_topology" and topology_dimension = 2, whose
attributes name others:

    node_coordinates              two variables, x (longitude) and y (latitude), in either order; a third is z
    face_node_connectivity        (n_faces, max_corners) or, as its face_dimension tells, the other way round;
                                  its attributes start_index (0 or 1) and _FillValue (no further corner)
    boundary_node_connectivity    optional, (n_segments, 2); a variable of the same length with flag_values
                                  and flag_meanings tells kinds of segments apart

Every other variable over the nodes or the faces is data; where a time comes before, that of the last time.
Faces of three corners are triangles, of four quads, others are left out. Classic files (netCDF-3) need no
package, netCDF-4 needs the extra `netcdf`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..errors import BsgplanError, MeshReadError
from .boundary import Boundary
from .cell_rows import check_corners
from .file import RawMesh
from .netcdf_variables import Variable, open_variables, unreadable

Variables = dict[str, Variable]


def read_ugrid(path: Path) -> RawMesh:
    """Return nodes, faces, data and boundary of the first two-dimensional topology of a UGRID file."""
    contents = open_variables(path)
    try:
        return replace(_raw_mesh(contents.variables), title=" ".join(contents.title.split()))
    except (BsgplanError, MemoryError):
        raise
    except Exception as error:  # a damaged file raises anything while its values are read
        raise unreadable(error) from None
    finally:
        contents.close()


def _raw_mesh(variables: Variables) -> RawMesh:
    topology = _topology(variables)
    coordinates = _coordinates(variables, topology)
    points = np.column_stack([_floats(c) for c in coordinates])
    connectivity = _named(variables, topology, "face_node_connectivity")
    faces, face_axis, notes = _corners(topology, connectivity, len(points))
    n_corners = (faces >= 0).sum(axis=1)
    if ((faces >= 0) != (np.arange(faces.shape[1]) < n_corners[:, None])).any():
        raise MeshReadError(f"{connectivity.name} has fill values between corners; repair the file")
    triangles, quads = (faces[n_corners == n, :n] for n in (3, 4))
    check_corners(triangles, len(points), "triangle")
    check_corners(quads, len(points), "quad")
    node_dimension, face_dimension = coordinates[0].dimensions[0], connectivity.dimensions[face_axis]
    used = {topology.name, connectivity.name, *(c.name for c in coordinates)}
    used |= set(topology.text("face_coordinates").split())
    others = int(np.count_nonzero((n_corners != 3) & (n_corners != 4)))
    ignored = {"quad": len(quads), "polygon": others}
    return RawMesh(
        points=points,
        triangles=triangles,
        quads=quads,
        point_data=dict(_data(variables, node_dimension, used)),
        cell_data={n: v[n_corners == 3] for n, v in _data(variables, face_dimension, used)},
        boundaries=_boundaries(variables, topology, len(points)),
        ignored={kind: count for kind, count in ignored.items() if count},
        notes=tuple(notes),
    )


def _topology(variables: Variables) -> Variable:
    found = [v for v in variables.values() if v.text("cf_role") == "mesh_topology"]
    planar = [v for v in found if v.number("topology_dimension", 0) == 2]
    if not planar:
        what = "a mesh topology of another dimension" if found else "no variable with cf_role mesh_topology"
        raise MeshReadError(
            f"{what}, the file is no two-dimensional UGRID mesh; convert it with xugrid, or give a text mesh"
        )
    return planar[0]


def _named(variables: Variables, topology: Variable, attribute: str) -> Variable:
    name = topology.text(attribute)
    if name not in variables:
        raise MeshReadError(
            f"{topology.name}: its {attribute} {name!r} is not in the file; repair the topology variable"
        )
    return variables[name]


def _coordinates(variables: Variables, topology: Variable) -> list[Variable]:
    names = topology.text("node_coordinates").split()
    missing = [name for name in names if name not in variables]
    if len(names) not in (2, 3) or missing:
        raise MeshReadError(
            f"{topology.name}: needs node_coordinates of two variables, got {' '.join(names)!r}"
            + (f", {missing[0]} is not in the file" if missing else "")
            + "; repair the topology variable"
        )
    found = [variables[name] for name in names]
    if any(len(v.shape) != 1 or v.shape != found[0].shape for v in found):
        raise MeshReadError(f"{' and '.join(names)} have not one value a node; repair the file")
    if _is_second(found[0]) and not _is_second(found[1]):
        found[:2] = found[1], found[0]
    return found


def _is_second(variable: Variable) -> bool:
    name, unit = variable.text("standard_name"), variable.text("units").lower()
    return name in ("latitude", "projection_y_coordinate") or unit in ("degrees_north", "degree_north")


def _corners(topology: Variable, variable: Variable, n_points: int) -> tuple[Ints, int, list[str]]:
    """Return the corners of the faces from 0, -1 where there are none, and which axis counts the faces."""
    if len(variable.shape) != 2:
        raise MeshReadError(f"{variable.name} has {len(variable.shape)} dimensions, not 2; repair the file")
    face_dimension = topology.text("face_dimension")
    if face_dimension in variable.dimensions:
        axis = variable.dimensions.index(face_dimension)
    else:
        axis = int(variable.shape[0] in (3, 4) and variable.shape[1] not in (3, 4))
    if variable.shape[1 - axis] < 3:
        raise MeshReadError(f"{variable.name} has {variable.shape[1 - axis]} corners a face; repair the file")
    values = variable.values()
    values = values.T if axis else values
    index, is_corner = _indices(variable, values)
    notes = []
    if "start_index" not in variable.attributes and is_corner.any():
        smallest, largest = index[is_corner].min(), index[is_corner].max()
        if smallest == 1 and largest == n_points:
            index = index - 1
            notes.append(f"{variable.name} has no start_index, its nodes count from 1")
    return np.where(is_corner, index, -1), axis, notes


def _indices(variable: Variable, values: Any) -> tuple[Ints, Bools]:
    """Return node indices from 0, and where there is one."""
    start = int(variable.number("start_index", 0))
    fill = variable.number("_FillValue", np.nan)
    numbers = values.astype(np.float64)
    is_node = np.isfinite(numbers) & (numbers != fill) & (numbers >= 0)
    whole = np.where(is_node, np.clip(numbers, 0, 2**53), 0)
    if (whole != np.rint(whole)).any():
        raise MeshReadError(f"{variable.name} has fractions for nodes; repair the file")
    index = whole.astype(np.int64) - start
    if (is_node & (index < 0)).any():
        raise MeshReadError(f"{variable.name} names node 0, but its start_index is {start}; repair it")
    return index, is_node


def _data(variables: Variables, dimension: str, used: set[str]) -> Iterator[tuple[str, Floats]]:
    """Yield the arrays over a dimension, of the last time where a time comes before."""
    for name, variable in variables.items():
        if name in used or variable.dimensions[-1:] != (dimension,):
            continue
        if len(variable.dimensions) == 1:
            yield from _numeric(variable, slice(None))
        elif len(variable.dimensions) == 2 and "time" in variable.dimensions[0].lower() and variable.shape[0]:
            yield from _numeric(variable, variable.shape[0] - 1)


def _numeric(variable: Variable, index: Any) -> Iterator[tuple[str, Floats]]:
    try:
        values = variable.values(index)
    except MeshReadError:
        return  # characters
    yield variable.name, _unpacked(variable, values)


def _floats(variable: Variable) -> Floats:
    return _unpacked(variable, variable.values())


def _unpacked(variable: Variable, values: Any) -> Floats:
    """Return stored values as they are meant: scaled, nan where there is none."""
    fill = variable.number("_FillValue", variable.number("missing_value", np.nan))
    floats = values.astype(np.float64)
    scaled = floats * variable.number("scale_factor", 1.0) + variable.number("add_offset", 0.0)
    return np.where(floats == fill, np.nan, scaled)


def _boundaries(variables: Variables, topology: Variable, n_points: int) -> tuple[Boundary, ...]:
    name = topology.text("boundary_node_connectivity")
    if name not in variables:
        return ()
    variable = variables[name]
    if len(variable.shape) != 2 or variable.shape[1] != 2:
        raise MeshReadError(f"{name} has shape {variable.shape}, not two nodes a segment; repair the file")
    ends, is_node = _indices(variable, variable.values())
    check_corners(np.where(is_node, ends, -1), n_points, "boundary segment")
    kinds = [
        v
        for v in variables.values()
        if v.dimensions == variable.dimensions[:1] and "flag_values" in v.attributes
    ]
    if not kinds:
        return (Boundary("named", np.unique(ends), None, name, edges=ends),)
    values = kinds[0].values().astype(np.int64)
    flags = np.ravel(kinds[0].attributes["flag_values"])
    flags = np.array(str(flags[0]).split() if flags.dtype.kind in "SU" else flags, dtype=np.float64)
    words = kinds[0].text("flag_meanings").split()
    meanings = dict(zip(flags.astype(np.int64).tolist(), words, strict=False))
    return tuple(
        Boundary("named", np.unique(edges), value, meanings.get(value, ""), edges=edges)
        for value in np.unique(values).tolist()
        for edges in [ends[values == value]]
    )
