"""Files beside a mesh that name its points by number: of no use where the points are numbered anew."""

from __future__ import annotations

import logging
import os
from pathlib import Path

from .file import MeshFile

log = logging.getLogger("bsgplan")

ADCIRC_NUMBERS = ("13", "15", "19", "20", "22", "23", "24", "25", "67", "68", "88")
"""Inputs of ADCIRC that name or list points: attributes, tides and stations, forcing, hot starts."""
SCHISM_FILES = ("*.gr3", "*.ll", "*.prop", "*.ic", "*.th", "bctides.in", "vgrid.in", "hotstart.nc")
"""Inputs of SCHISM that have a value at each point or element, or name points."""
SAME_STEM = {"triangle": (".poly", ".edge", ".neigh", ".part"), "2dm": (".dat", ".bc", ".bcs", ".sol")}
"""Suffixes of the files that lie beside a mesh of these formats under its name."""
FORT14, SCHISM_SUFFIXES = "fort.14", (".gr3", ".ll")


def companions(path: str | os.PathLike[str], file_format: str) -> tuple[str, ...]:
    """Return the names of the files beside a mesh that refer to its points or elements by number, sorted."""
    mesh = Path(path)
    if file_format == FORT14 and mesh.suffix.lower() in SCHISM_SUFFIXES:
        found = {other for pattern in SCHISM_FILES for other in mesh.parent.glob(pattern)}
    elif file_format == FORT14:
        found = {mesh.with_suffix(f".{number}") for number in ADCIRC_NUMBERS}
    else:
        found = {mesh.with_suffix(suffix) for suffix in SAME_STEM.get(file_format, ())}
    return tuple(sorted(other.name for other in found if other.name != mesh.name and other.is_file()))


def warn_of_companions(mesh_file: MeshFile, out: str | os.PathLike[str]) -> None:
    """Warn of the companions of a mesh file that do not fit what is written of it, because of new numbers."""
    if not mesh_file.is_renumbered:
        return
    written = Path(out)
    names = [
        name
        for name in companions(mesh_file.path, mesh_file.format)
        if Path(mesh_file.path).with_name(name).resolve() != written.resolve()
    ]
    if names:
        log.warning(
            "%s: its points are numbered anew, so %s beside %s no longer fit%s it; make new ones",
            os.fspath(out), ", ".join(names), mesh_file.path, "s" if len(names) == 1 else "",
        )  # fmt: skip
