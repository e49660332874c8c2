"""Layouts that the tests of exports share: small, laid out once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from bsgplan.blocks import lay_out
from bsgplan.io import Boundary, MeshFile, read
from bsgplan.laid_out import LaidOut, find_features, lay_out_file
from bsgplan.mesh import Mesh
from bsgplan.sizing import size_field

CASES = Path(__file__).parents[2] / "cases"


def lattice(n: int, *, width: float = 1.0) -> Mesh:
    """Return a square of 2 n^2 triangles."""
    x, y = np.meshgrid(np.linspace(0, width, n + 1), np.linspace(0, width, n + 1))
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    lower = np.column_stack([a, a + 1, a + n + 2])
    upper = np.column_stack([a, a + n + 2, a + n + 1])
    return Mesh(np.column_stack([x.ravel(), y.ravel()]), np.concatenate([lower, upper]))


def as_file(mesh: Mesh, boundaries: tuple[Boundary, ...] = (), **more: object) -> MeshFile:
    """Return a mesh as a file without quads."""
    none = {"quads": np.empty((0, 4), dtype=int), "quad_points": np.empty((0, 2))}
    return MeshFile(path="made", format="made", mesh=mesh, boundaries=boundaries, **none, **more)  # type: ignore[arg-type]


@pytest.fixture(scope="session")
def plate() -> LaidOut:
    """The case plate: a quarter of a plate with a hole, five named groups."""
    return lay_out_file(
        mesh_file := read(CASES / "plate" / "mesh.msh"), size_field(mesh_file.mesh), side=4, effort=10
    )


@pytest.fixture(scope="session")
def straight() -> LaidOut:
    """The case plate with straight blocks."""
    mesh_file = read(CASES / "plate" / "mesh.msh")
    size = size_field(mesh_file.mesh)
    features = find_features(mesh_file, size, side=4)
    grid = lay_out(size, tris_per_block=16, effort=10, kept=features.kept, is_straight=True)
    return LaidOut(grid, mesh_file)


@pytest.fixture(scope="session")
def ocean() -> LaidOut:
    """A square sea with a depth, an open boundary, a coast and a barrier of one side with a crest."""
    n = 24
    mesh = lattice(n, width=24.0)
    south, east = np.arange(n + 1), np.arange(n + 1) * (n + 1) + n
    north, west = np.arange(n, -1, -1) + n * (n + 1), np.arange(n, -1, -1) * (n + 1)
    x, y = mesh.points.T
    crest = np.column_stack([x[north], np.full(n + 1, 1.0)])
    boundaries = (
        Boundary("open", west),
        Boundary("land", np.concatenate([south, east[1:]]), 0),
        Boundary("land", north[:13], 3, columns=crest[:13]),
        Boundary("land", north[12:], 20),
    )
    mesh_file = as_file(mesh, boundaries, point_data={"depth": 3 * x - y}, title="a sea")
    return lay_out_file(mesh_file, size_field(mesh), side=3, effort=10)
