"""Which format a file has: by its first bytes, and by its suffix only where they do not tell.

Suffixes collide: .msh is Gmsh, Ansys or JIGSAW, .mesh is Medit or MFEM, .node is two formats of Triangle.
"""

from __future__ import annotations

import re
from pathlib import Path

from ..errors import MeshReadError

HEAD = 4096
"""Bytes looked at: every signature below stands in the first few lines."""

OTHER_FORMATS = {
    "Gmsh 1.0": "open it in Gmsh and save it as MSH 2.2 or 4.1",
    "JIGSAW": "save it as .vtk from JIGSAW (savevtk) and give that",
    "MFEM": "save it as VTK from MFEM (mesh.PrintVTK) and give that",
    "SMS 2dm": "export it as fort.14 (or .gr3) from SMS or QGIS and give that",
    "Triangle .node/.ele": "convert it to .off or .vtk and give that",
    "netCDF": "convert it to .vtu with meshio or xugrid and give that",
    "Selafin": "convert it to .vtk (TELEMAC run_telfile.py, or BlueKenue as .2dm) and give that",
    "VTK PolyData": "save it as an unstructured grid (.vtu) and give that",
    "HDF5": "convert it to .vtu with `meshio convert` and give that",
}
"""Formats that are recognised but not read yet, and the way round."""

SIGNATURES: tuple[tuple[bytes, str], ...] = (
    (rb"\s*\$NOD\b", "Gmsh 1.0"),
    (rb"\s*\$(MeshFormat|Comments)\b", "gmsh"),
    (rb"(\s*#[^\n]*\n)*\s*mshid\s*=", "JIGSAW"),
    (rb"MFEM (NC |NURBS )?mesh", "MFEM"),
    (rb"(\s*#[^\n]*\n)*\s*MeshVersionFormatted\b", "medit"),
    (rb"MESH2D\b", "SMS 2dm"),
    (rb"(\s*%[^\n]*\n|\s*\n)*\s*(NZONE|NDIME|NELEM|NPOIN|IZONE|NMARK)\s*=", "su2"),
    (rb"(\s*#[^\n]*\n)*\s*OFF\b", "off"),
    (rb"ply\r?\n", "ply"),
    (rb"# vtk DataFile", "vtk"),
    (rb"(\s*<\?xml[^>]*>)?(\s*<!--.*?-->)*\s*<VTKFile[^>]*type=[\"']UnstructuredGrid", "vtu"),
    (rb"(\s*<\?xml[^>]*>)?(\s*<!--.*?-->)*\s*<VTKFile", "VTK PolyData"),
    (rb"(\s*<\?xml[^>]*>)?(\s*<!.*?>)*\s*<Xdmf\b", "xdmf"),
    (rb"(\s*<\?xml[^>]*>)?(\s*<!--.*?-->)*\s*<dolfin\b", "dolfin"),
    (rb"CDF[\x01\x02\x05]", "netCDF"),
    (rb"\x89HDF\r\n\x1a\n", "HDF5"),
    (rb"\x00\x00\x00\x50.{80}\x00\x00\x00\x50", "Selafin"),
    (rb"(#[^\n]*\n|\s*\n)*(mesh3d|csg2d|csg3d)\b", "netgen"),
    (rb"\s*\(\s*[01]\s+\"", "ansys"),
)
"""Patterns at the start of a file and the format that each gives away, tried in this order."""
SPANNING = ("Selafin", "vtu", "VTK PolyData", "dolfin", "xdmf")
"""Formats whose pattern has a dot that may run over a line's end."""
FORT14 = rb"[^\n]*\n[ \t]*\d+[ \t]+\d+\b[^\n]*\n[ \t]*\d+([ \t]+[-+]?[\d.]+([EeDd][-+]?\d+)?){3}"
"""A title, two counts, then a node: too weak a sign against a suffix that says otherwise."""

SUFFIXES = {
    ".msh": "gmsh", ".14": "fort.14", ".grd": "fort.14", ".gr3": "fort.14", ".ll": "fort.14",
    ".su2": "su2", ".mesh": "medit", ".meshb": "medit", ".vtk": "vtk", ".vtu": "vtu", ".off": "off",
    ".obj": "obj", ".stl": "stl", ".ply": "ply", ".inp": "abaqus", ".avs": "avsucd", ".bdf": "nastran",
    ".nas": "nastran", ".fem": "nastran", ".dat": "tecplot", ".tec": "tecplot", ".vol": "netgen",
    ".xml": "dolfin", ".xdmf": "xdmf", ".xmf": "xdmf", ".mdpa": "mdpa", ".post": "permas",
    ".f3grid": "flac3d", ".wkt": "wkt", ".med": "med", ".h5m": "h5m", ".cgns": "cgns",
    ".e": "exodus", ".exo": "exodus", ".ex2": "exodus", ".ugrid": "ugrid", ".2dm": "SMS 2dm",
    ".node": "Triangle .node/.ele", ".ele": "Triangle .node/.ele", ".nc": "netCDF",
    ".slf": "Selafin", ".vtp": "VTK PolyData",
}  # fmt: skip
"""Format by suffix, for files whose first bytes do not tell."""

CONTAINERS = {"HDF5": ("med", "h5m", "cgns", "exodus", "netCDF"), "netCDF": ("exodus",)}
"""Formats that live inside another one: there the suffix decides."""


def sniff(path: Path) -> str:
    """Return the format of a file that can be read; raise MeshReadError where it cannot."""
    try:
        with path.open("rb") as stream:
            head = stream.read(HEAD)
    except FileNotFoundError:
        raise MeshReadError(f"{path}: no such file; check the path") from None
    except IsADirectoryError:
        raise MeshReadError(f"{path}: is a directory; give a mesh file") from None
    except OSError as error:
        raise MeshReadError(
            f"{path}: cannot be read ({error.strerror or error}); check its permissions"
        ) from None
    except ValueError as error:  # a null byte in the name
        raise MeshReadError(f"{path!r}: not a file name ({error})") from None
    if not head.strip():
        raise MeshReadError(f"{path}: the file is empty; give a mesh file")
    found = format_of(head, path.name)
    if found is None:
        raise MeshReadError(
            f"{path}: format not recognised, neither by content nor by suffix; "
            "convert it to Gmsh, VTK or fort.14"
        )
    if found in OTHER_FORMATS:
        raise MeshReadError(f"{path}: {found} files are not read yet; {OTHER_FORMATS[found]}")
    return found


def format_of(head: bytes, name: str) -> str | None:
    r"""Return the format that the first bytes give away, else the one of the suffix, else None.

    >>> format_of(b"OFF\n3 1 0\n", "surface.msh")
    'off'
    """
    by_suffix = SUFFIXES.get(Path(name.lower()).suffix)
    head = head.removeprefix(b"\xef\xbb\xbf")
    for pattern, found in SIGNATURES:
        if re.match(pattern, head, re.DOTALL if found in SPANNING else 0):
            return by_suffix if by_suffix in CONTAINERS.get(found, ()) else found
    return by_suffix or ("fort.14" if re.match(FORT14, head) else None)
