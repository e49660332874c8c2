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

import re
import warnings
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import MeshReadError
from ..mesh.quads import split_quads
from ..sizing.background import Background

COMMENT = re.compile(r'("[^"\n]*")|//[^\n]*|/\*.*?\*/', re.DOTALL)
HEADER = re.compile(r'View\s*"([^"\n]*)"\s*\{')
ITEM = re.compile(r"([A-Z]+\d?)\s*\(([^(){}]*)\)\s*\{([^{}]*)\}")
TIME = re.compile(r"TIME\s*\{[^{}]*\}")
CORNERS = {"SP": 1, "SL": 2, "ST": 3, "SQ": 4, "SL2": 2, "ST2": 3, "SQ2": 4}
"""Kinds of element that carry a scalar, and their corners."""


def read_pos(path: Path, name: str | None) -> Background:
    """Return the sizes of one view of a parsed .pos file; name is needed where it has several."""
    text = path.read_text(encoding="utf-8", errors="replace")
    if "//" in text or "/*" in text:
        text = COMMENT.sub(lambda found: found[1] or " ", text)
    words = HEADER.split(text)
    views: dict[str, str] = {}
    for view, body in zip(words[1::2], words[2::2], strict=True):
        views.setdefault(view, body)
    if name is None and len(views) > 1:
        raise MeshReadError(f"{len(views)} views, {', '.join(views)}; choose one with --size")
    if name is not None and name not in views:
        raise MeshReadError(f"no view {name!r} for --size; the file's views: {', '.join(views) or 'none'}")
    return _background(views[name] if name is not None else next(iter(views.values()), ""))


def _background(body: str) -> Background:
    pieces = ITEM.split(body)
    for rest in set(pieces[::4]):
        left = TIME.sub("", rest).strip(" \t\r\n;}")
        if left:
            raise MeshReadError(f"{left[:60]!r} stands between the elements of a view; repair the file")
    kinds = np.array(pieces[1::4])
    corners, sizes = [np.empty((0, 3, 3))], [np.empty((0, 3))]
    points, point_sizes = [np.empty((0, 3))], [np.empty(0)]
    for kind in sorted(set(pieces[1::4]) & set(CORNERS)):
        which = np.flatnonzero(kinds == kind).tolist()
        n = CORNERS[kind]
        places = _table([pieces[4 * k + 2] for k in which], kind, "coordinates", 3 * n)[:, : 3 * n]
        values = _table([pieces[4 * k + 3] for k in which], kind, "values", n)[:, :n]
        places = places.reshape(len(which), n, 3)
        if n < 3:
            points.append(places.reshape(-1, 3))
            point_sizes.append(values.ravel())
        else:
            if n == 4:
                places, values = _halves(places, values)
            corners.append(places)
            sizes.append(values)
    heap, heap_sizes = np.concatenate(corners), np.concatenate(sizes)
    if len(heap):
        return Background(heap, heap_sizes)
    if len(points) == 1:
        found = ", ".join(sorted(set(pieces[1::4]))) or "nothing"
        raise MeshReadError(f"the view holds {found}; give scalars on points or triangles (SP, SL, ST, SQ)")
    return joined(np.concatenate(points), np.concatenate(point_sizes))


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


def _table(texts: list[str], kind: str, what: str, at_least: int) -> Floats:
    """Return the numbers of each text, (n_texts, n_numbers); all have the same number of them."""
    commas = {text.count(",") for text in texts}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            numbers = np.fromstring(",".join(texts), sep=",")
        except (DeprecationWarning, ValueError):
            numbers = np.empty(0)
    width = min(commas) + 1
    if len(commas) > 1 or len(numbers) != width * len(texts) or width < at_least:
        wrong = next((text for text in texts if not _is_row(text, width, at_least)), texts[0])
        raise MeshReadError(
            f"{kind} with {what} {wrong.strip()[:60]!r}; {at_least} plain numbers with commas between "
            "are needed, and of every element as many"
        )
    table: Floats = numbers.reshape(len(texts), width)
    return table


def _is_row(text: str, width: int, at_least: int) -> bool:
    words = text.split(",")
    try:
        return len([float(word) for word in words]) == max(width, at_least)
    except ValueError:
        return False
