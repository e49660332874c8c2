"""The size field of a mesh file, to plan with or to lay out: its own edges, its array, or a size file."""

from __future__ import annotations

import logging
import os
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .arrays import Floats
from .errors import MeshReadError
from .io import MeshFile
from .io.isotropy import warn_of_stretched
from .io.size_file import sizes_from
from .mesh import Mesh
from .mesh.thinned import Thinned, thinned
from .sizing import SizeField, named_size_field, size_field
from .sizing.measure import triangles_wanted
from .sizing.thinned import thin_named_size_field, thin_size_field

LARGE = 200_000
"""A mesh of so many triangles is planned on a thinned one: there the compiled loop pays for its start."""

LEAST = 16
"""Triangles of the mesh in the smallest block from which that is done: three are left of them."""

UNLIKELY = 1000
"""Sizes that ask for so many times the triangles of their mesh are in another unit."""


def sizes_to_plan(
    mesh_file: MeshFile,
    name: str | None = None,
    size_file: str | os.PathLike[str] | None = None,
    *,
    tris_per_block: int | Sequence[int] = 16,
    n_blocks: int | None = None,
) -> tuple[SizeField, Thinned | None]:
    """Return the size field to plan with, as `size_of`, and the thinned mesh that it is on, or None.

    A plane mesh of LARGE triangles or more is thinned where the smallest block covers LEAST of them.
    """
    mesh, given = mesh_file.mesh, given_sizes(mesh_file, name, size_file)
    if mesh.is_planar and mesh.n_triangles >= LARGE:
        wanted = mesh.n_triangles if given is None else given.n_triangles
        least = np.min(tris_per_block) if n_blocks is None else wanted / n_blocks
        if least * mesh.n_triangles / wanted >= LEAST:
            thin = thinned(mesh)
            if given is None:
                return thin_size_field(thin), thin
            return thin_named_size_field(thin, given.values, given.source), thin
    return _on_every_triangle(mesh, given), None


def size_of(
    mesh_file: MeshFile, name: str | None = None, size_file: str | os.PathLike[str] | None = None
) -> SizeField:
    """Return the size field of a mesh file on every triangle; sizes and errors are those of `given_sizes`."""
    return _on_every_triangle(mesh_file.mesh, given_sizes(mesh_file, name, size_file))


def _on_every_triangle(mesh: Mesh, given: Given | None) -> SizeField:
    return size_field(mesh) if given is None else named_size_field(mesh, given.values, given.source)


class Given(NamedTuple):
    """Sizes that are given, not read off the edges."""

    values: Floats
    """One length a point or a triangle, on the map where the mesh has one."""
    source: str
    """The array or file that they come from."""
    n_triangles: float
    """Triangles that they ask for."""


def given_sizes(
    mesh_file: MeshFile, name: str | None, size_file: str | os.PathLike[str] | None
) -> Given | None:
    """Return the sizes of a mesh file's array of that name, or of a size file.

    Those of a projected mesh are true metres. None where the mesh's own edges are the size. Warns where many
    triangles are stretched then, else where the unit of the sizes is unlikely. Raises MeshReadError where
    there is no such array, and what `sizes_from` raises.
    """
    if size_file is not None:
        source = os.fspath(size_file) + ("" if name is None else f": {name}")
        values = sizes_from(size_file, mesh_file, name=name)
    elif name is not None:
        source, values = name, _array(mesh_file, name)
    else:
        warn_of_stretched(mesh_file)
        return None
    given = Given(values, source, triangles_wanted(mesh_file.mesh, values, source))
    _warn_of_unit(mesh_file, given)
    return given


def _array(mesh_file: MeshFile, name: str) -> Floats:
    """Return the sizes in an array of a mesh file, one a point or a triangle, on the map where it has one."""
    mesh = mesh_file.mesh
    arrays = {**mesh_file.cell_data, **mesh_file.point_data}
    if name not in arrays:
        there = ", ".join(sorted(arrays)) or "none"
        raise MeshReadError(f"{mesh_file.path}: no array {name!r} for --size; the file's arrays: {there}")
    values = np.asarray(arrays[name], dtype=np.float64)
    if mesh_file.projection is not None and values.shape in {(mesh.n_points,), (mesh.n_triangles,)}:
        where = mesh.points if name in mesh_file.point_data else mesh.centroids
        values = values * mesh_file.projection.scale(where)
    return values


def _warn_of_unit(mesh_file: MeshFile, given: Given) -> None:
    """Warn where sizes ask for less than a triangle, or for a thousand times those of the mesh."""
    n_triangles = mesh_file.mesh.n_triangles
    if not 1 <= given.n_triangles <= UNLIKELY * n_triangles:
        logging.getLogger("bsgplan").warning(
            "%s: the sizes %r ask for %.3g triangles where the mesh has %d; check their unit",
            mesh_file.path, given.source, given.n_triangles, n_triangles,
        )  # fmt: skip
