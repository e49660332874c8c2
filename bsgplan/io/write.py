"""The verb `write`: a mesh file to a path, in the format of its suffix or the one that is named."""

from __future__ import annotations

import os
from pathlib import Path

from ..errors import InvalidOption
from .file import MeshFile
from .formats import BY_NAME, BY_SUFFIX, FORMATS, Format


def write(mesh_file: MeshFile, path: str | os.PathLike[str], *, format: str | None = None) -> None:
    """Write a mesh with its data and boundaries; what the format has no place for is named in a warning.

    The file appears whole or not at all. Raises InvalidOption for a format that is not written and
    OutputError where the mesh or the file cannot be.
    """
    writable(path, format).write(mesh_file, Path(path))


def writable(path: str | os.PathLike[str], name: str | None = None) -> Format:
    """Return the format of this name, else of the path's suffix; raise InvalidOption for no such."""
    suffix = Path(path).suffix.lower()
    found = BY_SUFFIX.get(suffix) if name is None else BY_NAME.get(name)
    if found is not None and found.writer is not None:
        return found
    names = ", ".join(other.name for other in FORMATS if other.writer is not None)
    if name is not None:
        raise InvalidOption(f"format {name!r} is not written; choose one of {names}")
    what = f"suffix {suffix!r}" if found is None else f"{found.name} files"
    verb = "is no format that is written" if found is None else "are not written"
    raise InvalidOption(f"{os.fspath(path)}: {what} {verb}; give a --format of {names}")


def n_boundaries_written(mesh_file: MeshFile, found: Format) -> int:
    """Return how many boundaries of a mesh file have a place in a format; the others a warning has named."""
    if found.name == "triangle" and "marker" in mesh_file.point_data:  # its column is taken by the array
        return 0
    return sum(boundary.kind in found.boundaries for boundary in mesh_file.boundaries)
