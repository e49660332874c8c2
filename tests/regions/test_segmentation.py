"""Regions: a partition into connected pieces that does not depend on how the mesh is written."""

from __future__ import annotations

import numpy as np
import pytest
import reference
from hypothesis import given, settings
from hypothesis import strategies as st
from predicates import assert_is_segmentation
from strategies import disc, hilly, jittered, meshes, permuted

from bsgplan.arrays import Floats, Ints
from bsgplan.mesh import Mesh
from bsgplan.regions import Regions, find_regions, measure_regions
from bsgplan.sizing import SizeField, size_field

WIDE = jittered(46, 30, 81017)


def dunes(mesh: Mesh) -> Floats:
    """A smooth size on WIDE: two fine spots of unlike depth, a plateau at the right."""
    x, y = mesh.points.T
    first = 1.6 * np.exp(-((x - 9) ** 2 + (y - 11) ** 2) / 60)
    second = 1.2 * np.exp(-((x - 25.5) ** 2 + (y - 19.7) ** 2) / 50)
    return np.exp(0.004 * y - first - second)


def partition(label: Ints) -> set[frozenset[int]]:
    return {frozenset(np.flatnonzero(label == k).tolist()) for k in np.unique(label)}


@settings(max_examples=40)
@given(hilly(), st.sampled_from([1, 4, 16]))
def test_regions_of_a_hilly_size_are_a_segmentation(case: tuple[Mesh, Floats], tris_per_block: int) -> None:
    mesh, log_h = case
    assert_is_segmentation(find_regions(SizeField(mesh, np.exp(log_h)), tris_per_block=tris_per_block))


@settings(max_examples=40)
@given(meshes(), st.sampled_from([1, 16]))
def test_regions_of_any_mesh_are_a_segmentation(mesh: Mesh, tris_per_block: int) -> None:
    """Meshes with holes, pinches and pieces, read off their own edges."""
    assert_is_segmentation(find_regions(size_field(mesh), tris_per_block=tris_per_block))


@pytest.mark.parametrize("n_triangles", [1, 2])
def test_the_smallest_meshes_have_one_region(n_triangles: int) -> None:
    points = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])[: n_triangles + 2]
    mesh = Mesh(points, np.array([[0, 1, 2], [0, 2, 3]])[:n_triangles])
    regions = find_regions(size_field(mesh))
    assert_is_segmentation(regions)
    assert len(regions) == 1


@pytest.mark.parametrize("mesh", [disc(9), jittered(13, 11, 2713)])
def test_a_constant_size_is_one_uniform_zone(mesh: Mesh) -> None:
    regions = find_regions(SizeField(mesh, np.full(mesh.n_points, 0.3)), tris_per_block=4)
    assert [r.kind for r in regions] == ["uniform"]
    assert_is_segmentation(regions)


def test_two_fine_spots_are_in_two_transitions() -> None:
    regions = find_regions(SizeField(WIDE, dunes(WIDE) * 0.8), tris_per_block=4)
    spots = [np.hypot(*(WIDE.centroids - c).T).argmin() for c in ((9, 11), (25.5, 19.7))]
    first, second = (regions[int(regions.label[t])] for t in spots)
    assert first.id != second.id
    assert first.kind == second.kind == "transition"


@pytest.mark.parametrize("seed", [59, 6007, 90001])
def test_regions_do_not_depend_on_the_order_of_points_and_triangles(seed: int) -> None:
    plain = find_regions(SizeField(WIDE, dunes(WIDE)))
    other, points, cells = permuted(WIDE, seed)
    moved = find_regions(SizeField(other, dunes(WIDE)[points]))
    assert len(plain) > 2
    assert np.array_equal(moved.label, plain.label[cells])
    assert np.allclose([r.profile.layers for r in moved], [r.profile.layers for r in plain], rtol=1e-6)
    assert [(r.kind, r.is_closed, r.is_monotone) for r in moved] == [
        (r.kind, r.is_closed, r.is_monotone) for r in plain
    ]


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e5])
@pytest.mark.parametrize("angle", [0.0, 1.1])
def test_regions_do_not_depend_on_place_orientation_and_unit(scale: float, angle: float) -> None:
    plain = find_regions(SizeField(WIDE, dunes(WIDE)))
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    other = Mesh(scale * (WIDE.points @ turn.T + np.array([3.0, -70.0])), WIDE.triangles)
    moved = find_regions(SizeField(other, scale * dunes(WIDE)))
    assert partition(moved.label) == partition(plain.label)
    assert [r.charge for r in moved] == pytest.approx([r.charge for r in plain], abs=2e-3)
    for one, two in zip(moved, plain, strict=True):
        assert one.profile.counts == pytest.approx(two.profile.counts, rel=1e-6)
        assert one.profile.lengths == pytest.approx(scale * two.profile.lengths, rel=1e-6)


def spots(regions: Regions, k: int, persistence: float) -> tuple[int, int]:
    """Fine and coarse spots of one region by itself, by the slow flood."""
    mesh, own = regions.size.mesh, regions[k].triangles
    names = np.unique(mesh.triangles[own])
    number = {int(v): i for i, v in enumerate(names)}
    cells = [[number[v] for v in t] for t in mesh.triangles[own].tolist()]
    points = mesh.points[names].tolist()
    links = [(a, b, float(np.hypot(*(np.subtract(points[a], points[b]))))) for a, b in reference.edges(cells)]
    values = regions.size.log_h[names]
    low, high = (len(set(reference.basins(links, v.tolist(), persistence))) for v in (values, -values))
    return low, high


@settings(max_examples=25)
@given(hilly(14), st.sampled_from([0.1, 0.3]), st.integers(1, 3), st.integers(0, 2**32 - 1))
def test_monotone_means_one_fine_and_one_coarse_spot(
    case: tuple[Mesh, Floats], persistence: float, n_halves: int, seed: int
) -> None:
    """Found regions, and strips cut across the hills whatever their shape."""
    mesh, log_h = case
    size = SizeField(mesh, np.exp(log_h))
    direction = np.random.default_rng(seed).normal(size=2)
    along = mesh.centroids @ direction
    strips = np.searchsorted(np.quantile(along, np.arange(1, n_halves) / n_halves), along)
    strips = np.unique(strips, return_inverse=True)[1].astype(np.int64)
    n = int(strips.max()) + 1
    for regions in (
        find_regions(size, tris_per_block=4, persistence=persistence),
        measure_regions(size, strips, np.zeros(n, bool), persistence=persistence),
    ):
        for k, region in enumerate(regions):
            assert region.is_monotone == (spots(regions, k, persistence) == (1, 1))


def test_triangles_outside_a_drawn_region_belong_to_none() -> None:
    size = SizeField(WIDE, dunes(WIDE))
    label = np.where(WIDE.centroids[:, 0] < 20, 0, -1)
    regions = measure_regions(size, label, np.zeros(1, bool))
    assert len(regions) == 1
    assert regions[0].n_triangles == np.count_nonzero(label == 0)
    assert np.array_equal(regions.label, label)
    alone = measure_regions(size, np.where(label == 0, 0, 1), np.zeros(2, bool))
    assert regions[0].profile.counts == pytest.approx(alone[0].profile.counts)
    assert regions[0].charge == pytest.approx(alone[0].charge)
