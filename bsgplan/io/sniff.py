"""Which format a file has: by its first bytes, and by its suffix only where they do not tell.

Suffixes collide: .msh is Gmsh, Ansys or JIGSAW, .mesh is Medit or MFEM, .node is two formats of Triangle.
"""

from __future__ import annotations

import re
from pathlib import Path

from ..errors import MeshReadError
from .byte_order_mark import MARK
from .formats import BY_NAME, BY_SUFFIX, Format

HEAD = 4096
"""Bytes looked at: every signature below stands in the first few lines."""

OTHER_FORMATS = {
    "polydata": ("VTK PolyData", "save it as an unstructured grid (.vtu) and give that"),
    "hdf5": ("HDF5", "convert it to .vtu with `meshio convert` and give that"),
}
"""Formats that are recognised but not read, what they are called, and the way round."""

SIGNATURES: tuple[tuple[bytes, str], ...] = (
    (rb"\s*\$NOD\b", "gmsh1"),
    (rb"\s*\$(MeshFormat|Comments)\b", "gmsh"),
    (rb"(\s*#[^\n]*\n)*\s*(?i:mshid)\s*=", "jigsaw"),
    (rb"MFEM (NC |NURBS |INLINE )?mesh", "mfem"),
    (rb"(\s*#[^\n]*\n)*\s*MeshVersionFormatted\b", "medit"),
    (rb"MESH2D\b", "2dm"),
    (rb"(\s*%[^\n]*\n|\s*\n)*\s*(NZONE|NDIME|NELEM|NPOIN|IZONE|NMARK)\s*=", "su2"),
    (rb"(\s*#[^\n]*\n)*\s*OFF\b", "off"),
    (rb"ply\r?\n", "ply"),
    (rb"# vtk DataFile", "vtk"),
    (rb"(\s*<\?xml[^>]*>)?(\s*<!--.*?-->)*\s*<VTKFile[^>]*type=[\"']UnstructuredGrid", "vtu"),
    (rb"(\s*<\?xml[^>]*>)?(\s*<!--.*?-->)*\s*<VTKFile", "polydata"),
    (rb"(\s*<\?xml[^>]*>)?(\s*<!.*?>)*\s*<Xdmf\b", "xdmf"),
    (rb"(\s*<\?xml[^>]*>)?(\s*<!--.*?-->)*\s*<dolfin\b", "dolfin"),
    (rb"CDF[\x01\x02\x05]", "netcdf"),
    (rb"\x89HDF\r\n\x1a\n", "hdf5"),
    (rb"\x00\x00\x00\x50.{80}\x00\x00\x00\x50|\x50\x00\x00\x00.{80}\x50\x00\x00\x00", "selafin"),
    (rb"(#[^\n]*\n|\s*\n)*(mesh3d|csg2d|csg3d)\b", "netgen"),
    (rb"\s*\(\s*[01]\s+\"", "ansys"),
)
"""Patterns at the start of a file and the format that each gives away, tried in this order."""
SPANNING = ("selafin", "vtu", "polydata", "dolfin", "xdmf")
"""Formats whose pattern has a dot that may run over a line's end."""
FORT14 = rb"[^\n]*\n[ \t]*\d+[ \t]+\d+\b[^\n]*\n[ \t]*\d+([ \t]+[-+]?[\d.]+([EeDd][-+]?\d+)?){3}"
"""A title, two counts, then a node: too weak a sign against a suffix that says otherwise."""

SUFFIXES = {".vtp": "polydata"}
"""Suffixes of formats that are recognised only, beside those of the registry."""

CONTAINERS = {"hdf5": ("med", "h5m", "cgns", "exodus", "netcdf"), "netcdf": ("exodus",)}
"""Formats that live inside another one: there the suffix decides."""


def sniff(path: Path) -> Format:
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
        called, remedy = OTHER_FORMATS[found]
        raise MeshReadError(f"{path}: {called} files are not read; {remedy}")
    return BY_NAME[found]


def format_of(head: bytes, name: str) -> str | None:
    r"""Return the format that the first bytes give away, else the one of the suffix, else None.

    >>> format_of(b"OFF\n3 1 0\n", "surface.msh")
    'off'
    """
    suffix = Path(name.lower()).suffix
    by_suffix = BY_SUFFIX[suffix].name if suffix in BY_SUFFIX else SUFFIXES.get(suffix)
    head = head.removeprefix(MARK)
    for pattern, found in SIGNATURES:
        if re.match(pattern, head, re.DOTALL if found in SPANNING else 0):
            return by_suffix if by_suffix in CONTAINERS.get(found, ()) else found
    return by_suffix or ("fort.14" if re.match(FORT14, head) else None)
