"""Profiles: ordered, finite, weight kept, counts those of contours drawn one by one."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import reference
from hypothesis import given
from hypothesis import strategies as st
from predicates import assert_is_profile
from strategies import disc, hilly, jittered, meshes

from bsgplan.arrays import Floats
from bsgplan.io import read
from bsgplan.mesh import Mesh
from bsgplan.regions import Profile, Region, Regions, find_regions
from bsgplan.regions.profile import profiles
from bsgplan.sizing import SizeField, size_field

CASES = Path(__file__).parents[2] / "cases"


def layers_of_bins(profile: Profile) -> Floats:
    """The layers dT in each bin, read back from stations at ends and middles."""
    ends = [0.0]
    for middle in profile.depths[1:-1]:
        ends.append(2 * middle - ends[-1])
    return np.diff(ends)


def alone(mesh: Mesh) -> np.ndarray:
    return np.zeros(mesh.n_triangles, dtype=np.int64)


@given(hilly())
def test_a_profile_is_ordered_and_keeps_the_weight(case: tuple[Mesh, Floats]) -> None:
    """2 sum(f dT) over the bins is the number of triangles, by Eq. 15 of elements."""
    mesh, log_h = case
    size = SizeField(mesh, np.exp(log_h))
    (profile,) = profiles(size, alone(mesh))
    assert_is_profile(profile)
    total = 2 * (profile.counts[1:-1] * layers_of_bins(profile)).sum()
    assert total == pytest.approx(size.expected_triangles, rel=1e-6)


@given(meshes(), st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_profiles_of_any_labels_are_profiles(mesh: Mesh, n: int, seed: int) -> None:
    label = np.random.default_rng(seed).integers(0, n, mesh.n_triangles)
    label = np.unique(label, return_inverse=True)[1].astype(np.int64)
    for profile in profiles(size_field(mesh), label):
        assert_is_profile(profile)


@pytest.mark.parametrize("n_triangles", [1, 2])
@pytest.mark.parametrize("h", [[1.0, 1, 1, 1], [1.0, 1, 1, 1.001], [0.01, 1, 1, 1], [0.5, 2, 0.5, 2]])
def test_profiles_of_one_and_two_triangles_are_profiles(n_triangles: int, h: list[float]) -> None:
    points = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])[: n_triangles + 2]
    mesh = Mesh(points, np.array([[0, 1, 2], [0, 2, 3]])[:n_triangles])
    assert_is_profile(profiles(SizeField(mesh, np.array(h)[: n_triangles + 2]), alone(mesh))[0])


@pytest.mark.parametrize("h", [1.0, 0.3, 1e-4])
@pytest.mark.parametrize("mesh", [disc(6), jittered(13, 11, 2713)])
def test_a_size_without_contours_has_a_profile(mesh: Mesh, h: float) -> None:
    assert_is_profile(profiles(SizeField(mesh, np.full(mesh.n_points, h)), alone(mesh))[0])


def test_a_named_size_far_below_the_edges_has_a_profile() -> None:
    """Its few triangles do not reach every bin of equal weight: empty bins are drawn into others."""
    mesh = jittered(4, 4, 40099)
    h = np.where(np.arange(mesh.n_points) == 5, 0.01, 0.3)
    assert_is_profile(profiles(SizeField(mesh, h), alone(mesh))[0])


def test_a_flat_piece_beside_a_slope_has_a_profile() -> None:
    mesh = jittered(30, 6, 11027)
    h = np.exp(-0.2 * np.maximum(mesh.points[:, 0] - 14, 0))
    assert_is_profile(profiles(SizeField(mesh, h), alone(mesh))[0])


def strip(length: int, height: int, fine: float, coarse: float) -> SizeField:
    """A rectangle of small triangles with log h linear along it, the height 1."""
    mesh = jittered(length, height + 1, 7603)
    scaled = Mesh(mesh.points / height, mesh.triangles)
    x = scaled.points[:, 0] / scaled.points[:, 0].max()
    return SizeField(scaled, np.exp((1 - x) * np.log(1 / fine) + x * np.log(1 / coarse)))


def test_a_rectangle_with_linear_log_size_has_the_counts_of_its_height() -> None:
    """The paper's transition in closed form: 28 to 4, front by front 1/h, layers 2/sqrt(3) L <1/h>."""
    length, height = 34, 50
    size = strip(length, height, 28, 4)
    (profile,) = profiles(size, alone(size.mesh))
    width = (length - 1) / height
    layers = 2 / np.sqrt(3) * width * 24 / np.log(7)
    assert profile.layers == pytest.approx(layers, rel=0.03)
    assert profile.fine_elements == pytest.approx(28, rel=0.05)
    assert profile.coarse_elements == pytest.approx(4, abs=0.5)
    assert profile.counts[1:-1] == pytest.approx(np.exp(-profile.levels[1:-1]), rel=0.05)
    assert profile.lengths == pytest.approx(np.ones(len(profile.lengths)), rel=0.05)
    assert profile.positions[-1] == pytest.approx(width, rel=0.03)


def test_rings_of_size_proportional_to_the_radius_all_have_the_same_count() -> None:
    mesh = jittered(81, 81, 5501)
    radius, cells = (np.hypot(*(p - 40).T) for p in (mesh.points, mesh.centroids))
    size = SizeField(mesh, 2 * np.pi / 24 * np.maximum(radius, 1.0))
    profile = profiles(size, np.where((cells > 10) & (cells < 40), 0, 1).astype(np.int64))[0]
    assert profile.counts[2:-2] == pytest.approx(
        np.full(len(profile.counts) - 4, 24), rel=0.06
    )  # ends are ragged
    assert profile.layers == pytest.approx(24 / (2 * np.pi) * np.log(4) * 2 / np.sqrt(3), rel=0.05)


def contour_deviations(regions: Regions, region: Region) -> Floats:
    """Counts of the bins inside a profile over the mean of ds/h along five contours of each, less 1.

    Left out: the stations at the ends, and the first and last bin, which are shortened or absorbed.
    """
    mesh, profile, log_h = regions.size.mesh, region.profile, regions.size.log_h
    triangles = mesh.triangles[region.triangles]
    low, high = log_h[triangles].min(axis=1), log_h[triangles].max(axis=1)
    edges = [profile.levels[0]]
    for middle in profile.levels[1:-1]:
        edges.append(2 * middle - edges[-1])
    drawn = []
    for bottom, top in pairwise(edges[1:-1]):
        levels = bottom + (top - bottom) * (np.arange(5) + 0.5) / 5
        cut = [triangles[(low < u) & (high >= u)].tolist() for u in levels]
        pairs = zip(cut, levels, strict=True)
        drawn.append(np.mean([reference.contour_elements(mesh.points, t, log_h, u) for t, u in pairs]))
    return profile.counts[2:-2] / np.array(drawn) - 1


def assert_fronts_are_contours(regions: Regions, least: int) -> None:
    """Within 10 % in every bin of every transition of so many triangles, without bias."""
    large = [r for r in regions if r.kind == "transition" and r.n_triangles >= least]
    assert large
    for region in large:
        deviations = contour_deviations(regions, region)
        assert len(deviations) >= 6
        assert np.abs(deviations).max() < 0.10
        assert abs(deviations.mean()) < 0.01


@pytest.mark.parametrize("name", ["rectangle", "annulus"])
def test_fronts_of_cases_are_their_contours(name: str) -> None:
    mesh = read(CASES / name / "mesh.msh").mesh
    assert_fronts_are_contours(find_regions(size_field(mesh)), 200)


@pytest.mark.parametrize(
    ("name", "least"),
    [
        ("mesh_NACA0012_inv.su2", 1000),
        ("columbia_plume_02_normal.msh", 1000),
        ("bahamas_bight_of_abaco.fort.14", 300),
    ],
)
def test_fronts_of_real_meshes_are_their_contours(shared: Path, name: str, least: int) -> None:
    assert_fronts_are_contours(find_regions(size_field(read(shared / "meshes" / name).mesh)), least)


def test_annulus_is_one_ring_transition_of_48_elements() -> None:
    """H = (2 pi / 48) r: every front has 48; the noise of a generator's edges adds some 6 %.

    The mean within 8 %, single bins within 15 %; layers 48 / (2 pi) ln 20 2/sqrt(3) = 26.4.
    """
    regions = find_regions(size_field(read(CASES / "annulus" / "mesh.msh").mesh))
    assert [(r.kind, r.is_closed, r.is_monotone) for r in regions] == [("transition", True, True)]
    profile = regions[0].profile
    assert profile.counts.mean() == pytest.approx(48, rel=0.05)
    assert profile.counts == pytest.approx(np.full(len(profile.counts), 48), rel=0.12)
    assert profile.layers == pytest.approx(26.4, rel=0.05)


def test_rectangle_case_has_the_counts_of_the_paper_automatically() -> None:
    """28 to 4 elements in 10 to 11 fronts (10.4 by area), within 15 %."""
    regions = find_regions(size_field(read(CASES / "rectangle" / "mesh.msh").mesh))
    (transition,) = (r for r in regions if r.kind == "transition")
    profile = transition.profile
    assert profile.fine_elements == pytest.approx(28, rel=0.15)
    assert profile.coarse_elements == pytest.approx(4, rel=0.15)
    assert profile.fronts == pytest.approx(10.4, rel=0.15)
    assert not transition.is_closed


def test_square_case_is_one_uniform_zone() -> None:
    regions = find_regions(size_field(read(CASES / "square" / "mesh.msh").mesh))
    assert [r.kind for r in regions] == ["uniform"]


def test_the_fronts_of_a_region_sweep_its_area() -> None:
    """Positions and lengths describe the region's own shape: the integral of L dx is its area."""
    for name in ("rectangle", "annulus", "islands"):
        mesh = read(CASES / name / "mesh.msh").mesh
        for region in find_regions(size_field(mesh)):
            profile = region.profile
            swept = (np.diff(profile.positions) * (profile.lengths[1:] + profile.lengths[:-1]) / 2).sum()
            assert swept == pytest.approx(region.area, rel=0.06)
