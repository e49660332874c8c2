"""Files: `read` makes a MeshFile, whatever the format; `write` gives it back in any of them."""

from .boundary import Boundary
from .file import MeshFile
from .fort14_write import write_fort14
from .projection import Projection, looks_like_degrees, project
from .read import read, read_lonlat
from .write import write

__all__ = [
    "Boundary",
    "MeshFile",
    "Projection",
    "looks_like_degrees",
    "project",
    "read",
    "read_lonlat",
    "write",
    "write_fort14",
]
