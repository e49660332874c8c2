"""The formats that are written by meshio, made quiet: whole or not at all, every loss told."""

from __future__ import annotations

import importlib
import os
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Floats
from ..atomic import replacing
from ..errors import BsgplanError, OutputError
from ..words import counted
from .boundary import labels
from .file import MeshFile
from .hush import hushed
from .through_meshio import reason
from .whole import cell_regions, warn_of_losses, whole_mesh

POINT_ARRAYS = ("vtk", "vtu", "ply", "tecplot", "xdmf", "avsucd", "exodus")
"""Formats in which arrays at the points of any name have a place."""
CELL_ARRAYS = ("vtk", "vtu", "tecplot", "xdmf", "avsucd")
"""Formats in which arrays at the cells of any name have a place."""
REGIONS = {"medit": "medit:ref", "netgen": "netgen:index"}
"""Formats that know one whole number at each cell, and what meshio calls it."""
SCALARS_ONLY = ("ply", "tecplot")
"""Formats whose arrays have one number at a point or cell."""
TRIANGLES_ONLY = ("off", "tecplot", "avsucd", "dolfin")
"""Formats in which meshio loses or spoils quads that stand beside triangles."""
PLANAR = ("medit", "tecplot", "dolfin", "xdmf")
"""Formats that have two coordinates where the mesh is planar; others get a third one, 0."""
OPTIONS: dict[str, dict[str, Any]] = {"xdmf": {"data_format": "XML"}}
"""What a writer needs to be told: numbers inside the .xdmf, not in an HDF5 file beside it."""


def write_through_meshio(mesh_file: MeshFile, path: str | os.PathLike[str], file_format: str) -> None:
    """Write triangles, quads and the arrays that have a place through meshio's writer of a format.

    Medit gets the boundaries as edges with a number. What has no place is named in a warning. The file
    appears whole or not at all; raises OutputError where it cannot be written.
    """
    if file_format in TRIANGLES_ONLY and len(mesh_file.quads):
        raise OutputError(
            f"{Path(path)}: the mesh has {len(mesh_file.quads)} quads, {file_format} takes triangles alone; "
            "write .vtu, or split them with --split-quads"
        )
    mesh = _mesh(mesh_file, path, file_format)
    with replacing(path) as temporary, hushed():
        try:
            module = importlib.import_module(f"meshio.{file_format}")
            module.write(str(temporary), mesh, **OPTIONS.get(file_format, {}))
        except BsgplanError:
            raise
        except ModuleNotFoundError as error:
            raise OutputError(
                f"{Path(path)}: {file_format} files need the package {error.name}; pip install {error.name}"
            ) from None
        except (Exception, SystemExit) as error:  # writers raise anything, and exit
            if isinstance(error, OSError) and error.errno is not None:  # no fault of the format
                raise
            raise OutputError(
                f"{Path(path)}: cannot be written as {file_format} ({reason(error)}); write .vtu instead"
            ) from None


def _mesh(mesh_file: MeshFile, path: str | os.PathLike[str], file_format: str) -> Any:
    import meshio

    whole, regions = whole_mesh(mesh_file), cell_regions(mesh_file)
    n_quads = len(whole.quads)
    is_scalar = file_format in SCALARS_ONLY
    point_data = _placed(whole.point_data, file_format in POINT_ARRAYS, is_scalar)
    cell_arrays = _placed(mesh_file.cell_data, file_format in CELL_ARRAYS, is_scalar)
    region_array = REGIONS.get(file_format)
    has_regions = region_array is not None and regions.array is not None
    has_lines = file_format == "medit"
    n_named = len(mesh_file.boundaries) if has_lines else 0
    warn_of_losses(
        path,
        mesh_file,
        point_data=tuple(point_data),
        cell_data=(str(regions.array),) if has_regions else tuple(cell_arrays),
        boundaries=("open", "land", "named") if has_lines else (),
        also=[f"the names of {counted(n_named, 'boundary', 'boundaries')}"] * bool(n_named),
    )
    blocks = [("triangle", whole.triangles)]
    data: dict[str, list[Any]] = {name: [values] for name, values in cell_arrays.items()}
    if region_array is not None:
        data[region_array] = [regions.ids]
    if n_quads:
        blocks.append(("quad", whole.quads))
        for name, values in data.items():
            shape = (n_quads, *np.shape(values[0])[1:])
            values.append(np.ones(shape, dtype=np.int64) if name == region_array else np.full(shape, np.nan))
    if has_lines:
        for boundary, (tag, _) in zip(whole.boundaries, labels(whole.boundaries), strict=True):
            if len(boundary.segments):
                blocks.append(("line", boundary.segments))
                data[str(region_array)].append(np.full(len(boundary.segments), tag))
    points = whole.points if file_format in PLANAR else whole.spatial_points
    return meshio.Mesh(points, blocks, point_data=point_data, cell_data=data)


def _placed(arrays: dict[str, Floats], has_place: bool, is_scalar: bool) -> dict[str, Floats]:
    return {name: v for name, v in arrays.items() if has_place and (v.ndim == 1 or not is_scalar)}
