"""Make tests/data/discs.npz: Frontal-Delaunay meshes of the unit disc for size fields with known curvature.

Four meshes a field, turned and coarsened a little against each other, so that a test can take means: the
irregularity inside a smaller disc is -(3/pi) times the integral of the Laplacian of log h, up to the noise
of a generator. Needs gmsh (dependency group `cases`). Run twice, it writes the same arrays.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import gmsh
import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parent))

from cases.drawing import circle, mesh_points, session, surface

Arrays = tuple[NDArray[np.float32], NDArray[np.uint16]]

FIELDS: dict[str, Callable[[float, float], float]] = {
    "constant": lambda _x, _y: 1.0,
    "exponential": lambda x, _y: float(np.exp(x)),
    "cone": lambda x, y: float(np.sqrt(x**2 + y**2 + 0.25**2)),
    "bump": lambda x, y: float(np.exp(-(x**2) - y**2)),
    "pit": lambda x, y: float(1 - 0.8 * np.exp(-8 * (x**2 + y**2))),
}
"""Size fields of guide and documentation, up to a factor."""

N_TRIANGLES = 5000
"""Triangles a mesh, about."""

TURNS, FACTORS = (0.0, 0.4, 0.9, 1.3), (1.0, 1.03, 0.97, 1.05)
"""Angle by which the field is turned under the generator, radians, and multiple of its size, one a mesh."""


def main() -> None:
    """Mesh every field four times and store the meshes."""
    arrays = {}
    for name, field in FIELDS.items():
        for k, (turn, factor) in enumerate(zip(TURNS, FACTORS, strict=True)):
            points, triangles = mesh(field, turn, factor)
            arrays[f"{name}_{k}_points"], arrays[f"{name}_{k}_triangles"] = points, triangles
            print(f"{name} {k}: {len(triangles)} triangles")
    target = Path(__file__).resolve().parent.parent / "tests" / "data" / "discs.npz"
    target.parent.mkdir(exist_ok=True)
    np.savez_compressed(target, **arrays)
    print(f"{target.name}: {target.stat().st_size} bytes")


def mesh(field: Callable[[float, float], float], turn: float, factor: float) -> Arrays:
    """Return points, (n, 2), and triangles, (m, 3), of the unit disc with the field turned."""
    cosine, sine = np.cos(turn), np.sin(turn)
    scale = factor * unit(field)

    def size(_dim: int, _tag: int, x: float, y: float, _z: float, _lc: float) -> float:
        return scale * field(cosine * x + sine * y, cosine * y - sine * x)

    with session():
        surface([circle(1.0)])
        gmsh.model.geo.synchronize()
        gmsh.model.mesh.setSizeCallback(size)
        gmsh.model.mesh.generate(2)
        tags, points = mesh_points()
        nodes = gmsh.model.mesh.getElementsByType(2)[1].reshape(-1, 3)
    triangles = np.searchsorted(tags, nodes)
    turned = points @ np.array([[cosine, -sine], [sine, cosine]])
    return turned.astype(np.float32), triangles.astype(np.uint16)


def unit(field: Callable[[float, float], float]) -> float:
    """Return the factor that gives a field about N_TRIANGLES triangles on the disc."""
    grid = np.linspace(-1, 1, 201)
    inside = [(x, y) for x in grid for y in grid if x * x + y * y < 1]
    density = np.mean([field(x, y) ** -2 for x, y in inside])
    return float(np.sqrt(np.pi * density / (np.sqrt(3) / 4) / N_TRIANGLES))


if __name__ == "__main__":
    main()
