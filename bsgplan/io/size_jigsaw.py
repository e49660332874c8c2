"""Reader of the size grids of JIGSAW (hfun, .msh with MSHID=..;EUCLIDEAN-GRID or ELLIPSOID-GRID).

Grammar, # begins a comment line:

    MSHID=3;EUCLIDEAN-GRID
    NDIMS=2
    RADII=a;b;c                  of an ellipsoid
    COORD=1;n_x                  then n_x lines, one coordinate each
    COORD=2;n_y
    VALUE=n;1                    n = n_x n_y lines; y runs fastest, from x to x

On an ellipsoid the coordinates are longitude and latitude in radians, sizes in the unit of RADII.
"""

from __future__ import annotations

import re
import warnings
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import MeshReadError
from ..sizing.grid import GridBackground

SECTION = re.compile(r"^[ \t]*([A-Za-z]\w*)[ \t]*=[ \t]*([^\n]*?)[ \t\r]*$", re.MULTILINE)
EARTH_RADIUS = 6371008.8
"""Mean radius of the Earth, metres (IUGG)."""
METRES = {1.0: (6.3e6, 6.4e6), 1e3: (6.3e3, 6.4e3)}
"""Metres in the unit of RADII, by the range of the Earth's radius in that unit."""


def read_grid(path: Path, *, is_lonlat: bool) -> GridBackground:
    """Return the sizes of a grid file; is_lonlat where the mesh is in degrees, and the answer then too."""
    text = re.sub(r"^[ \t]*#[^\n]*", "", path.read_text(encoding="utf-8", errors="replace"), flags=re.M)
    words = SECTION.split(text)
    axes: dict[str, Floats] = {}
    kind, values, radii = "", np.empty(0), np.ones(1)
    for key, given, body in zip(*(words[k::3] for k in (1, 2, 3)), strict=True):
        parts = [part.strip() for part in given.split(";")]
        if key.upper() == "MSHID":
            kind = parts[-1].lower()
        elif key.upper() == "RADII":
            radii = _numbers(given, "RADII")
        elif key.upper() == "COORD":
            axes[parts[0]] = _rows(parts[-1], body, f"COORD={parts[0]}")
        elif key.upper() == "VALUE":
            if parts[1:] != ["1"]:
                raise MeshReadError(f"VALUE={given}, several values a node; give one size each")
            values = _rows(parts[0], body, "VALUE")
    if set(axes) != {"1", "2"}:
        raise MeshReadError(f"coordinates {', '.join(axes) or 'none'}; give a grid of x and y")
    x, y = axes["1"], axes["2"]
    if len(values) != len(x) * len(y):
        raise MeshReadError(f"{len(values)} values for {len(x)} x {len(y)} crossings; repair the file")
    if kind == "ellipsoid-grid":
        if not is_lonlat:
            raise MeshReadError("a grid of longitudes and latitudes; plan the mesh in degrees, with --lonlat")
        x, y, values = np.degrees(x), np.degrees(y), values * metres(float(radii.mean()))
    return GridBackground(x, y, values.reshape(len(x), len(y)).T)


def metres(radius: float) -> float:
    """Return the metres in the unit of an Earth's radius: 1 or 1000, else by the mean radius.

    >>> metres(6371.0), metres(1.0)
    (1000.0, 6371008.8)
    """
    return next((unit for unit, (low, high) in METRES.items() if low < radius < high), EARTH_RADIUS / radius)


def _rows(count: str, body: str, what: str) -> Floats:
    numbers = _numbers(body, what)
    if count != str(len(numbers)):
        raise MeshReadError(f"{what} announces {count} numbers, {len(numbers)} follow; repair the file")
    return numbers


def _numbers(text: str, what: str) -> Floats:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return np.asarray(np.fromstring(text.replace(";", " "), sep=" "))
        except (DeprecationWarning, ValueError):
            raise MeshReadError(f"{what} holds something that is no number; repair the file") from None
