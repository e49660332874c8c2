"""The verb `sizes_from`: a size file in, the wanted edge length at every point of a mesh out.

By content: a Gmsh view (.pos), a Medit solution (.sol), a grid of JIGSAW, and any mesh file as a background.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import InvalidSize, MeshReadError
from ..mesh import Mesh
from ..mesh.operators import to_vertices
from ..sizing import size_field
from ..sizing.background import Background
from ..sizing.grid import FULL_TURN, GridBackground, around_the_globe
from .file import MeshFile
from .read import assembled, read_raw
from .size_jigsaw import read_grid
from .size_pos import read_pos
from .size_sol import read_sol

HEAD = 4096
"""Bytes looked at to tell a size file from a mesh file."""
VIEW = re.compile(rb"(?>\s|//[^\n]*+|/\*.*?\*/)*+View\s*+\"", re.DOTALL)
SOLUTION = re.compile(rb"(?>\s|#[^\n]*+)*+MeshVersionFormatted\b.*?\bSolAt", re.DOTALL)
GRID = re.compile(rb"(?>\s|#[^\n]*+)*+mshid\s*+=[^\n]*-grid\b", re.IGNORECASE)
SIZE_FORMATS = (".pos", "jigsaw")
"""Suffix and format of mesh files that hold sizes and nothing else: there the only array needs no name."""


def sizes_from(path: str | os.PathLike[str], mesh_file: MeshFile, *, name: str | None = None) -> Floats:
    """Return the edge length at each point of a mesh, (n_points,), in the unit of its coordinates.

    name is the array or view of the size file; without one, its only view, or the edges of the background
    mesh. Where the mesh is projected from degrees, so is the size file, and lengths in it are metres.
    Raises MeshReadError where the file cannot be read, InvalidSize where it does not cover the mesh.
    """
    projection = mesh_file.projection
    try:
        sizes = _reader(Path(path))(Path(path), mesh_file, name)
    except (MeshReadError, InvalidSize) as error:
        shown = os.fspath(path)
        message = str(error) if str(error).startswith(shown) else f"{shown}: {error}"
        raise type(error)(message) from None
    except OSError as error:
        raise MeshReadError(f"{path}: cannot be read ({error.strerror or error}); check the file") from None
    return sizes if projection is None else sizes * projection.scale(mesh_file.mesh.points)


Reader = Callable[[Path, MeshFile, str | None], Floats]


def _reader(path: Path) -> Reader:
    with path.open("rb") as stream:
        head = stream.read(HEAD).removeprefix(b"\xef\xbb\xbf")
    if head.startswith(b"$PostFormat"):
        raise MeshReadError("a legacy .pos file; open it in Gmsh and save it as .pos, or as .msh")
    if VIEW.match(head):
        return _from_view
    if SOLUTION.match(head):
        return _from_solution
    if path.suffix.lower() in (".sol", ".solb"):
        raise MeshReadError("no text of a Medit solution; give an ASCII .sol (mmg writes one)")
    return _from_grid if GRID.match(head) else _from_mesh


def _from_view(path: Path, mesh_file: MeshFile, name: str | None) -> Floats:
    return _read_off(read_pos(path, name), mesh_file)


def _from_solution(path: Path, mesh_file: MeshFile, name: str | None) -> Floats:
    if name is not None:
        raise MeshReadError(f"a .sol names no array, --size {name!r} is not there; leave out --size")
    solution = read_sol(path)
    if len(solution.values) != mesh_file.n_file_points:
        raise InvalidSize(
            f"{len(solution.values)} values, but {mesh_file.path} has {mesh_file.n_file_points} points; "
            "give the solution that belongs to this mesh"
        )
    return solution.at(mesh_file.mesh, mesh_file.kept_points)


def _from_grid(path: Path, mesh_file: MeshFile, name: str | None) -> Floats:
    if name is not None:
        raise MeshReadError(f"a grid names no array, --size {name!r} is not there; leave out --size")
    is_lonlat = mesh_file.projection is not None
    grid = read_grid(path, is_lonlat=is_lonlat)
    where = _places(mesh_file)
    if not is_lonlat:
        return grid.at(where)
    check_degrees(np.array([[grid.x[0], grid.y[0]], [grid.x[-1], grid.y[-1]]]))
    return at_longitudes(around_the_globe(grid), where)


def _from_mesh(path: Path, mesh_file: MeshFile, name: str | None) -> Floats:
    is_lonlat = mesh_file.projection is not None
    file_format, raw = read_raw(path)
    arrays = sorted({**raw.cell_data, **raw.quad_data, **raw.point_data})
    if name is None and (path.suffix.lower() in SIZE_FORMATS or file_format in SIZE_FORMATS):
        if len(arrays) > 1:
            raise MeshReadError(f"{len(arrays)} arrays, {', '.join(arrays)}; choose one with --size")
        name = next(iter(arrays), None)
    if name is None:
        found = assembled(path, file_format, raw, is_lonlat=is_lonlat, split_quads=True)
        sizes, points = size_field(found.mesh).h, found.mesh.points
        if found.projection is not None:
            sizes, points = sizes / found.projection.scale(points), found.projection.to_degrees(points)
    else:
        if name not in arrays:
            there = ", ".join(arrays) or "none"
            raise MeshReadError(f"no array {name!r} for --size; the file's arrays: {there}")
        found = assembled(path, file_format, raw, split_quads=True)
        values = {**found.cell_data, **found.point_data}[name]
        sizes, points = at_points(found.mesh, values, name), found.mesh.points
    triangles = found.mesh.triangles
    return _read_off(Background(points[triangles], sizes[triangles]), mesh_file)


def _places(mesh_file: MeshFile) -> Floats:
    """Return the points of a mesh in the coordinates of its file, degrees unbroken at the date line."""
    points, projection = mesh_file.mesh.points, mesh_file.projection
    return points if projection is None else projection.to_unbroken_degrees(points)


def _read_off(background: Background, mesh_file: MeshFile) -> Floats:
    where = _places(mesh_file)
    if mesh_file.projection is None:
        return background.at(where)
    check_degrees(background.corners[..., :2].reshape(-1, 2))
    return unrolled(background, where).at(where)


def check_degrees(places: Floats) -> None:
    """Raise InvalidSize where places, (n, 2), are beyond a full turn: in metres, not in degrees."""
    low, high = places.min(axis=0), places.max(axis=0)
    if (low < -FULL_TURN).any() or (high > FULL_TURN).any():
        x, y = (f"{a:.6g} .. {b:.6g}" for a, b in zip(low, high, strict=True))
        raise InvalidSize(
            f"places of x {x}, y {y} are no degrees; with --lonlat give sizes at longitudes and latitudes"
        )


def at_points(mesh: Mesh, values: Floats, name: str) -> Floats:
    """Return an array of a background as one value a point, (n_points,); logarithms of cells are averaged."""
    values = values[:, 0] if values.ndim == 2 and values.shape[1] == 1 else values
    if values.shape == (mesh.n_points,):
        return values
    if values.shape != (mesh.n_triangles,):
        raise InvalidSize(f"size {name!r} has shape {values.shape}; give a scalar a point or a triangle")
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.exp(to_vertices(mesh, np.log(np.where(values > 0, values, np.nan)))))


def unrolled(background: Background, where: Floats) -> Background:
    """Return a background in degrees with its longitudes about those of where, (n_points, 2), unbroken.

    Triangles across the date line are closed up: longitudes of one that differ by more than half a turn
    lie on its two sides.
    """
    corners = np.array(background.corners)
    centre = where[:, 0].mean()
    first = corners[:, :1, 0]
    first = first - FULL_TURN * np.round((first - centre) / FULL_TURN)
    corners[..., 0] -= FULL_TURN * np.round((corners[..., 0] - first) / FULL_TURN)
    return Background(corners, background.sizes)


def at_longitudes(grid: GridBackground, where: Floats) -> Floats:
    """Return the sizes of a grid in degrees at points, (n_points,), whatever turn their longitudes are on."""
    turns = np.round((where[:, 0] - (grid.x[0] + grid.x[-1]) / 2) / FULL_TURN)
    return grid.at(np.column_stack([where[:, 0] - FULL_TURN * turns, where[:, 1]]))
