"""The registry of mesh file formats: what bsgplan reads and writes, and who does it.

A reader is a function `path -> RawMesh`, a writer a function `(mesh_file, path) -> None` that writes the file
whole or not at all. Both stand here by their import path and are imported when they are used, not before.
An import path into meshio means: through `through_meshio`, which keeps meshio quiet.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .file import MeshFile, RawMesh


@dataclass(frozen=True)
class Format:
    """A file format: its names, and where its reader and writer are."""

    name: str
    """What `sniff` calls it and `--format` takes: one lower-case word."""
    suffixes: tuple[str, ...]
    """Suffixes in lower case; the first format of the registry with a suffix is the one it means."""
    what: str
    """What it is, for a reader who never met it."""
    reader: str | None
    """Import path "module:function" of the reader; None where it is written only."""
    writer: str | None = None
    """Import path of the writer; None where it is read only."""
    extra: str | None = None
    """The package that reading or writing needs beyond bsgplan's own; None where it needs none."""
    keeps: str = ""
    """What beside points and triangles has a place in it."""

    def read(self, path: Path) -> RawMesh:
        """Return what the reader finds in a file; raises MeshReadError."""
        if self.reader is None:
            raise ValueError(f"{self.name} is not read")
        if self.reader.startswith("meshio."):
            from .through_meshio import read_through_meshio

            return read_through_meshio(path, self.reader.split(":")[0].removeprefix("meshio."))
        read: Callable[[Path], RawMesh] = _resolved(self.reader)
        return read(path)

    def write(self, mesh_file: MeshFile, path: Path) -> None:
        """Write a mesh file, whole or not at all; raises OutputError."""
        if self.writer is None:
            raise ValueError(f"{self.name} is not written")
        write: Callable[[MeshFile, Path], None] = _resolved(self.writer)
        write(mesh_file, path)


def _resolved(import_path: str) -> Any:
    module, function = import_path.split(":")
    return getattr(import_module(module, __package__), function)


_meshio = partial(Format, keeps="point and cell arrays")

FORMATS: tuple[Format, ...] = (
    Format("gmsh", (".msh",), "Gmsh, MSH 2.2 and 4.x, ASCII and binary", "meshio.gmsh:read"),
    Format(
        "fort.14",
        (".14", ".grd", ".gr3", ".ll"),
        "ADCIRC and SCHISM, text mesh (fort.14, hgrid.gr3)",
        ".fort14:read_fort14",
        ".fort14_write:write_fort14",
        keeps="title; point array depth; open and land boundaries",
    ),
    Format(
        "su2",
        (".su2",),
        "SU2, one zone or several",
        ".su2:read_su2",
        ".su2_write:write_su2",
        keeps="quads; markers with their names",
    ),
    Format(
        "mfem",
        (),
        "MFEM mesh, 1.0 to 1.3, conforming",
        ".mfem:read_mfem",
        ".mfem_write:write_mfem",
        keeps="quads; cell array attribute; boundaries with their names",
    ),
    Format(
        "selafin",
        (".slf", ".selafin", ".srf"),
        "TELEMAC Selafin (SERAFIN), plane",
        ".selafin:read_selafin",
        ".selafin_write:write_selafin",
        keeps="title; point arrays of one number; ipobo",
    ),
    Format(
        "netcdf",
        (".nc", ".nc4"),
        "UGRID netCDF; classic files need no package",
        ".ugrid:read_ugrid",
        ".ugrid_write:write_ugrid",
        extra="netCDF4",
        keeps="quads; point and cell arrays of one number; boundaries with their names",
    ),
    _meshio("medit", (".mesh", ".meshb"), "Medit, INRIA (mmg, FreeFEM)", "meshio.medit:read"),
    _meshio("vtk", (".vtk",), "VTK legacy, unstructured grid", "meshio.vtk:read"),
    _meshio("vtu", (".vtu",), "VTK XML, unstructured grid", "meshio.vtu:read"),
    _meshio("off", (".off",), "OFF, Object File Format", "meshio.off:read"),
    _meshio("obj", (".obj",), "Wavefront OBJ", "meshio.obj:read"),
    _meshio("stl", (".stl",), "STL, stereolithography", "meshio.stl:read"),
    _meshio("ply", (".ply",), "PLY, Stanford polygons", "meshio.ply:read"),
    _meshio("abaqus", (".inp",), "Abaqus input", "meshio.abaqus:read"),
    _meshio("ansys", (), "Ansys Fluent .msh", "meshio.ansys:read"),
    _meshio("avsucd", (".avs",), "AVS-UCD", "meshio.avsucd:read"),
    _meshio("nastran", (".bdf", ".nas", ".fem"), "Nastran bulk data", "meshio.nastran:read"),
    _meshio("tecplot", (".dat", ".tec"), "Tecplot ASCII", "meshio.tecplot:read"),
    _meshio("netgen", (".vol",), "Netgen volume mesh", "meshio.netgen:read"),
    _meshio("dolfin", (".xml",), "DOLFIN XML (FEniCS)", "meshio.dolfin:read"),
    _meshio("xdmf", (".xdmf", ".xmf"), "XDMF 3", "meshio.xdmf:read"),
    _meshio("mdpa", (".mdpa",), "Kratos", "meshio.mdpa:read"),
    _meshio("permas", (".post",), "PERMAS", "meshio.permas:read"),
    _meshio("flac3d", (".f3grid",), "FLAC3D", "meshio.flac3d:read"),
    _meshio("wkt", (".wkt",), "Well-known text, TIN", "meshio.wkt:read"),
    _meshio("ugrid", (".ugrid",), "AFLR3 UGRID", "meshio.ugrid:read"),
    _meshio("med", (".med",), "Salome MED", "meshio.med:read", extra="h5py"),
    _meshio("h5m", (".h5m",), "MOAB H5M", "meshio.h5m:read", extra="h5py"),
    _meshio("cgns", (".cgns",), "CGNS", "meshio.cgns:read", extra="h5py"),
    _meshio("exodus", (".e", ".exo", ".ex2"), "Exodus II", "meshio.exodus:read", extra="netCDF4"),
)
"""Every format that is read or written, ours first."""

BY_NAME = {found.name: found for found in FORMATS}
"""The same by name."""

BY_SUFFIX = {suffix: found for found in reversed(FORMATS) for suffix in found.suffixes}
"""What each suffix means where the content does not tell."""
