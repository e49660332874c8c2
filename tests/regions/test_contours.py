"""Block fronts as contours: by hand, against closed forms, on cases."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from bsgplan.io import read
from bsgplan.mesh import Mesh
from bsgplan.regions import Regions, find_regions, measure_regions
from bsgplan.regions.contours import (
    contour_segments,
    front_coordinate,
    front_levels,
    front_lines,
    vertex_charges,
)
from bsgplan.regions.region import UNIFORM
from bsgplan.sizing import SizeField, size_field

CASES = Path(__file__).parents[2] / "cases"


def grid(n: int, m: int) -> Mesh:
    """Two triangles in each cell of n x m squares of edge 1."""
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(m + 1.0), indexing="ij")
    corner = (np.arange(n)[:, None] * (m + 1) + np.arange(m)).ravel()
    a, b, c, d = corner, corner + m + 1, corner + m + 2, corner + 1
    return Mesh(
        np.column_stack([x.ravel(), y.ravel()]),
        np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])]),
    )


def ring(n_around: int, radii: np.ndarray) -> Mesh:
    """A ring of triangles between circles."""
    angle = np.arange(n_around) * (2 * np.pi / n_around)
    points = np.concatenate([r * np.column_stack([np.cos(angle), np.sin(angle)]) for r in radii])
    i, k = (part.ravel() for part in np.meshgrid(np.arange(n_around), np.arange(len(radii) - 1)))
    a, b = k * n_around + i, k * n_around + (i + 1) % n_around
    triangles = [
        np.column_stack([a, a + n_around, b + n_around]),
        np.column_stack([a, b + n_around, b]),
    ]
    return Mesh(points, np.concatenate(triangles))


def whole(size: SizeField) -> Regions:
    """One region of all triangles."""
    return measure_regions(size, np.zeros(size.mesh.n_triangles, dtype=np.int64), np.array([False]))


def lengths_by_level(segments: np.ndarray, level: np.ndarray, n: int) -> np.ndarray:
    return np.bincount(level, np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1), n)


@pytest.fixture(scope="module")
def rectangle() -> Regions:
    return find_regions(size_field(read(CASES / "rectangle" / "mesh.msh").mesh))


def test_one_triangle_is_cut_twice_and_told_by_the_level_it_was_given():
    corners = np.array([[[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]]])
    segments, level = contour_segments(corners, np.array([[0.0, 3.0, 3.0]]), np.array([2.0, 9.0, 1.0, -1.0]))
    assert level.tolist() == [2, 0]
    assert sorted(map(tuple, segments[0].tolist())) == [(0.0, 1.0), (1.0, 0.0)]
    assert sorted(map(tuple, segments[1].tolist())) == [(0.0, 2.0), (2.0, 0.0)]


def test_a_contour_through_vertices_is_drawn_once():
    size = SizeField(grid(6, 4), np.exp(grid(6, 4).points[:, 0]))
    segments, _, level = front_lines(whole(size), {0: np.array([3.0])})
    assert len(segments) == 4
    assert lengths_by_level(segments, level, 1) == pytest.approx([4.0])


def test_contours_of_a_rectangle_are_as_long_as_it_is_high():
    mesh = grid(12, 5)
    levels = np.array([0.3, 1.7, 2.2, 3.9])
    segments, _, level = front_lines(whole(SizeField(mesh, np.exp(mesh.points[:, 0] / 3))), {0: levels})
    assert lengths_by_level(segments, level, 4) == pytest.approx([5.0] * 4)
    assert segments[..., 0] == pytest.approx(np.repeat(3 * levels[level], 2).reshape(-1, 2))


def test_contours_of_an_annulus_are_circles():
    mesh = ring(60, np.geomspace(1.0, 5.0, 30))
    radius = np.linalg.norm(mesh.points, axis=1)
    levels = np.log([1.5, 2.0, 4.5])
    segments, _, level = front_lines(whole(SizeField(mesh, radius)), {0: levels})
    assert lengths_by_level(segments, level, 3) == pytest.approx(2 * np.pi * np.exp(levels), rel=0.01)


def test_front_lines_lie_on_their_level_and_in_their_region(rectangle: Regions):
    region = next(r for r in rectangle if r.kind != UNIFORM)
    mesh, log_h = rectangle.size.mesh, rectangle.size.log_h
    levels = front_levels(region.profile, 5)
    own = mesh.triangles[region.triangles]
    with_value = np.concatenate([mesh.points[own], log_h[own][..., None]], axis=2)
    lifted, told = contour_segments(with_value, log_h[own], levels)
    assert lifted[..., 2] == pytest.approx(np.repeat(levels[told], 2).reshape(-1, 2))
    flat, _, level = front_lines(rectangle, {region.id: levels})
    assert np.array_equal(flat, lifted[..., :2])
    assert np.array_equal(level, told)
    assert len(set(level.tolist())) >= 3


def test_contours_of_the_annulus_have_the_elements_of_its_profile():
    regions = find_regions(size_field(read(CASES / "annulus" / "mesh.msh").mesh))
    assert len(regions) == 1
    profile = regions[0].profile
    depths = np.linspace(0.1, 0.9, 5) * profile.layers
    levels = profile.levels_at(depths)
    elements = lengths_by_level(*front_lines(regions, {0: levels})[::2], 5) / np.exp(levels)
    assert elements == pytest.approx(profile.counts_at(depths), rel=0.15)
    assert elements.mean() == pytest.approx(profile.counts_at(depths).mean(), rel=0.1)


def test_depth_runs_over_the_block_layers_and_is_0_in_uniform_zones(rectangle: Regions):
    at_points, at_triangles = front_coordinate(rectangle, 4.0)
    size, mesh = rectangle.size, rectangle.size.mesh
    assert {r.kind for r in rectangle} == {"uniform", "transition"}
    for region in rectangle:
        own = at_triangles[region.triangles]
        if region.kind == UNIFORM:
            assert (own == 0).all()
            continue
        assert 0 <= own.min() < 0.2 * own.max()
        assert 0.8 * region.profile.layers / 4 < own.max() <= region.profile.layers / 4
        corners = np.unique(mesh.triangles[region.triangles])
        order = np.argsort(size.log_h[corners])
        assert (np.diff(at_points[corners][order]) >= 0).all()


def test_vertex_charges_add_up_to_the_regions(rectangle: Regions):
    assert vertex_charges(rectangle).sum() == pytest.approx(rectangle.charge)
    label = np.where(rectangle.label == 1, 0, -1)
    part = measure_regions(rectangle.size, label, np.array([False]))
    assert vertex_charges(part).sum() == pytest.approx(part.charge)
