"""The link to curvature on real Frontal-Delaunay meshes: what the generator puts into a disc is its charge.

Sum of iota over the interior vertices of D = -(3/pi) * integral over D of Laplacian(log h) [Bunin]. A
generator adds noise, so means over four meshes are compared (scripts/make_discs.py makes them), inside
rho <= .6: generators push charge to the wall. Pairs of valence 5 and 7 that a circle parts count as a
charge, so each radius stands for seven around it.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from bsgplan.mesh import clean
from bsgplan.sizing import size_field
from bsgplan.sizing.charge import edge_fluxes

DATA = Path(__file__).resolve().parent.parent / "data" / "discs.npz"
RADII = (0.4, 0.6)

# flux of grad(log h) out of the disc of radius rho, in closed form
FLUXES = {
    "constant": lambda _: 0.0,
    "exponential": lambda _: 0.0,
    "cone": lambda rho: 2 * np.pi * rho**2 / (rho**2 + 0.25**2),
    "bump": lambda rho: -4 * np.pi * rho**2,
    "pit": lambda rho: 2 * np.pi * rho * 12.8 * rho * np.exp(-8 * rho**2) / (1 - 0.8 * np.exp(-8 * rho**2)),
}


def discs(name):
    with np.load(DATA) as stored:
        return [clean(stored[f"{name}_{k}_points"], stored[f"{name}_{k}_triangles"]).mesh for k in range(4)]


@pytest.mark.parametrize("name", FLUXES)
def test_the_irregular_vertices_of_a_generator_are_the_charge(name):
    meshes = discs(name)
    for rho in RADII:
        around = rho + np.linspace(-0.03, 0.03, 7)
        expected = np.mean([-3 / np.pi * FLUXES[name](r) for r in around])
        counted = [m.vertex_irregularity[np.hypot(*m.points.T) < r].sum() for m in meshes for r in around]
        assert np.mean(counted) == pytest.approx(expected, abs=0.8)


@pytest.mark.parametrize("name", FLUXES)
def test_the_budget_read_off_a_mesh_is_the_charge(name):
    for rho in RADII:
        expected = -3 / np.pi * FLUXES[name](rho)
        budgets = []
        for mesh in discs(name):
            inside = np.hypot(*mesh.centroids.T) < rho
            budgets.append(edge_fluxes(size_field(mesh)).sum(axis=1)[inside].sum())
        assert np.mean(budgets) == pytest.approx(expected, abs=0.8)
