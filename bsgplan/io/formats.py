"""The registry of mesh file formats: what bsgplan reads and writes, and who does it.

A reader is a function `path -> RawMesh`, a writer a function `(mesh_file, path) -> None` that writes the file
whole or not at all. Both stand here by their import path and are imported when they are used, not before.
An import path into meshio means: through `through_meshio`, which keeps meshio quiet.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .file import MeshFile, RawMesh

EVERY_KIND = ("open", "land", "named")
"""The kinds of boundaries."""


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
    boundaries: tuple[str, ...] = ()
    """The kinds of boundaries that are written; others are lost, with a warning."""

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
        if self.writer.startswith("meshio."):
            from .through_meshio_write import write_through_meshio

            write_through_meshio(mesh_file, path, self.writer.split(":")[0].removeprefix("meshio."))
            return
        write: Callable[[MeshFile, Path], None] = _resolved(self.writer)
        write(mesh_file, path)


def _resolved(import_path: str) -> Any:
    module, function = import_path.split(":")
    return getattr(import_module(module, __package__), function)


def _meshio(name: str, suffixes: tuple[str, ...], what: str, *, writes: bool = False, **more: Any) -> Format:
    writer = f"meshio.{name}:write" if writes else None
    return Format(name, suffixes, what, f"meshio.{name}:read", writer, **more)


FORMATS: tuple[Format, ...] = (
    Format(
        "gmsh",
        (".msh",),
        "Gmsh, MSH 2.2 and 4.x, text and binary; written as 2.2 in text",
        "meshio.gmsh:read",
        ".gmsh_write:write_msh22",
        keeps=(gmsh_keeps := "arrays of 1, 3 or 9 components; boundaries and regions with names"),
        boundaries=EVERY_KIND,
    ),
    Format(
        "gmsh41",
        (),
        "Gmsh, MSH 4.1 in text",
        None,
        ".gmsh_write:write_msh41",
        keeps=gmsh_keeps,
        boundaries=EVERY_KIND,
    ),
    Format(
        "fort.14",
        (".14", ".grd", ".gr3", ".ll"),
        "ADCIRC and SCHISM, text mesh (fort.14, hgrid.gr3)",
        ".fort14:read_fort14",
        ".fort14_write:write_fort14",
        keeps="title; point array depth; open and land boundaries",
        boundaries=("open", "land"),
    ),
    Format(
        "2dm",
        (".2dm",),
        "SMS two-dimensional mesh, triangles and quads",
        ".sms:read_2dm",
        ".sms_write:write_2dm",
        keeps="point array depth; cell array material with names; nodestrings",
        boundaries=EVERY_KIND,
    ),
    Format(
        "triangle",
        (".node", ".ele"),
        "Triangle, points in .node and triangles in .ele",
        ".triangle:read_triangle",
        ".triangle:write_triangle",
        keeps="scalar arrays without names; point array marker",
        boundaries=EVERY_KIND,
    ),
    Format(
        "jigsaw",
        (),
        "JIGSAW .msh, mesh of the plane, in space or on an ellipsoid",
        ".jigsaw:read_jigsaw",
        ".jigsaw:write_jigsaw",
        keeps="point arrays value, slope, power; regions and boundaries by number",
        boundaries=EVERY_KIND,
    ),
    Format(
        "gmsh1",
        (),
        "Gmsh, MSH 1.0",
        ".gmsh1:read_gmsh1",
        keeps="boundaries and regions by number",
    ),
    Format(
        "su2",
        (".su2",),
        "SU2, one zone or several",
        ".su2:read_su2",
        ".su2_write:write_su2",
        keeps="quads; markers with their names",
        boundaries=EVERY_KIND,
    ),
    Format(
        "mfem",
        (),
        "MFEM mesh, 1.0 to 1.3, conforming",
        ".mfem:read_mfem",
        ".mfem_write:write_mfem",
        keeps="quads; regions by number; boundaries with their names",
        boundaries=EVERY_KIND,
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
        boundaries=EVERY_KIND,
    ),
    _meshio(
        "medit",
        (".mesh", ".meshb"),
        "Medit, INRIA (mmg, FreeFEM)",
        writes=True,
        keeps="regions and boundaries by number",
        boundaries=EVERY_KIND,
    ),
    _meshio("vtk", (".vtk",), "VTK legacy, unstructured grid", writes=True, keeps="point and cell arrays"),
    _meshio("vtu", (".vtu",), "VTK XML, unstructured grid", writes=True, keeps="point and cell arrays"),
    _meshio("off", (".off",), "OFF, Object File Format", writes=True),
    _meshio("obj", (".obj",), "Wavefront OBJ", writes=True),
    _meshio("stl", (".stl",), "STL, stereolithography"),
    _meshio("ply", (".ply",), "PLY, Stanford polygons", writes=True, keeps="scalar point arrays"),
    _meshio("abaqus", (".inp",), "Abaqus input", writes=True),
    _meshio("ansys", (), "Ansys Fluent .msh", writes=True),
    _meshio("avsucd", (".avs",), "AVS-UCD", writes=True, keeps="point and cell arrays"),
    _meshio("nastran", (".bdf", ".nas", ".fem"), "Nastran bulk data"),
    _meshio("tecplot", (".dat", ".tec"), "Tecplot ASCII", writes=True, keeps="scalar point and cell arrays"),
    _meshio("netgen", (".vol",), "Netgen volume mesh", writes=True, keeps="regions by number"),
    _meshio("dolfin", (".xml",), "DOLFIN XML (FEniCS)", writes=True),
    _meshio("xdmf", (".xdmf", ".xmf"), "XDMF 3", writes=True, extra="h5py", keeps="point and cell arrays"),
    _meshio("mdpa", (".mdpa",), "Kratos", writes=True),
    _meshio("permas", (".post",), "PERMAS", writes=True),
    _meshio("flac3d", (".f3grid",), "FLAC3D"),
    _meshio("wkt", (".wkt",), "Well-known text, TIN"),
    _meshio("ugrid", (".ugrid",), "AFLR3 UGRID"),
    _meshio("med", (".med",), "Salome MED", extra="h5py"),
    _meshio("h5m", (".h5m",), "MOAB H5M", extra="h5py"),
    _meshio("cgns", (".cgns",), "CGNS", extra="h5py"),
    _meshio(
        "exodus", (".e", ".exo", ".ex2"), "Exodus II", writes=True, extra="netCDF4", keeps="point arrays"
    ),
)
"""Every format that is read or written, ours first."""

BY_NAME = {found.name: found for found in FORMATS}
"""The same by name."""

BY_SUFFIX = {suffix: found for found in reversed(FORMATS) for suffix in found.suffixes}
"""What each suffix means where the content does not tell."""
