"""Sizes read on a thinned mesh are those of the whole: exact where linear, close where the mesh has noise."""

from __future__ import annotations

import numpy as np
import pytest

from bsgplan.errors import InvalidSize
from bsgplan.mesh.thinned import thinned
from bsgplan.sizing import named_size_field, size_field
from bsgplan.sizing.thinned import thin_named_size_field, thin_size_field, whole_size_field
from tests.strategies import jittered


def test_sizes_that_grow_evenly_stay_up_to_the_wall() -> None:
    mesh = jittered(50, 40, 7)
    thin = thinned(mesh)
    log_h = 0.02 * mesh.points[:, 0] - 0.03 * mesh.points[:, 1]
    size = thin_named_size_field(thin, np.exp(log_h), "even")
    assert size.source == "even"
    assert np.abs(size.log_h - log_h[thin.kept]).max() < 3e-3
    back = whole_size_field(thin, size)
    assert np.abs(back.log_h - back.log_h.mean() - log_h + log_h.mean()).max() < 5e-3


def test_one_size_stays_one_size() -> None:
    mesh = jittered(30, 30, 7)
    thin = thinned(mesh)
    assert thin_named_size_field(thin, np.full(mesh.n_triangles, 2.0), "two").h == pytest.approx(
        2.0, rel=1e-9
    )


def test_a_field_of_edges_expects_the_triangles_of_the_whole_mesh() -> None:
    mesh = jittered(50, 40, 5)
    thin = thinned(mesh)
    size = thin_size_field(thin)
    assert size.expected_triangles == pytest.approx(mesh.n_triangles)
    assert whole_size_field(thin, size).expected_triangles == pytest.approx(mesh.n_triangles)


def test_the_noise_of_a_mesh_is_read_as_on_the_whole() -> None:
    """On a mesh of one size: no more scatter is left than a half above that of the whole mesh."""
    mesh = jittered(80, 80, 6)
    thin = thinned(mesh)
    found, expected = thin_size_field(thin).log_h, size_field(mesh).log_h
    assert abs(np.mean(found) - np.mean(expected)) < 0.005
    for few, many in (
        (thin.mesh.topology.is_boundary, mesh.topology.is_boundary),
        (~thin.mesh.topology.is_boundary, ~mesh.topology.is_boundary),
    ):
        assert np.std(found[few]) < 1.5 * np.std(expected[many])


def test_a_waved_field_is_followed() -> None:
    """A wave of 30 edges passes, as on the whole mesh."""
    mesh = jittered(90, 60, 2)
    thin = thinned(mesh)
    h = np.exp(0.5 * np.sin(2 * np.pi * mesh.points[:, 0] / 30))
    expected = named_size_field(mesh, h, "waves").log_h[thin.kept]
    found = thin_named_size_field(thin, h, "waves").log_h
    assert np.abs(found - expected).max() < 0.03


def test_sizes_are_checked_as_on_the_whole_mesh() -> None:
    thin = thinned(jittered(9, 9, 1))
    with pytest.raises(InvalidSize, match="an edge length is positive"):
        thin_named_size_field(thin, np.zeros(thin.whole.n_points), "nothing")
    with pytest.raises(InvalidSize, match="give a scalar a point"):
        thin_named_size_field(thin, np.ones(3), "few")
