"""The link to curvature in rectangles: Frontal-Delaunay meshes, walls, and size fields given by formula.

scripts/make_rectangles.py makes the meshes. Inside a smaller rectangle the sum of iota is -(3/pi) times the
flux of grad(log h) out of it. Where it reaches from wall to wall, the vertices on the walls count against
valence 4: by Gauss and Bonnet they take -(3/pi) times minus the flux through the walls, so the sum is that of
the flux through the two cuts alone. Means over three meshes, and over seven rectangles around each.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from bsgplan.mesh import clean
from bsgplan.sizing import named_size_field, size_field
from bsgplan.sizing.charge import REACH, edge_fluxes

DATA = Path(__file__).resolve().parent.parent / "data" / "rectangles.npz"
SPANS = ((-0.9, 0.0), (0.0, 0.9), (-0.6, 0.6))
INNER, WALL = 0.6, 1.0
WIDTH = 0.35
SLACK = 1.8
"""A regular patch takes up a charge of 12 ln(1.16) by sizes 16 % off (docs/theory, elastic slack)."""

# log h, and its gradient
FIELDS = {
    "exponential": (lambda x, _: 0.8 * x, lambda x, y: (0.8 + 0 * x, 0 * y)),
    "transition": (
        lambda x, _: 1.2 * np.tanh(x / WIDTH),
        lambda x, y: (1.2 / WIDTH / np.cosh(x / WIDTH) ** 2, 0 * y),
    ),
    "bump": (lambda x, y: -(x**2 + y**2) / 2, lambda x, y: (-x, -y)),
    "harmonic": (lambda x, y: (x**2 - y**2) / 2, lambda x, y: (x, -y)),
}


@cache
def meshes(name):
    with np.load(DATA) as stored:
        return [clean(stored[f"{name}_{k}_points"], stored[f"{name}_{k}_triangles"]).mesh for k in range(3)]


def around(span):
    """Seven spans near one: pairs of valence 5 and 7 that a side parts count as a charge."""
    return [(span[0] + move, span[1] + 0.7 * move) for move in np.linspace(-0.03, 0.03, 7)]


def charge(name, span, height, *, through_walls):
    """The closed form -(3/pi) flux, by the midpoint rule on the four sides."""
    gradient, share = FIELDS[name][1], (np.arange(4000) + 0.5) / 4000
    y, x = height * (2 * share - 1), span[0] + (span[1] - span[0]) * share
    right, left = (gradient(side + 0 * y, y)[0].mean() for side in (span[1], span[0]))
    upper, lower = (gradient(x, side + 0 * x)[1].mean() for side in (height, -height))
    cuts, walls = (right - left) * 2 * height, (upper - lower) * (span[1] - span[0])
    return -3 / np.pi * (cuts + through_walls * walls)


def inside(places, span, height):
    x, y = places.T
    return (span[0] < x) & (x < span[1]) & (np.abs(y) <= height)


@pytest.mark.parametrize("span", SPANS)
@pytest.mark.parametrize("name", FIELDS)
def test_the_irregular_vertices_inside_a_rectangle_are_its_charge(name, span):
    expected = np.mean([charge(name, s, INNER, through_walls=True) for s in around(span)])
    counted = [
        mesh.vertex_irregularity[inside(mesh.points, s, INNER)].sum()
        for mesh in meshes(name)
        for s in around(span)
    ]
    assert np.mean(counted) == pytest.approx(expected, abs=SLACK)


@pytest.mark.parametrize("span", SPANS)
@pytest.mark.parametrize("name", FIELDS)
def test_from_wall_to_wall_the_cuts_alone_tell_the_sum(name, span):
    expected = np.mean([charge(name, s, WALL, through_walls=False) for s in around(span)])
    counted = [
        mesh.vertex_irregularity[inside(mesh.points, s, WALL)].sum()
        for mesh in meshes(name)
        for s in around(span)
    ]
    assert np.mean(counted) == pytest.approx(expected, abs=1.0)


@pytest.mark.parametrize("name", ["transition", "harmonic"])
def test_without_the_term_of_the_walls_the_sum_would_be_wrong(name):
    """The tests above can fail: the flux that they tell apart is larger than what they allow."""
    span, height = (SPANS[0], INNER) if name == "transition" else (SPANS[2], WALL)
    whole = charge(name, span, height, through_walls=True)
    assert abs(whole - charge(name, span, WALL, through_walls=False)) > 2


@pytest.mark.parametrize("name", FIELDS)
def test_the_budget_read_off_a_mesh_is_the_charge_of_the_rectangle(name):
    fluxes = [edge_fluxes(size_field(mesh)).sum(axis=1) for mesh in meshes(name)]
    for span in SPANS:
        expected = np.mean([charge(name, s, INNER, through_walls=True) for s in around(span)])
        budgets = [
            flux[inside(mesh.centroids, s, INNER)].sum()
            for mesh, flux in zip(meshes(name), fluxes, strict=True)
            for s in around(span)
        ]
        assert np.mean(budgets) == pytest.approx(expected, abs=0.5)


@pytest.mark.parametrize("name", FIELDS)
def test_the_budget_of_a_formula_is_its_charge(name):
    """Sizes at the vertices by formula, calibrated to the mesh; smoothing and jagged sides are left."""
    mesh = meshes(name)[0]
    log_h = FIELDS[name][0](*mesh.points.T)
    scale = np.exp(np.mean(size_field(mesh).log_h - log_h))
    flux = edge_fluxes(named_size_field(mesh, scale * np.exp(log_h), "h")).sum(axis=1)
    for span in SPANS:
        expected = np.mean([charge(name, s, INNER, through_walls=True) for s in around(span)])
        budget = np.mean([flux[inside(mesh.centroids, s, INNER)].sum() for s in around(span)])
        assert budget == pytest.approx(expected, abs=0.3)


def test_the_smoothing_is_far_under_the_length_of_the_transition():
    """95 % of the change lie within 3.7 WIDTH, and 3 local sizes are under an eighth of it."""
    for mesh in meshes("transition"):
        is_middle = np.abs(mesh.centroids[:, 0]) < 0.05
        assert REACH * size_field(mesh).triangle_h[is_middle].mean() < 3.7 * WIDTH / 8
