"""Limited size fields: Lipschitz, never larger, and close to a slow reference over straight distances."""

from __future__ import annotations

import numpy as np
import pytest
import reference
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import disc, hilly, jittered

from bsgplan.arrays import Floats
from bsgplan.mesh import Mesh
from bsgplan.sizing import SizeField
from bsgplan.sizing.counts import capped_triangles, gradient_limited_blocks
from bsgplan.sizing.limits import Links

SLOPE = st.sampled_from([0.05, 0.2, 0.6, 1.5])


@given(hilly(12), SLOPE)
def test_a_limited_size_is_lipschitz_along_every_edge_and_never_above_the_input(
    case: tuple[Mesh, Floats], slope: float
) -> None:
    mesh, log_h = case
    size = np.exp(log_h)
    limited = Links.of(mesh).limited(size, slope)
    i, j = mesh.topology.edges.T
    assert (limited <= size).all()
    assert (np.abs(limited[i] - limited[j]) <= slope * mesh.edge_lengths * (1 + 1e-12) + 1e-12).all()
    assert limited.min() == size.min()


@given(hilly(12), SLOPE)
def test_limiting_twice_changes_nothing(case: tuple[Mesh, Floats], slope: float) -> None:
    mesh, log_h = case
    once = Links.of(mesh).limited(np.exp(log_h), slope)
    assert Links.of(mesh).limited(once, slope) == pytest.approx(once, rel=1e-12)


@settings(max_examples=25)
@given(hilly(10), SLOPE)
def test_a_limited_size_is_close_to_the_one_over_straight_distances(
    case: tuple[Mesh, Floats], slope: float
) -> None:
    """Paths through a mesh are never shorter than straight; on jittered ones the worst is 23 % longer."""
    mesh, log_h = case
    size = np.exp(log_h)
    limited = Links.of(mesh).limited(size, slope)
    points, sizes = mesh.points.tolist(), size.tolist()
    slow = np.array(reference.limited_sizes(points, sizes, slope))
    assert (limited >= slow * (1 - 1e-12)).all()
    assert (limited <= np.array(reference.limited_sizes(points, sizes, 1.25 * slope)) * (1 + 1e-12)).all()
    assert limited.mean() <= 1.04 * slow.mean()


def test_a_cone_on_a_fine_disc_is_right_to_four_percent() -> None:
    mesh = disc(16)
    radius = np.hypot(*mesh.points.T)
    size = np.where(radius == 0, 0.01, 9.0)
    limited = Links.of(mesh).limited(size, 0.5) - 0.01
    assert (limited[radius > 0] / (0.5 * radius[radius > 0])).max() <= 1.04


def test_a_field_that_is_gentle_enough_passes_unchanged() -> None:
    mesh = jittered(9, 9, 40111)
    size = 1 + 0.1 * mesh.points[:, 0]
    assert np.array_equal(Links.of(mesh).limited(size, 0.11), size)


def test_a_limited_block_count_grows_with_the_bound_and_ends_at_the_count() -> None:
    mesh = disc(16)
    size = SizeField(mesh, 0.02 + 0.3 * np.hypot(*mesh.points.T))
    everything = np.ones(mesh.n_triangles, bool)
    counts = [
        gradient_limited_blocks(size, 4.0, slope, everything) for slope in (0.05, 0.1, 0.3, 0.6, 1.2, 9)
    ]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > 2 * counts[-1]
    assert counts[-1] == pytest.approx(size.expected_triangles / 16)


def test_a_cap_above_every_size_caps_nothing_and_half_the_size_has_four_times_the_triangles() -> None:
    mesh = disc(6)
    size = SizeField(mesh, np.full(mesh.n_points, 0.1))
    everything = np.ones(mesh.n_triangles, bool)
    cap = np.full(mesh.n_triangles, 0.2)
    assert capped_triangles(size, cap, everything) == pytest.approx(size.expected_triangles)
    assert capped_triangles(size, cap / 4, everything) == pytest.approx(4 * size.expected_triangles)


def test_a_diagonal_beside_an_edge_does_not_lengthen_it() -> None:
    """Round a vertex of valence 3 each edge of the rim also joins the tips of two triangles."""
    points = np.array([[0.0, 0.0], [4.0, 0.0], [2.0, 3.0], [2.0, 1.0]])
    mesh = Mesh(points, np.array([[0, 1, 3], [1, 2, 3], [2, 0, 3]]))
    limited = Links.of(mesh).limited(np.array([1.0, 10.0, 10.0, 10.0]), 0.5)
    assert limited == pytest.approx(1.0 + 0.5 * np.linalg.norm(points, axis=1))
