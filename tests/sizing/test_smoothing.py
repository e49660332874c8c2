"""Smoothers: linear fields pass unchanged up to the wall, noise does not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import disc, jittered, meshes

from bsgplan.mesh import Mesh
from bsgplan.sizing.diffusion import Diffusion, once
from bsgplan.sizing.smoothing import fit_edges, gradient_jumps, smooth

SLOPE = np.array([0.11, -0.07])


@given(meshes(), st.floats(-3, 3), st.floats(-3, 3))
def test_gradient_jumps_of_a_linear_field_are_zero_also_at_the_wall(mesh: Mesh, a: float, b: float) -> None:
    jumps = gradient_jumps(mesh) @ (a * mesh.points[:, 0] + b * mesh.points[:, 1] + 1.0)
    assert jumps == pytest.approx(np.zeros(len(jumps)), abs=1e-9 * (1 + abs(a) + abs(b)) * 9)


def test_gradient_jumps_of_a_roof_by_hand() -> None:
    """Two halves of the unit square, u = 1 at one corner off the diagonal: slope sqrt(2), edge sqrt(2)."""
    mesh = Mesh(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]), np.array([[0, 1, 2], [0, 2, 3]]))
    (jump,) = gradient_jumps(mesh) @ np.array([0.0, 1.0, 0.0, 0.0])
    assert abs(jump) == pytest.approx(2.0)


@pytest.mark.parametrize("reach", [0.0, 0.5, 1.0, 3.0])
@pytest.mark.parametrize("mesh", [jittered(14, 9, 5711), disc(7), jittered(3, 17, 8219, jitter=0.3)])
def test_smoothers_leave_a_linear_log_size_exactly_unchanged(mesh: Mesh, reach: float) -> None:
    linear = mesh.points @ SLOPE - 0.4
    middle = linear[mesh.topology.edges].mean(axis=1)
    assert smooth(mesh, linear, reach) == pytest.approx(linear, abs=1e-12)
    # the fit starts from means along the edges, which are not linear at the wall: solver tolerance remains
    fitted = fit_edges(mesh, middle, reach)
    assert fitted == pytest.approx(linear, abs=1e-3)


@given(meshes(), st.integers(-30, 30), st.integers(-30, 30))
def test_a_fit_is_the_linear_field_where_the_edges_are_linear(mesh: Mesh, a: int, b: int) -> None:
    """At least within the solver's tolerance in the norm of the residual, on any mesh with holes."""
    linear = (a * mesh.points[:, 0] + b * mesh.points[:, 1]) / 100
    fitted = fit_edges(mesh, linear[mesh.topology.edges].mean(axis=1), 0.5)
    spread = np.ptp(linear) + np.abs(linear).max()
    assert np.abs(fitted - linear).max() <= 0.01 * spread + 1e-12


def test_smoothing_quiets_noise_and_keeps_its_mean() -> None:
    mesh = jittered(20, 20, 90173)
    noise = np.random.default_rng(66107).normal(0, 0.1, mesh.n_points)
    result = smooth(mesh, noise, 1.0)
    assert result.std() < 0.5 * noise.std()
    assert result.mean() == pytest.approx(noise.mean(), abs=0.003)


def test_diffusion_keeps_constants_and_the_integral() -> None:
    mesh = disc(8)
    diffusion = Diffusion.over(mesh, np.full(mesh.n_triangles, 0.2))
    assert diffusion.filtered(np.full(mesh.n_points, 2.5), once) == pytest.approx(2.5)
    values = np.where(np.hypot(*mesh.points.T) < 0.3, 1.0, 0.0)
    area = np.zeros(mesh.n_points)
    np.add.at(area, mesh.triangles, mesh.areas[:, None] / 3)
    assert area @ diffusion.filtered(values, once) == pytest.approx(area @ values, rel=1e-3)
    assert diffusion.filtered(np.column_stack([values, values]), once).shape == (mesh.n_points, 2)
