"""Cases whose shape and size are formulas: rectangle, square, annulus, plate, aerofoil."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import shapely

from .drawing import DELAUNAY, circle, closed_spline, polyline, surface, write

PAPER_FINE, PAPER_COARSE = 28, 4
"""Elements on the fine and on the coarse front of the paper's region (Section 4)."""
FINE_END, TRANSITION, COARSE_END = 0.3, 0.66, 2.0
"""Lengths of the three parts of the rectangle, in heights."""


def rectangle(path: Path) -> float:
    """Mesh a rectangle of height 1 with a transition from 28 to 4 elements in the middle."""
    from gmsh import model

    cuts = np.cumsum([0.0, FINE_END, TRANSITION, COARSE_END])
    low = [model.geo.addPoint(x, 0, 0) for x in cuts]
    high = [model.geo.addPoint(x, 1, 0) for x in cuts]
    walls = [model.geo.addLine(a, b) for a, b in zip(low, high, strict=True)]
    floors = [model.geo.addLine(a, b) for a, b in pairwise(low)]
    roofs = [model.geo.addLine(a, b) for a, b in pairwise(high)]
    parts = [surface([[floors[i], walls[i + 1], -roofs[i], -walls[i]]]) for i in range(3)]

    def size(x: float, _y: float) -> float:
        progress = np.clip((x - FINE_END) / TRANSITION, 0, 1)
        return float(PAPER_FINE ** (progress - 1) / PAPER_COARSE**progress)

    counts = dict(zip(walls, (PAPER_FINE, PAPER_FINE, PAPER_COARSE, PAPER_COARSE), strict=True))
    counts |= {curve: round(COARSE_END * PAPER_COARSE) for curve in (floors[2], roofs[2])}
    sides = {"left": walls[:1], "right": walls[3:], "walls": [*floors, *roofs]}
    return write(
        path,
        size,
        surfaces=parts,
        boundaries=sides,
        version=2.2,
        edges_per_curve=counts,
        along=lambda x, _y: x,
    )


def transition(path: Path) -> float:
    """Mesh the rectangle by Delaunay refinement."""
    from gmsh import option

    option.setNumber("Mesh.Algorithm", DELAUNAY)
    return rectangle(path)


def square(path: Path) -> float:
    """Mesh the unit square uniformly."""
    sides = polyline(np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)], dtype=float))
    names = dict(zip(("bottom", "right", "top", "left"), ([side] for side in sides), strict=True))
    return write(path, lambda _x, _y: 1 / 30, surfaces=[surface([sides])], boundaries=names, version=4.1)


def annulus(path: Path, *, n_around: int = 48, outer: float = 20.0) -> float:
    """Mesh the ring 1 < r < outer with h proportional to r: every circle carries n_around elements."""
    inside, outside = circle(1.0), circle(outer)
    return write(
        path,
        lambda x, y: 2 * np.pi / n_around * float(np.hypot(x, y)),
        surfaces=[surface([outside, inside])],
        boundaries={"inner": inside, "outer": outside},
        version=4.1,
        edges_per_curve=dict.fromkeys([*inside, *outside], n_around // 4),
    )


def plate(path: Path, *, fine: float = 0.008, coarse: float = 0.09, growth: float = 0.25) -> float:
    """Mesh a unit plate with a sharp notch; a band ahead of the notch, where a crack would run, is fine."""
    tip, mouth = 0.5, 0.01
    outline = [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0.5 + mouth), (tip, 0.5), (0, 0.5 - mouth), (0, 0)]
    bottom, right, top, above, upper, lower, below = sides = polyline(np.array(outline, dtype=float))
    band = shapely.box(tip - 0.05, 0.44, 1.0, 0.56)
    names = {
        "bottom": [bottom],
        "right": [right],
        "top": [top],
        "left": [above, below],
        "notch": [upper, lower],
    }

    def size(x: float, y: float) -> float:
        return min(fine + growth * float(band.distance(shapely.Point(x, y))), coarse)

    return write(path, size, surfaces=[surface([sides])], boundaries=names, version=2.2, size_array="size")


def aerofoil(path: Path, *, fine: float = 0.004, growth: float = 0.2, far: float = 20.0) -> float:
    """Mesh the air around a NACA 0012 of chord 1, out to a circle; h grows with the distance to it."""
    outline = naca_0012(120)
    wing = shapely.LinearRing(outline)
    skin, horizon = closed_spline(outline), circle(far)
    return write(
        path,
        lambda x, y: fine + growth * float(wing.distance(shapely.Point(x, y))),
        surfaces=[surface([horizon, skin])],
        boundaries={"aerofoil": skin, "far field": horizon},
        version=4.1,
    )


def naca_0012(n_sections: int) -> np.ndarray:
    """Return the outline of the NACA 0012 with closed trailing edge, (2 n_sections, 2), nose at (-.5, 0).

    The first point is the trailing edge, the point n_sections the nose.
    """
    x = (1 + np.cos(np.linspace(0, np.pi, n_sections + 1))) / 2
    thickness = 0.6 * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    upper, lower = np.column_stack([x, thickness]), np.column_stack([x, -thickness])
    outline = np.vstack([upper, lower[-2:0:-1]]) - (0.5, 0)
    outline[[0, n_sections], 1] = 0.0
    return outline
