"""What every case needs of gmsh: a quiet, repeatable session, outlines, a mesh file from a size function."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path

import gmsh
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Size = Callable[[float, float], float]
"""The target edge length at a point (x, y)."""

DELAUNAY, FRONTAL_DELAUNAY = 5, 6

OPTIONS = {
    "General.Terminal": 0,
    "General.NumThreads": 1,
    "Mesh.MaxNumThreads1D": 1,
    "Mesh.MaxNumThreads2D": 1,
    "Mesh.RandomSeed": 7331,
    "Mesh.Algorithm": FRONTAL_DELAUNAY,
    "Mesh.MeshSizeExtendFromBoundary": 0,
    "Mesh.MeshSizeFromPoints": 0,
    "Mesh.MeshSizeFromCurvature": 0,
    "Mesh.LcIntegrationPrecision": 1e-10,
    "Mesh.Binary": 0,
    "Mesh.SaveAll": 0,
    "PostProcessing.SaveMesh": 0,
}


@contextmanager
def session() -> Iterator[None]:
    """Open gmsh with options that make two runs give the same file."""
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        for name, value in OPTIONS.items():
            gmsh.option.setNumber(name, value)
        gmsh.model.add("case")
        yield
    finally:
        gmsh.finalize()


def polyline(points: Floats) -> list[int]:
    """Draw straight lines from each point to the next, (n, 2); the first point once more closes it."""
    tags = [gmsh.model.geo.addPoint(x, y, 0) for x, y in points[:-1]]
    closed = bool(np.array_equal(points[0], points[-1]))
    tags.append(tags[0] if closed else gmsh.model.geo.addPoint(*points[-1], 0))
    return [gmsh.model.geo.addLine(a, b) for a, b in pairwise(tags)]


def closed_spline(points: Floats, *, n_pieces: int = 2) -> list[int]:
    """Draw a smooth closed curve through points, (n, 2), cut into a few pieces."""
    tags = [gmsh.model.geo.addPoint(x, y, 0) for x, y in points]
    cuts = np.linspace(0, len(tags), n_pieces + 1).astype(int)
    ring = [*tags, tags[0]]
    return [gmsh.model.geo.addSpline(ring[a : b + 1]) for a, b in pairwise(cuts)]


def circle(radius: float) -> list[int]:
    """Draw a circle about the origin as four arcs."""
    centre = gmsh.model.geo.addPoint(0, 0, 0)
    angles = np.arange(4) * np.pi / 2
    tags = [gmsh.model.geo.addPoint(radius * np.cos(a), radius * np.sin(a), 0) for a in angles]
    return [gmsh.model.geo.addCircleArc(tags[i], centre, tags[(i + 1) % 4]) for i in range(4)]


def surface(loops: Sequence[Sequence[int]]) -> int:
    """Fill the first loop of curves, less the holes that the others bound."""
    return int(gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(loop) for loop in loops]))


def write(
    path: Path,
    size: Size,
    *,
    surfaces: Sequence[int],
    boundaries: dict[str, Sequence[int]],
    version: float,
    edges_per_curve: dict[int, int] | None = None,
    size_array: str | None = None,
    along: Size | None = None,
) -> float:
    """Mesh the surfaces to the size function and write MSH of the version, with named physical groups.

    Curves in edges_per_curve get exactly so many edges. The mesh is calibrated along a coordinate of the
    case, by default the logarithm of the size. A size_array writes the size of each point under
    that name. Returns the triangles that the size function asks for, sum of A / (sqrt(3)/4 h**2).
    """
    gmsh.model.geo.synchronize()
    for name, curves in boundaries.items():
        gmsh.model.addPhysicalGroup(1, curves, name=name)
    gmsh.model.addPhysicalGroup(2, surfaces, name="domain")
    for curve, n_edges in (edges_per_curve or {}).items():
        gmsh.model.mesh.setTransfiniteCurve(curve, n_edges + 1)
    generate_calibrated(surfaces, size, along or (lambda x, y: float(np.log(size(x, y)))))
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.write(str(path))
    tags, points = mesh_points()
    if size_array is not None:
        view = gmsh.view.add(size_array)
        values = np.array([size(x, y) for x, y in points])
        gmsh.view.addHomogeneousModelData(view, 0, "case", "NodeData", tags, values)
        gmsh.view.write(view, str(path), append=True)
    return float(sum(wanted_weights(tag, size, size)[1].sum() for tag in surfaces))


def generate_calibrated(surfaces: Sequence[int], size: Size, along: Size, *, n_passes: int = 5) -> None:
    """Mesh to a multiple of the size such that the triangles asked for are there, all along a coordinate.

    gmsh makes edges 3 to 12 % shorter than asked, most where the size grows; the multiple, a function of
    the coordinate on each surface, makes up for it.
    """
    multiples = {tag: Multiple() for tag in surfaces}

    def asked(dim: int, tag: int, x: float, y: float, _z: float, _size: float) -> float:
        return size(x, y) * (multiples[tag](along(x, y)) if dim == 2 else 1.0)

    for turn in range(n_passes):
        gmsh.model.mesh.clear()
        gmsh.model.mesh.setSizeCallback(asked)
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.removeSizeCallback()
        if turn + 1 < n_passes:
            for tag in surfaces:
                multiples[tag].correct(*wanted_weights(tag, size, along))


class Multiple:
    """A multiple of the size, its logarithm piecewise linear in a coordinate."""

    def __init__(self) -> None:
        self.stations: Floats = np.zeros(1)
        self.logs: Floats = np.zeros(1)

    def __call__(self, coordinate: float) -> float:
        """Return the multiple at a value of the coordinate."""
        return float(np.exp(np.interp(coordinate, self.stations, self.logs)))

    def correct(self, coordinates: Floats, weights: Floats) -> None:
        """Correct by the triangles of a mesh: their coordinates and the triangles asked for in each, (n,)."""
        n_bins = int(np.clip(len(weights) // 20, 1, 12))
        parts = np.array_split(np.argsort(coordinates, kind="stable"), n_bins)
        stations = np.array([coordinates[part].mean() for part in parts])
        excess = np.array([np.log(len(part) / weights[part].sum()) / 2 for part in parts])
        self.logs = np.interp(stations, self.stations, self.logs) + np.clip(0.8 * excess, -0.15, 0.15)
        self.stations = stations


def wanted_weights(tag: int, size: Size, along: Size) -> tuple[Floats, Floats]:
    """Return the coordinate of each triangle of a surface and the triangles asked for there, (n,) each.

    A / (sqrt(3)/4 h**2) is 1 where a triangle has the size asked for.
    """
    tags, points = mesh_points()
    nodes = gmsh.model.mesh.getElementsByType(2, tag)[1].reshape(-1, 3)
    corners = points[np.searchsorted(tags, nodes)]
    (x1, y1), (x2, y2) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    centres = corners.mean(axis=1)
    h = np.array([size(x, y) for x, y in centres])
    weights = np.abs(x1 * y2 - x2 * y1) / 2 / (np.sqrt(3) / 4 * h**2)
    return np.array([along(x, y) for x, y in centres]), weights


def mesh_points() -> tuple[NDArray[np.uint64], Floats]:
    """Return the tags, ascending, and the coordinates, (n, 2), of the points of the mesh."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes(2, includeBoundary=True)
    unique, first = np.unique(tags, return_index=True)
    return unique, coordinates.reshape(-1, 3)[first, :2]
