"""Writers of VTK files with every array of a mesh: one .vtu, or a .vtm with one .vtu a block beside it."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints
from ..atomic import naming, replacing
from ..errors import OutputError
from .file import MeshFile
from .vtk_cells import write_cells

PIECE = "block"
"""The cell array whose values tell the pieces apart."""


def write_arrays(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write the triangles with every array, one cell each, as .vtu or .vtk; raises OutputError."""
    _write(mesh_file, Path(path), np.arange(mesh_file.mesh.n_triangles))


def write_vtm(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write a .vtm and, in a folder of its name without suffix, a .vtu for each value of `block`.

    The folder is made whole and renamed before the .vtm appears; an older one of that name is replaced.
    Raises OutputError where the folder's name is taken by something else.
    """
    target = Path(path)
    block = mesh_file.cell_data.get(PIECE)
    if block is None:
        raise OutputError(f"{target}: the mesh has no cell array {PIECE!r}; write .vtu instead")
    order = np.argsort(block, kind="stable")
    values, starts = np.unique(block[order], return_index=True)
    with replacing(target) as temporary, _folder(target.with_suffix("")) as folder:
        width, lines = len(str(len(values))), []
        for k, own in enumerate(np.split(order, starts[1:])):
            name = f"{PIECE}_{k:0{width}d}.vtu"
            _write(mesh_file, folder / name, own)
            lines.append(f'    <DataSet index="{k}" name="{PIECE} {int(values[k])}" '
                         f'file="{target.stem}/{name}"/>\n')  # fmt: skip
        temporary.write_text(
            '<?xml version="1.0"?>\n<VTKFile type="vtkMultiBlockDataSet" version="1.0" '
            'byte_order="LittleEndian">\n  <vtkMultiBlockDataSet>\n'
            + "".join(lines)
            + "  </vtkMultiBlockDataSet>\n</VTKFile>\n",
            encoding="utf-8",
        )


@contextmanager
def _folder(target: Path) -> Iterator[Path]:
    """Give an empty folder beside the target that takes its place when the block ends, or is removed."""
    if target.exists() and (not target.is_dir() or any(p.suffix != ".vtu" for p in target.iterdir())):
        raise OutputError(f"{target}: stands where the pieces go and holds other things; give another name")
    with naming(target):
        made = Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=target.parent))
        try:
            yield made
            made.chmod(0o755)
            shutil.rmtree(target, ignore_errors=True)
            made.replace(target)
        finally:
            shutil.rmtree(made, ignore_errors=True)


def _write(mesh_file: MeshFile, path: Path, cells: Ints) -> None:
    mesh, projection = mesh_file.mesh, mesh_file.projection
    used, corners = np.unique(mesh.triangles[cells], return_inverse=True)
    points: Floats = mesh.points if projection is None else projection.to_unbroken_degrees(mesh.points)
    write_cells(
        path,
        points[used],
        (("triangle", corners.reshape(-1, 3)),),
        point_data={name: values[used] for name, values in mesh_file.point_data.items()},
        cell_data={name: [values[cells]] for name, values in mesh_file.cell_data.items()},
    )
