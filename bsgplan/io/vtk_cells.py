"""Cells and their arrays written as VTK files, binary and compressed, through meshio."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints
from ..atomic import replacing
from ..errors import InvalidOption

FORMATS = {".vtu": "vtu", ".vtk": "vtk"}
"""Suffixes that are written, and what meshio calls them."""

EMPTY_FORMATS = {"vtu": "vtu", "vtk": "vtk42"}
"""The same for a file without cells: meshio cannot write an empty legacy file of version 5."""


def check_suffix(path: str | os.PathLike[str]) -> str:
    """Return what meshio calls the format of this suffix; raise InvalidOption for an unknown one."""
    suffix = Path(path).suffix
    if suffix.lower() not in FORMATS:
        raise InvalidOption(
            f"{os.fspath(path)}: suffix {suffix!r} is no VTK format; write {' or '.join(FORMATS)}"
        )
    return FORMATS[suffix.lower()]


def write_cells(
    path: str | os.PathLike[str],
    points: Floats,
    cells: tuple[tuple[str, Ints], ...],
    *,
    point_data: dict[str, Floats],
    cell_data: dict[str, list[Ints | Floats]],
) -> None:
    """Write cells by type with their arrays, binary and compressed; nothing is left of a failed write."""
    import meshio

    file_format = check_suffix(path) if len(points) else EMPTY_FORMATS[check_suffix(path)]
    kept = [k for k, (_, corners) in enumerate(cells) if len(corners)] or [0]
    flat = np.zeros((len(points), 3 - points.shape[1]))
    mesh = meshio.Mesh(
        np.column_stack([points, flat]),
        [cells[k] for k in kept],
        point_data=point_data,
        cell_data={name: [blocks[k] for k in kept] for name, blocks in cell_data.items()},
    )
    with replacing(path) as temporary:
        meshio.write(temporary, mesh, file_format=file_format, binary=True)
