"""Make tests/data/rectangles.npz: Frontal-Delaunay meshes of a rectangle for size fields of known curvature.

Three meshes a field, of a little different sizes, so that a test can take means. Transitions are many
elements long, far more than the smoothing of the budget. Needs gmsh (dependency group `cases`). Run twice,
it writes the same arrays.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import gmsh
import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parent))

from cases.drawing import mesh_points, polyline, session, surface

Arrays = tuple[NDArray[np.float32], NDArray[np.uint16]]

SIDES = np.array([[-1.5, -1], [1.5, -1], [1.5, 1], [-1.5, 1], [-1.5, -1]])
"""The rectangle, first corner once more."""

FIELDS: dict[str, Callable[[float, float], float]] = {
    "exponential": lambda x, _y: float(np.exp(0.8 * x)),
    "transition": lambda x, _y: float(np.exp(1.2 * np.tanh(x / 0.35))),
    "bump": lambda x, y: float(np.exp(-(x**2 + y**2) / 2)),
    "harmonic": lambda x, y: float(np.exp((x**2 - y**2) / 2)),
}
"""Size fields, up to a factor: `transition` leads from one uniform zone to another, 11 times coarser."""

N_TRIANGLES, FEWER = {"transition": 24_000}, 12_000
"""Triangles a mesh, about: of a field, of the others."""

FACTORS = (1.0, 1.03, 0.97)
"""Multiple of the size, one a mesh."""


def main() -> None:
    """Mesh every field three times and store the meshes."""
    arrays = {}
    for name, field in FIELDS.items():
        for k, factor in enumerate(FACTORS):
            points, triangles = mesh(field, factor * unit(field, N_TRIANGLES.get(name, FEWER)))
            arrays[f"{name}_{k}_points"], arrays[f"{name}_{k}_triangles"] = points, triangles
            print(f"{name} {k}: {len(triangles)} triangles")
    target = Path(__file__).resolve().parent.parent / "tests" / "data" / "rectangles.npz"
    np.savez_compressed(target, **arrays)
    print(f"{target.name}: {target.stat().st_size} bytes")


def mesh(field: Callable[[float, float], float], scale: float) -> Arrays:
    """Return points, (n, 2), and triangles, (m, 3), of the rectangle with sizes scale times the field."""
    with session():
        surface([polyline(SIDES)])
        gmsh.model.geo.synchronize()
        gmsh.model.mesh.setSizeCallback(lambda _dim, _tag, x, y, _z, _lc: scale * field(x, y))
        gmsh.model.mesh.generate(2)
        tags, points = mesh_points()
        nodes = gmsh.model.mesh.getElementsByType(2)[1].reshape(-1, 3)
    return points.astype(np.float32), np.searchsorted(tags, nodes).astype(np.uint16)


def unit(field: Callable[[float, float], float], n_triangles: int) -> float:
    """Return the factor that gives a field about so many triangles on the rectangle."""
    grid = [field(x, y) ** -2 for x in np.linspace(-1.5, 1.5, 151) for y in np.linspace(-1, 1, 101)]
    return float(np.sqrt(6 * np.mean(grid) / (np.sqrt(3) / 4) / n_triangles))


if __name__ == "__main__":
    main()
