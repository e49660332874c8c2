"""Planning after reading, on 1.3 million triangles: stage by stage, and against reading the same mesh."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import meshio
import numpy as np

from bsgplan.io.file import MeshFile, RawMesh, assemble
from bsgplan.mesh.mesh import Mesh
from bsgplan.pipeline import plan_blocks
from bsgplan.result import PlannedMesh

from .cost import Cost, cost_of, cpu_of
from .meshes import archipelago, stripes
from .row import Row

TITLE = "Planning"

MAKERS = {"a few long transitions": (stripes, 1_300_000), "islands everywhere": (archipelago, 140_000)}
"""The two ends of what large meshes are like: most work in the mesh, most work in the regions."""


def rows() -> Iterator[Row]:
    """Measure on one large mesh of each kind."""
    for name, (maker, n_triangles) in MAKERS.items():
        mesh = maker(n_triangles)
        millions = mesh.n_triangles / 1e6
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "mesh.msh"
            write_msh22(path, mesh)
            _, reading = cpu_of(lambda path=path: meshio.gmsh.read(str(path)))
            whole = cost_of(["estimate", str(path)])
        raw = as_read(mesh)
        mesh_file, cleaning = cpu_of(lambda raw=raw: assemble("mesh.msh", "gmsh", raw))
        result, planning = cpu_of(lambda mesh_file=mesh_file: plan_blocks(mesh_file))
        n_regions = len(result.plan.regions)
        is_bound = maker is stripes
        what = f"{name}: {mesh.n_triangles / 1e6:.2f} million triangles, {n_regions} regions"
        yield Row(f"{what}: meshio reads MSH 2.2 (ASCII)", reading / millions, "s CPU a million")
        yield from _costs(whole, mesh, name)
        yield Row(f"{name}: cleaning and checking", cleaning / millions, "s CPU a million")
        yield Row(f"{name}: planning", planning / millions, "s CPU a million", below=3 if is_bound else None)
        yield Row(
            f"{name}: (cleaning + planning) / meshio's reading",
            (cleaning + planning) / reading,
            "x",
            below=1 if is_bound else None,
        )
        if result.planned_on < mesh.n_triangles:
            yield from _thinned(result, fresh(mesh), name)


def _thinned(result: PlannedMesh, mesh_file: MeshFile, name: str) -> Iterator[Row]:
    """Compare a plan on a thinned mesh with that on every triangle."""
    whole, planning = cpu_of(lambda: plan_blocks(mesh_file, every_triangle=True))
    n_triangles = whole.planned_on
    yield Row(f"{name}: triangles, all over those planned on", n_triangles / result.planned_on, "x")
    yield Row(f"{name}: planning on all", planning / n_triangles * 1e6, "s CPU a million")
    for what, few, all_of_them in (
        ("blocks", result.plan.n_blocks, whole.plan.n_blocks),
        (
            "blocks by the size gradient",
            result.plan.drivers.blocks_gradient_limited,
            whole.plan.drivers.blocks_gradient_limited,
        ),
    ):
        yield Row(f"{name}: {what}, thinned over all, off by", abs(few / all_of_them - 1), below=0.05)


def _costs(whole: Cost, mesh: Mesh, name: str) -> Iterator[Row]:
    yield Row(
        f"{name}: peak memory of bsgplan estimate",
        whole.peak / mesh.n_triangles,
        "B a triangle",
        below=1000 if mesh.n_triangles > 1e6 else None,  # what is imported weighs 0.1 GB whatever the mesh
    )
    yield Row(f"{name}: bsgplan estimate, all in", whole.cpu / mesh.n_triangles * 1e6, "s CPU a million")


def as_read(mesh: Mesh) -> RawMesh:
    """Return a mesh as a reader hands it over: nothing derived, arrays of its own."""
    return RawMesh(mesh.points.copy(), mesh.triangles.copy(), np.empty((0, 4), dtype=np.int64))


def fresh(mesh: Mesh) -> MeshFile:
    """Return a mesh as a file of its own, nothing derived yet but what the check needs."""
    return assemble("mesh.msh", "gmsh", as_read(mesh))


def write_msh22(path: Path, mesh: Mesh) -> None:
    """Write a mesh as ASCII MSH 2.2, as Gmsh would: 16 digits, one physical group."""
    n_points, n_triangles = mesh.n_points, mesh.n_triangles
    with path.open("w") as stream:
        stream.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{n_points}\n")
        rows = np.column_stack([np.arange(1, n_points + 1), mesh.points, np.zeros(n_points)])
        np.savetxt(stream, rows, fmt="%d %.16g %.16g %d")
        stream.write(f"$EndNodes\n$Elements\n{n_triangles}\n")
        head = np.tile([0, 2, 2, 1, 1], (n_triangles, 1))
        head[:, 0] = np.arange(1, n_triangles + 1)
        np.savetxt(stream, np.column_stack([head, mesh.triangles + 1]), fmt="%d")
        stream.write("$EndElements\n")
