"""The budget on surfaces: their own curvature counts, and a closed one has -6 chi in all."""

from __future__ import annotations

import numpy as np
import pytest

from bsgplan.mesh import Mesh
from bsgplan.patterns import subdivide
from bsgplan.sizing import size_field
from bsgplan.sizing.charge import edge_fluxes


def octahedron(n, squeeze=1.0):
    corners = np.array([[1.0, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    faces = [[a, b, c] for a in (0, 1) for b in (2, 3) for c in (4, 5)]
    points, triangles, _ = subdivide(corners, np.array(faces), n)
    sphere = points / np.linalg.norm(points, axis=1, keepdims=True)
    return Mesh(sphere * [1, 1, squeeze], triangles)


def torus(n=40, m=20):
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    u, v = 2 * np.pi * i / n, 2 * np.pi * j / m
    points = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], axis=-1)
    a, b = i * m + j, (i + 1) % n * m + j
    c, d = (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
    corners = [np.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))]
    return Mesh(points.reshape(-1, 3), np.concatenate(corners))


@pytest.mark.parametrize(
    ("mesh", "total"),
    [(octahedron(8), -12), (octahedron(9, 3.0), -12), (torus(), 0)],
    ids=["sphere", "egg", "torus"],
)
def test_a_closed_surface_has_a_budget_of_minus_six_chi(mesh, total):
    assert edge_fluxes(size_field(mesh)).sum() == pytest.approx(total, abs=1e-6)
    assert mesh.irregularity.total == total
