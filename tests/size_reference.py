"""Slow, obvious twins of the readers of size files: the whole text at once, cut up by regular expressions."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from bsgplan.arrays import Floats
from bsgplan.mesh.quads import split_quads

COMMENT = re.compile(r'("[^"\n]*")|//[^\n]*|/\*.*?\*/', re.DOTALL)
HEADER = re.compile(r'View\s*"([^"\n]*)"\s*\{')
ITEM = re.compile(r"([A-Z]+\d?)\s*\(([^(){}]*)\)\s*\{([^{}]*)\}")
TIME = re.compile(r"TIME\s*\{[^{}]*\}")
CORNERS = {"SP": 1, "SL": 2, "ST": 3, "SQ": 4, "SL2": 2, "ST2": 3, "SQ2": 4}
SECTION = re.compile(r"^[ \t]*([A-Za-z]\w*)[ \t]*=[ \t]*([^\n]*?)[ \t\r]*$", re.MULTILINE)


def pos(path: Path, name: str | None) -> tuple[Floats, Floats]:
    """Return the triangles of a view, (n, 3, 3) and (n, 3), or its points, (n, 1, 3) and (n, 1)."""
    words = HEADER.split(COMMENT.sub(lambda found: found[1] or " ", path.read_text(encoding="utf-8")))
    views: dict[str, str] = {}
    for view, body in zip(words[1::2], words[2::2], strict=True):
        views.setdefault(view, body)
    if name is None and len(views) > 1:
        raise ValueError("several views")
    pieces = ITEM.split(views[name] if name is not None else next(iter(views.values()), ""))
    if any(TIME.sub("", rest).strip(" \t\r\n;}") for rest in pieces[::4]):
        raise ValueError("something between the elements")
    found: dict[int, list[tuple[Floats, Floats]]] = {1: [], 3: []}
    for kind in sorted(set(pieces[1::4]) & set(CORNERS)):
        n = CORNERS[kind]
        which = [k for k, other in enumerate(pieces[1::4]) if other == kind]
        places = _table([pieces[4 * k + 2] for k in which], 3 * n).reshape(-1, n, 3)
        values = _table([pieces[4 * k + 3] for k in which], n)
        if n == 4:
            triangles, _ = split_quads(places.reshape(-1, 3), np.arange(4 * len(places)).reshape(-1, 4))
            places, values = places.reshape(-1, 3)[triangles], values.ravel()[triangles]
        if n < 3:
            places, values = places.reshape(-1, 1, 3), values.reshape(-1, 1)
        found[places.shape[1]].append((places, values))
    parts = found[3] or found[1]
    return np.concatenate([part[0] for part in parts]), np.concatenate([part[1] for part in parts])


def _table(texts: list[str], at_least: int) -> Floats:
    table = np.array([[float(word) for word in text.split(",")] for text in texts])
    if table.shape[1] < at_least:
        raise ValueError("too few numbers")
    return table[:, :at_least]


def sol(path: Path) -> Floats:
    """Return the first solution of a file of one kind of solution, (n_vertices, 1, 3 or 6)."""
    words = re.sub(r"#[^\n]*", "", path.read_text()).split()
    dimension = int(words[words.index("Dimension") + 1])
    n, n_solutions, *types = (int(word) for word in words[words.index("SolAtVertices") + 1 :][:3])
    assert n_solutions == len(types) == 1
    numbers = [float(word) for word in words[words.index("SolAtVertices") + 4 : words.index("End")]]
    return np.array(numbers).reshape(n, 1 if types == [1] else dimension * (dimension + 1) // 2)


def grid(path: Path) -> tuple[Floats, Floats, Floats]:
    """Return the columns, rows and sizes of a grid, (n_x,), (n_y,) and (n_y, n_x)."""
    words = SECTION.split(re.sub(r"^[ \t]*#[^\n]*", "", path.read_text(), flags=re.M))
    bodies = {
        (key, given.split(";")[0]): np.array([float(word) for word in body.split()])
        for key, given, body in zip(*(words[k::3] for k in (1, 2, 3)), strict=True)
        if key in ("COORD", "VALUE")
    }
    x, y = bodies["COORD", "1"], bodies["COORD", "2"]
    (values,) = (body for (key, _), body in bodies.items() if key == "VALUE")
    return x, y, values.reshape(len(x), len(y)).T
