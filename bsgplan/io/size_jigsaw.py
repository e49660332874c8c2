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

from itertools import count
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import MeshReadError
from ..sizing.grid import GridBackground
from .number_table import shown
from .rows import all_numbers
from .text_records import TextRecords

MOST_SECTIONS = 100
"""Sections of a file: a grid has six or seven."""
EARTH_RADIUS = 6371008.8
"""Mean radius of the Earth, metres (IUGG)."""
METRES = {1.0: (6.3e6, 6.4e6), 1e3: (6.3e3, 6.4e3)}
"""Metres in the unit of RADII, by the range of the Earth's radius in that unit."""


def read_grid(path: Path, *, is_lonlat: bool) -> GridBackground:
    """Return the sizes of a grid file; is_lonlat where the mesh is in degrees, and the answer then too."""
    axes: dict[str, Floats] = {}
    kind, values, radii = "", np.empty(0), np.ones(1)
    with TextRecords(path, comment=b"#", separator=b";") as records:
        for n_sections in count():
            head = _head(records)
            if head is None:
                break
            if n_sections == MOST_SECTIONS:
                raise MeshReadError(
                    f"line {records.line_number}: section {n_sections + 1}; no grid has as many"
                )
            key, words = head
            body = records.numbers(key, read=all_numbers)
            _check_head(records.peek(), records.line_number + 1)
            if key == "MSHID":
                kind = words[-1].lower()
            elif key == "RADII":
                radii = _radii(words)
            elif key == "COORD":
                axes[words[0]] = _counted(words[-1], body, f"COORD={words[0]}")
            elif key == "VALUE":
                if words[1:] != ["1"]:
                    given = ";".join(words)
                    raise MeshReadError(f"VALUE={given}, several values a node; give one size each")
                values = _counted(words[0], body, "VALUE")
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


def _head(records: TextRecords) -> tuple[str, list[str]] | None:
    """Return the name of the next section and the words behind it, one at the least; None at the end."""
    line = records.line()
    if line is None:
        return None
    _check_head(line, records.line_number)
    name, _, rest = line.decode("utf-8", "replace").partition("=")
    return name.strip().upper(), rest.split() or [""]


def _check_head(line: bytes, line_number: int) -> None:
    if line and b"=" not in line:
        raise MeshReadError(
            f"line {line_number}: {shown(line)} is no number, nor a section NAME=..; repair the file"
        )


def _counted(announced: str, numbers: Floats, what: str) -> Floats:
    if announced != str(len(numbers)):
        raise MeshReadError(
            f"{what} announces {announced[:20]} numbers, {len(numbers)} follow; repair the file"
        )
    return numbers


def _radii(words: list[str]) -> Floats:
    try:
        radii = np.array([float(word) for word in words])
    except ValueError:
        radii = np.zeros(1)
    if not (np.isfinite(radii) & (radii > 0)).all():
        raise MeshReadError(f"RADII={';'.join(words)[:60]}, no lengths; give the radii of the ellipsoid")
    return radii
