"""The verb `read`: a path in, a MeshFile out, or one MeshReadError that says what to do."""

from __future__ import annotations

import logging
import os
from dataclasses import replace
from pathlib import Path

from ..arrays import Ints
from ..errors import BsgplanError, InvalidMesh, MeshReadError
from ..mesh.hanging import hanging_points
from .file import MeshFile, RawMesh, assemble
from .projection import project_raw
from .sniff import sniff
from .split import split


def read(path: str | os.PathLike[str], *, split_quads: bool = False) -> MeshFile:
    """Return the mesh of a file with its data and boundaries, in the file's own coordinates.

    Quads are measured apart, or split into triangles. Raises MeshReadError where the file cannot be read
    and InvalidMesh where its triangles are no mesh.
    """
    file_format, raw = read_raw(path)
    return assembled(path, file_format, raw, split_quads=split_quads)


def read_lonlat(path: str | os.PathLike[str], *, split_quads: bool = False) -> MeshFile:
    """Return the mesh of a file in degrees of longitude and latitude, projected to metres of a plane."""
    file_format, raw = read_raw(path)
    return assembled(path, file_format, raw, is_lonlat=True, split_quads=split_quads)


def assembled(
    path: str | os.PathLike[str],
    file_format: str,
    raw: RawMesh,
    *,
    is_lonlat: bool = False,
    split_quads: bool = False,
) -> MeshFile:
    """Return the MeshFile of what stands in a file, projected and with its quads split if asked.

    Warns of hanging nodes.
    """
    projection, points = None, raw.points
    try:
        if is_lonlat and (len(raw.triangles) or len(raw.quads)):
            raw, projection = project_raw(raw)
        if split_quads:
            raw = split(raw)
    except InvalidMesh as error:
        raise InvalidMesh(f"{os.fspath(path)}: {error}") from None
    mesh_file = assemble(os.fspath(path), file_format, raw, projection)
    own = points[mesh_file.kept_points]
    straight = own if projection is None else projection.unbroken(own[:, :2])  # edges are, in the file
    cracks = cracks_told(mesh_file.kept_points[hanging_points(straight, mesh_file.mesh.topology)])
    if cracks:
        logging.getLogger("bsgplan").warning("%s: %s", os.fspath(path), cracks)
        mesh_file = replace(mesh_file, notes=(*mesh_file.notes, cracks))
    return mesh_file if projection is None else replace(mesh_file, degrees=own[:, :2])


def cracks_told(hanging: Ints) -> str:
    """Return a sentence on hanging nodes, given by their places in the file; empty where there are none.

    >>> import numpy as np
    >>> cracks_told(np.array([4]))
    '1 hanging node (4, from 0) in the middle of an edge: the mesh is cracked there; make it conforming'
    """
    if not len(hanging):
        return ""
    named = ", ".join(map(str, hanging[:5].tolist())) + (", .." if len(hanging) > 5 else "")
    s = "" if len(hanging) == 1 else "s"
    where = "the mesh is cracked there; make it conforming"
    return f"{len(hanging)} hanging node{s} ({named}, from 0) in the middle of an edge: {where}"


def read_raw(path: str | os.PathLike[str]) -> tuple[str, RawMesh]:
    """Return the format of a file and what stands in it, before any clean-up."""
    path = Path(path)
    file_format = sniff(path)
    try:
        return file_format.name, file_format.read(path)
    except BsgplanError as error:
        raise MeshReadError(f"{path}: {error}") from None
    except OSError as error:
        raise MeshReadError(f"{path}: cannot be read ({error.strerror or error}); check the file") from None
    except MemoryError:
        raise MeshReadError(f"{path}: does not fit into memory; check the counts in its header") from None
