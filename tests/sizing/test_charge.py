"""Charge: sums over regions are fluxes through borders, discs have their closed form, meshes obey it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import disc, hilly

from bsgplan.arrays import Floats
from bsgplan.io import read
from bsgplan.mesh import Mesh
from bsgplan.sizing import SizeField, named_size_field, size_field
from bsgplan.sizing.charge import edge_fluxes, region_charges

CASES = Path(__file__).parents[2] / "cases"
FINE = disc(50)
RADIUS = np.hypot(*FINE.points.T)

# h(r, x) and the charge within radius rho, -6 rho d(log h)/dr where h is radial: the table of guide/theory.md
DISCS: dict[str, tuple[Callable[[Floats, Floats], Floats], dict[float, float]]] = {
    "const": (lambda r, _: 1 + 0 * r, {0.4: 0.0, 0.6: 0.0}),
    "exp(x)": (lambda _, x: np.exp(x), {0.4: 0.0, 0.6: 0.0}),
    "sqrt(r^2 + .25^2)": (lambda r, _: np.sqrt(r**2 + 0.0625), {0.4: -4.31, 0.6: -5.11}),
    "exp(-r^2)": (lambda r, _: np.exp(-(r**2)), {0.4: 1.92, 0.6: 4.32}),
    "1 - .8 exp(-8 r^2)": (lambda r, _: 1 - 0.8 * np.exp(-8 * r**2), {0.4: -4.39, 0.6: -1.62}),
}


@pytest.mark.parametrize("rho", [0.4, 0.6])
@pytest.mark.parametrize("name", DISCS)
def test_charges_in_discs_have_their_closed_form(name: str, rho: float) -> None:
    """50 edges from centre to wall and h up to one of them: the reach of 3 h is at most 0.06."""
    shape, expected = DISCS[name]
    h = shape(RADIUS, FINE.points[:, 0])
    size = named_size_field(FINE, 0.02 * h / h.max(), "h")
    inside = np.hypot(*FINE.centroids.T) < rho
    charge = float(edge_fluxes(size)[inside].sum())
    assert charge == pytest.approx(expected[rho], abs=0.3)


@given(hilly(12), st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_region_charges_add_up_to_the_flux_through_the_boundary(
    case: tuple[Mesh, Floats], n: int, seed: int
) -> None:
    mesh, log_h = case
    fluxes = edge_fluxes(SizeField(mesh, np.exp(log_h)))
    label = np.random.default_rng(seed).integers(0, n, mesh.n_triangles)
    topology = mesh.topology
    is_wall = topology.is_boundary_edge[topology.cell_edges]  # the edge of column i may be another than i's
    of_edge = np.zeros(len(topology.edges))
    ends = np.sort(np.stack([mesh.triangles, np.roll(mesh.triangles, -1, axis=1)], axis=-1), axis=-1)
    number = {tuple(e): k for k, e in enumerate(np.sort(topology.edges, axis=1).tolist())}
    for pair, flux in zip(ends.reshape(-1, 2).tolist(), fluxes.ravel().tolist(), strict=True):
        of_edge[number[tuple(pair)]] += flux
    assert is_wall.any()
    assert of_edge[~topology.is_boundary_edge] == pytest.approx(0, abs=1e-9)
    assert region_charges(label, fluxes).sum() == pytest.approx(
        of_edge[topology.is_boundary_edge].sum(), abs=1e-9
    )


@given(hilly(12), st.floats(-3, 3), st.floats(0, 6.2))
def test_charge_does_not_change_under_scaling_and_rotation(
    case: tuple[Mesh, Floats], magnitude: float, angle: float
) -> None:
    mesh, log_h = case
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    scale = 10.0**magnitude
    other = Mesh(scale * mesh.points @ turn.T, mesh.triangles)
    moved = edge_fluxes(SizeField(other, scale * np.exp(log_h)))
    assert moved == pytest.approx(edge_fluxes(SizeField(mesh, np.exp(log_h))), abs=2e-3)


def irregularity_between(mesh: Mesh, distance: Floats, low: float, high: float) -> int:
    """Sum of iota over the interior vertices with low < distance < high."""
    inside = (distance > low) & (distance < high) & ~mesh.topology.is_boundary
    return int(mesh.vertex_irregularity[inside].sum())


def test_a_ring_of_size_proportional_to_the_radius_needs_no_irregular_vertex() -> None:
    """Log h is harmonic: within any radius the charge is 0, and so is the mesh's own sum, to its noise.

    A generator scatters some 4 units over a ring of 48 elements: the mean of 60 radii is compared.
    """
    mesh = read(CASES / "annulus" / "mesh.msh").mesh
    fluxes = edge_fluxes(size_field(mesh)).sum(axis=1)
    cells, points = np.hypot(*mesh.centroids.T), np.hypot(*mesh.points.T)
    radii = np.geomspace(1.5, 18, 60)
    charges = [fluxes[cells < r].sum() for r in radii]
    assert np.abs(charges).max() < 0.6
    real = np.mean([irregularity_between(mesh, points, 0, r) for r in radii])
    assert real == pytest.approx(np.mean(charges), abs=2.5)


def test_the_mesh_around_islands_has_the_irregularity_that_its_size_field_demands() -> None:
    """Means over discs about the five islands, as guide/theory.md compares: within .8."""
    mesh = read(CASES / "islands" / "mesh.msh").mesh
    fluxes = edge_fluxes(size_field(mesh)).sum(axis=1)
    islands = (
        ((15.04, 12.00), 4.07),
        ((35.15, 27.91), 5.01),
        ((45.00, 10.00), 0.92),
        ((12.02, 29.99), 1.23),
        ((22.00, 20.00), 1.80),
    )
    charges, real = [], []
    for centre, radius in islands:
        cells = np.hypot(*(mesh.centroids - centre).T) / radius
        points = np.hypot(*(mesh.points - centre).T) / radius
        for share in (1.3, 1.6, 2.0, 2.4):
            charges.append(fluxes[(cells > 1.05) & (cells < share)].sum())
            real.append(irregularity_between(mesh, points, 1.05, share))
    assert np.mean(charges) > 2
    assert np.mean(real) == pytest.approx(np.mean(charges), abs=0.8)
