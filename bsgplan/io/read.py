"""The verb `read`: a path in, a MeshFile out, or one MeshReadError that says what to do."""

from __future__ import annotations

import os
from pathlib import Path

from ..errors import BsgplanError, InvalidMesh, MeshReadError
from .file import MeshFile, RawMesh, assemble
from .projection import project_raw
from .sniff import sniff


def read(path: str | os.PathLike[str]) -> MeshFile:
    """Return the mesh of a file with its data and boundaries, in the file's own coordinates.

    Raises MeshReadError where the file cannot be read and InvalidMesh where its triangles are no mesh.
    """
    file_format, raw = _raw(Path(path))
    return assemble(os.fspath(path), file_format, raw)


def read_lonlat(path: str | os.PathLike[str]) -> MeshFile:
    """Return the mesh of a file in degrees of longitude and latitude, projected to metres of a plane."""
    file_format, raw = _raw(Path(path))
    if not len(raw.triangles):
        return assemble(os.fspath(path), file_format, raw)  # raises, and says what there is
    try:
        planar, projection = project_raw(raw)
    except InvalidMesh as error:
        raise InvalidMesh(f"{os.fspath(path)}: {error}") from None
    return assemble(os.fspath(path), file_format, planar, projection)


def _raw(path: Path) -> tuple[str, RawMesh]:
    file_format = sniff(path)
    try:
        return file_format.name, file_format.read(path)
    except BsgplanError as error:
        raise MeshReadError(f"{path}: {error}") from None
    except OSError as error:
        raise MeshReadError(f"{path}: cannot be read ({error.strerror or error}); check the file") from None
    except MemoryError:
        raise MeshReadError(f"{path}: does not fit into memory; check the counts in its header") from None
