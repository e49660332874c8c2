"""Reader of the sizes in a Gmsh post-processing file (.pos), the text form that Gmsh calls parsed.

Grammar, free format, // and /* */ are comments:

    View "name" {
      TIME { t, t, ... };                                  optional
      SP(x,y,z){v, ...};                                   a value at a point
      SL(x,y,z, x,y,z){v,v, ...};                          at the ends of a line
      ST(x,y,z, x,y,z, x,y,z){v,v,v, ...};                 at the corners of a triangle
      SQ(x,y,z, x,y,z, x,y,z, x,y,z){v,v,v,v, ...};        of a quadrilateral
    };

Values of several time steps follow one another, the first step is taken. ST2 and SQ2 have nodes beside their
corners, which are left out. Where a view has no triangle or quadrilateral its points are joined by a
Delaunay triangulation. Vectors, tensors, volumes and texts are left out.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import MeshReadError
from ..mesh.quads import split_quads
from ..sizing.background import Background
from .chunks import pieces
from .growing import Growing
from .pos_elements import ElementReader
from .pos_text import parts

BUFFER = 2**18
"""Bytes read at a time."""
MOST_NAMES = 20
"""Names of views, or kinds of elements, that a message tells."""


def read_pos(path: Path, name: str | None) -> Background:
    """Return the sizes of one view of a parsed .pos file; name is needed where it has several."""
    names: dict[str, int] = {}
    heaps, reader = dict[str, _Heap](), ElementReader()
    for part in parts(pieces(path, BUFFER)):
        first = names.setdefault(part.name, part.view)
        if part.view != (0 if name is None else first) or name not in (None, part.name):
            continue
        for kind, places, values in reader.read(part.text):
            heaps.setdefault(kind, _Heap(places.shape[1])).add(places, values)
    views = ", ".join([*list(names)[:MOST_NAMES], *[".."] * (len(names) > MOST_NAMES)])
    if name is None and len(names) > 1:
        raise MeshReadError(f"{len(names)} views, {views}; choose one with --size")
    if name is not None and name not in names:
        raise MeshReadError(f"no view {name!r} for --size; the file's views: {views or 'none'}")
    for n_corners in (3, 1):
        found = [heaps[kind].taken() for kind in sorted(heaps) if heaps[kind].n_corners == n_corners]
        if len(found) == 1:
            places, values = found[0]
        elif found:
            places, values = (np.concatenate(arrays) for arrays in zip(*found, strict=True))
        else:
            continue
        return Background(places, values) if n_corners == 3 else joined(places[:, 0], values[:, 0])
    there = ", ".join(sorted(reader.kinds)[:MOST_NAMES]) or "nothing"
    raise MeshReadError(f"the view holds {there}; give scalars on points or triangles (SP, SL, ST, SQ)")


class _Heap:
    """The elements of one kind, as triangles or as points."""

    def __init__(self, n_corners: int) -> None:
        self.n_corners = 1 if n_corners < 3 else 3
        self._places, self._values = Growing(3 * self.n_corners), Growing(self.n_corners)

    def add(self, places: Floats, values: Floats) -> None:
        """Append elements, (n, n_corners, 3) and (n, n_corners); a quadrilateral is two triangles."""
        if values.shape[1] == 4:
            places, values = _halves(places, values)
        self._places.add(places.reshape(-1, 3 * self.n_corners))
        self._values.add(values.reshape(-1, self.n_corners))

    def taken(self) -> tuple[Floats, Floats]:
        """Return the places, (n, 3 or 1, 3), and values, (n, 3 or 1)."""
        return self._places.taken().reshape(-1, self.n_corners, 3), self._values.taken()


def joined(points: Floats, sizes: Floats) -> Background:
    """Return the background on the Delaunay triangulation of points, (n, 3), of one plane z = const."""
    from scipy.spatial import Delaunay, QhullError  # 0.1 s that other files need not spend

    points, first = np.unique(points, axis=0, return_index=True)
    sizes = sizes[first]
    if np.ptp(points[:, 2]) > 0:
        raise MeshReadError("sizes at points that lie in space; give them on triangles (ST) of the surface")
    flat = points[:, :2]
    try:
        triangles = Delaunay(flat - flat.mean(axis=0)).simplices
    except (QhullError, ValueError):
        raise MeshReadError(
            f"sizes at {len(flat)} points that span no area; give three or more that do"
        ) from None
    return Background(flat[triangles], sizes[triangles])


def _halves(places: Floats, values: Floats) -> tuple[Floats, Floats]:
    triangles, _ = split_quads(places.reshape(-1, 3), np.arange(4 * len(places)).reshape(-1, 4))
    return places.reshape(-1, 3)[triangles], values.ravel()[triangles]
