"""Replacements: what is left of irregular vertices, quality, sizes and triangles, and the CPU seconds.

Rectangles and the shoreline are meshed here by gmsh (group cases); real meshes are taken from the folder
of the tests where it is there.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

import bsgplan
from bsgplan.io import MeshFile
from bsgplan.io.projection import project
from bsgplan.regions.selection import parse_region
from bsgplan.remesh.measures import Measures
from bsgplan.replace_pipeline import replace_in

from .cost import cpu_of
from .row import Row

TITLE = "Replace"

ROOT = Path(__file__).parents[2]
MESHES = Path(os.environ.get("BSGPLAN_SHARED", ROOT.parent / "shared")) / "meshes"

REAL = (
    ("columbia_plume_02_normal.msh", False),
    ("katrina_wnat_om2d.fort.14", True),
    ("bohai_yellow_sea_BYS_20814.2dm", True),
)
"""Real meshes, and whether they are in degrees: at most .4 of their irregular vertices may be left."""

MOVED = "shinnecock_inlet.fort.14"
"""A real mesh in degrees whose boundary may move."""

LARGE = 10_000
"""Smaller meshes get more sweeps a triangle; their seconds say nothing of large ones."""


def rows() -> Iterator[Row]:
    """Measure every mesh, whole; and one drawn region."""
    case = bsgplan.read(ROOT / "cases" / "transition" / "mesh.msh")
    replace_in(case, effort=1)  # the compiler is no part of it
    region = parse_region("0.3,0,0.96,1")
    _, seconds = cpu_of(lambda: replace_in(case, region=region))
    yield Row("a drawn region of some 300 triangles", seconds, "s CPU", below=3)
    with tempfile.TemporaryDirectory() as folder:
        for name, left, path in meshed(Path(folder)):
            yield from told(name, bsgplan.read(path), left)
    for name, is_lonlat in REAL:
        if (MESHES / name).is_file():
            mesh_file = bsgplan.read(MESHES / name)
            yield from told(name, project(mesh_file) if is_lonlat else mesh_file, 0.4)
    if (MESHES / MOVED).is_file():
        moved = replace_in(project(bsgplan.read(MESHES / MOVED)), move_boundary=True)
        yield from compared(f"{MOVED}, boundary moved", *moved.replacement.totals(), 0.4)


def told(name: str, mesh_file: MeshFile, left: float) -> Iterator[Row]:
    """Replace a whole mesh; at most that share of its irregular vertices may be left."""
    result, seconds = cpu_of(lambda: replace_in(mesh_file))
    before, after = result.replacement.totals()
    yield from compared(name, before, after, left)
    worst = max(a.q_min - b.q_min for _, a, b in result.replacement.regions())
    yield Row(f"{name}: largest loss of q_min in a region", worst, "", below=0.02)
    strips = [part.strips for part in result.replacement.parts if not part.reason]
    tried, kept = sum(s.tried for s in strips), sum(s.kept for s in strips)
    gone = sum(s.gone for s in strips)
    yield Row(f"{name}: strips better in {kept} of {tried} regions, irregular vertices fewer", gone)
    if before.n_triangles >= LARGE:
        per_triangle = seconds / before.n_triangles * 20_000
        yield Row(f"{name}: CPU for 20 000 triangles", per_triangle, "s CPU", below=90)
    again = replace_in(result.after).replacement.totals()[1]
    fewer = 1 - again.irregular_interior / after.irregular_interior
    yield Row(f"{name}: share that a second run takes away", fewer, "", below=0.05)
    yield Row(f"{name}: q_min that a second run takes away", after.q_min - again.q_min, "", below=1e-9)


def compared(name: str, before: Measures, after: Measures, left: float) -> Iterator[Row]:
    """Give the demands: irregular vertices, quality, triangles, sizes."""
    irregular = f"{before.irregular_interior}, now {after.irregular_interior}"
    share = after.irregular_interior / before.irregular_interior
    yield Row(f"{name}: irregular inside, share left", share, "", below=left, beside=irregular)
    quality = f"{before.q_min:.3f}, now {after.q_min:.3f}"
    yield Row(f"{name}: loss of q_min", before.q_min - after.q_min, "", below=0.02, beside=quality)
    count = f"{before.n_triangles}, now {after.n_triangles}"
    off = abs(after.n_triangles / before.n_triangles - 1)
    yield Row(f"{name}: triangles, off by a share of", off, "", below=0.1, beside=count)
    sizes = f"{before.size_misfit:.3f}, now {after.size_misfit:.3f}"
    misfit = after.size_misfit / before.size_misfit
    yield Row(f"{name}: size misfit, after over before", misfit, "x", below=1, beside=sizes)


def meshed(folder: Path) -> Iterator[tuple[str, float, Path]]:
    """Mesh rectangles and the shoreline by gmsh: name, share that may be left, path."""
    sys.path.insert(0, str(ROOT / "scripts"))
    from cases import coasts, drawing

    frontal, delaunay = drawing.FRONTAL_DELAUNAY, drawing.DELAUNAY
    jobs: tuple[tuple[str, float, int, Callable[[Path], float]], ...] = (
        ("28:4, Delaunay", 0.15, delaunay, lambda path: strip(path, 28, 4, 0.66)),
        ("40:10, Delaunay", 0.15, delaunay, lambda path: strip(path, 40, 10, 2.0)),
        ("shoreline, Delaunay", 0.25, delaunay, coasts.shoreline),
        ("shoreline, Frontal-Delaunay", 0.4, frontal, coasts.shoreline),
    )
    for k, (name, left, algorithm, draw) in enumerate(jobs):
        with drawing.session():
            import gmsh

            gmsh.option.setNumber("Mesh.Algorithm", algorithm)
            draw(folder / f"{k}.msh")
        yield name, left, folder / f"{k}.msh"


def strip(path: Path, fine: int, coarse: int, length: float) -> float:
    """Mesh a rectangle of height 1 with so many elements on its two ends, log h linear between."""
    from cases import drawing

    corners = np.array([(0, 0), (length, 0), (length, 1), (0, 1), (0, 0)], dtype=float)
    sides = drawing.polyline(corners)

    def size(x: float, _y: float) -> float:
        share = float(np.clip(x / length, 0, 1))
        return float(fine ** (share - 1) / coarse**share)

    return drawing.write(
        path, size, surfaces=[drawing.surface([sides])], boundaries={"sides": sides}, version=2.2,
        edges_per_curve={sides[1]: coarse, sides[3]: fine}, along=lambda x, _y: x,
    )  # fmt: skip
