"""Derivatives against differences, relaxation downhill, location against trying every triangle."""

from __future__ import annotations

from itertools import product

import domains
import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from probes import probe

from bsgplan.blocks.corners import find_corners
from bsgplan.blocks.curve_places import CurvePlaces, side_arcs
from bsgplan.blocks.domain import domain_of
from bsgplan.blocks.kernel import bend, energy, relax, size_at
from bsgplan.blocks.kernel.exchange import load, unload
from bsgplan.blocks.kernel.state import BEND, POWER, SIZE, State
from bsgplan.blocks.kernel.sweeps import relax_all, renew
from bsgplan.blocks.kernel.walk import locate
from bsgplan.blocks.kinds import CORNER, INTERIOR, SLIDING
from bsgplan.blocks.lack import POOR, merit, qualities
from bsgplan.blocks.placed import place
from bsgplan.blocks.smooth import smooth
from bsgplan.mesh import Mesh
from bsgplan.mesh.irregularity import fitted_boundary_irregularity
from bsgplan.mesh.quality import angles

HOLED = domain_of(
    domains.polygon_mesh(shapely.box(0, 0, 5, 4).difference(shapely.Point(2, 2).buffer(1)), 0.5, 5)
)
derivatives, triangle_energy = probe(relax._derivatives), probe(energy.triangle_energy)
place_on_curve, arcs_of_side = probe(size_at.place_on_curve), probe(bend.side_arcs)

NOWHERE, STRAIGHT = np.zeros(HOLED.n_points, bool), np.zeros(HOLED.n_points)


@pytest.mark.parametrize("power", [1.0, 2.0, 8.0])
def test_derivatives_are_those_of_differences(power: float) -> None:
    """Gradient and Hessian of quality and size, upright and inverted, by central differences."""
    state = load(HOLED, place(HOLED, NOWHERE, STRAIGHT), np.full(HOLED.n_points, np.log(0.1)))
    state.scalar[POWER], state.scalar[BEND], state.scalar[SIZE] = power, 0.0, 0.7
    random = np.random.default_rng(31)
    for _ in range(40):
        t = int(random.integers(len(HOLED.triangles)))
        v = int(state.triangle[t, random.integers(3)])
        at = state.point[v].copy()
        state.point[v] += random.uniform(-0.1, 0.1, 2)
        exact = np.array(derivatives(state, t, v))
        step = 1e-5
        near = _energies(state, t, v, step)
        gradient = [(near[1, 0] - near[-1, 0]) / (2 * step), (near[0, 1] - near[0, -1]) / (2 * step)]
        hessian = [
            (near[1, 0] - 2 * near[0, 0] + near[-1, 0]) / step**2,
            (near[1, 1] - near[1, -1] - near[-1, 1] + near[-1, -1]) / (4 * step**2),
            (near[0, 1] - 2 * near[0, 0] + near[0, -1]) / step**2,
        ]
        assert exact[:2] == pytest.approx(gradient, rel=1e-4, abs=1e-4 * np.abs(gradient).max())
        assert exact[2:] == pytest.approx(hessian, rel=1e-3, abs=2e-3 * np.abs(hessian).max() + 1e-3)
        state.point[v] = at


def _energies(state: State, t: int, v: int, step: float) -> dict[tuple[int, int], float]:
    """Energies of triangle t with vertex v moved by (i, j) steps, i and j -1, 0 or 1."""
    here, result = state.point[v].copy(), {}
    for i, j in product((-1, 0, 1), repeat=2):
        state.point[v] = here + step * np.array([i, j])
        result[i, j] = float(triangle_energy(state, t))
    state.point[v] = here
    return result


def test_goals_on_the_boundary_suit_the_angles_that_the_mesh_has() -> None:
    """One triangle for 60 degrees, wherever vertices lie on their curves: the twin counts fitted ones so."""
    is_corner, turning = find_corners(HOLED, np.full(HOLED.n_points, 0.1))
    start = place(HOLED, is_corner, turning)
    mesh = unload(load(HOLED, start, np.full(HOLED.n_points, np.log(0.4))))  # curves turn fast for such edges
    twin = Mesh(mesh.points, mesh.triangles)
    fitted = fitted_boundary_irregularity(twin.topology, angles(twin.corner_edge_lengths))
    slides, fixed = mesh.kinds == SLIDING, mesh.kinds == CORNER
    assert slides.sum() > 20
    assert fixed.sum() == 4
    assert np.array_equal((mesh.topology.valence - mesh.goals)[slides], fitted[slides])
    assert mesh.goals[fixed] == pytest.approx(np.full(4, 2.5))
    assert (mesh.goals[mesh.kinds == INTERIOR] == 6).all()


def test_relaxation_only_lowers_the_energy() -> None:
    """From a tangled start too; no triangle is inverted that was not."""
    random = np.random.default_rng(32)
    start = place(HOLED, NOWHERE, STRAIGHT)
    state = load(HOLED, start, np.full(HOLED.n_points, np.log(0.1)))
    is_free = ~HOLED.is_boundary
    state.point[: HOLED.n_points][is_free] += random.uniform(-0.06, 0.06, (is_free.sum(), 2))
    energies = [renew(state)]
    inverted = [np.count_nonzero(qualities(unload(state)) <= 0)]
    for _ in range(6):
        relax_all(state, 2)
        energies.append(renew(state))
        inverted.append(np.count_nonzero(qualities(unload(state)) <= 0))
    assert (np.diff(energies) <= 1e-9).all()
    assert (np.diff(inverted) <= 0).all()
    assert inverted[0] > 0 == inverted[-1]


@given(st.integers(0, 2**32 - 1))
def test_smoothing_never_lowers_the_merit(seed: int) -> None:
    """Whatever the start and the sizes; where nothing is poor, nothing becomes so. Nodes stay on curves."""
    random = np.random.default_rng(seed)
    mesh = place(HOLED, NOWHERE, STRAIGHT)
    moved = mesh.points + np.where(
        HOLED.is_boundary[:, None], 0.0, random.uniform(-0.05, 0.05, mesh.points.shape)
    )
    start = load(HOLED, mesh, STRAIGHT)
    start.point[: HOLED.n_points] = moved
    start = unload(start)
    result = smooth(HOLED, start, np.log(0.1) + random.uniform(-2, 2) * HOLED.points[:, 0])
    assert merit(result) >= merit(start)
    assert qualities(result).min() >= min(qualities(start).min(), POOR)
    on = HOLED.lines.nodes
    places = CurvePlaces(HOLED, STRAIGHT)
    assert places.points(result.curves[on], result.arcs[on]) == pytest.approx(result.points[on], abs=1e-12)


@given(st.integers(0, 2**32 - 1))
def test_location_is_that_of_trying_every_triangle(seed: int) -> None:
    """Points inside, from any hint whose way is not barred by the hole: values of a linear function."""
    random = np.random.default_rng(seed)
    chosen = random.integers(len(HOLED.triangles), size=20)
    shares = random.dirichlet([1, 1, 1], 20)
    where = np.einsum("nc,ncx->nx", shares, HOLED.points[HOLED.triangles[chosen, :3]])
    hints = np.where(random.random(20) < 0.5, chosen, HOLED.triangles[chosen, 3:].max(axis=1))
    found, own_shares = locate(HOLED.points, HOLED.triangles, where, hints)
    back = np.einsum("nc,ncx->nx", own_shares, HOLED.points[HOLED.triangles[found, :3]])
    assert back == pytest.approx(where, abs=1e-9)
    assert (own_shares >= 0).all()
    assert own_shares.sum(axis=1) == pytest.approx(np.ones(20))


@given(st.integers(0, 2**32 - 1))
def test_compiled_places_on_curves_are_those_of_numpy(seed: int) -> None:
    """Points and sizes at arc lengths, rounds included; arcs of sides."""
    random = np.random.default_rng(seed)
    log_size = random.uniform(-1, 1, HOLED.n_points)
    mesh = place(HOLED, NOWHERE, STRAIGHT)
    state = load(HOLED, mesh, log_size)
    places = CurvePlaces(HOLED, log_size)
    v = int(np.flatnonzero(mesh.kinds == SLIDING)[0])
    for c in range(len(HOLED.curves)):
        arc = float(random.uniform(-0.9, 1.9) * HOLED.curve_lengths[c])
        place_on_curve(state, v, c, arc)
        assert state.point[v] == pytest.approx(places.points(np.array([c]), np.array([arc]))[0], abs=1e-12)
        inside = abs(arc) % HOLED.curve_lengths[c]
        metric = places.metric(np.array([c]), np.array([inside]))
        assert places.arc_at(np.array([c]), metric) == pytest.approx([inside], abs=1e-9)
    triangle, side = np.nonzero(mesh.codes >= 0)
    curve, start, end = side_arcs(HOLED, mesh, triangle, side)
    own = [arcs_of_side(state, int(t), int(s)) for t, s in zip(triangle, side, strict=True)]
    state_less = np.array(own)
    keep = ~(mesh.triangles[triangle] == v).any(axis=1)  # v has been moved
    assert state_less[keep] == pytest.approx(np.column_stack([curve, start, end])[keep])
