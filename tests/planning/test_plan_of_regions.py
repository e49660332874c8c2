"""Plans: sums that add up, block counts near triangles over block size, drivers with closed forms."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from predicates import assert_is_plan
from strategies import hilly, jittered, meshes, permuted

from bsgplan.arrays import Floats
from bsgplan.errors import InvalidOption, NoPatternFits
from bsgplan.io import read, read_lonlat
from bsgplan.mesh import Mesh
from bsgplan.planning import OBJECTIVES, Plan, check_block_size, estimate
from bsgplan.planning.inverse import need, within
from bsgplan.planning.totals import GRADIENT_LIMIT, drivers, least_blocks
from bsgplan.regions import Regions, find_regions
from bsgplan.sizing import SizeField, size_field

CASES = Path(__file__).parents[2] / "cases"
NAMES = ("aerofoil", "annulus", "islands", "plate", "rectangle", "shoreline", "square")
REAL = (
    "bahamas_bight_of_abaco.fort.14",
    "mesh_NACA0012_inv.su2",
    "columbia_plume_02_normal.msh",
    "notched_plate_phasefield.msh",
)
WNAT = "wnat_test_18578.fort.14"


@cache
def regions_of(path: Path) -> Regions:
    reader = read_lonlat if path.name == WNAT else read
    return find_regions(size_field(reader(path).mesh))


def floor_of(size: SizeField) -> Callable[[int], int]:
    return lambda n: least_blocks(size, n, GRADIENT_LIMIT)


def planner(size: SizeField) -> Callable[[int], Plan]:
    return lambda n: estimate(find_regions(size, tris_per_block=n), tris_per_block=n)


@settings(max_examples=25)
@given(hilly(), st.sampled_from([1, 4, 16, 25]), st.sampled_from(sorted(OBJECTIVES)))
def test_plans_of_hilly_sizes_are_plans(case: tuple[Mesh, Floats], n: int, objective: str) -> None:
    mesh, log_h = case
    regions = find_regions(SizeField(mesh, np.exp(log_h)), tris_per_block=n)
    assert_is_plan(estimate(regions, tris_per_block=n, objective=objective))


@settings(max_examples=25)
@given(meshes(), st.sampled_from([1, 4, 16]))
def test_plans_of_any_mesh_are_plans(mesh: Mesh, n: int) -> None:
    plan = estimate(find_regions(size_field(mesh), tris_per_block=n), tris_per_block=n)
    assert_is_plan(plan)
    assert plan.drivers.blocks_by_count == pytest.approx(mesh.n_triangles / n)


@pytest.mark.parametrize("seed", [271, 99721])
def test_a_plan_does_not_depend_on_the_order_of_points_and_triangles(seed: int) -> None:
    mesh = jittered(40, 26, 12577)
    h = np.exp(-1.5 * np.exp(-((mesh.points[:, 0] - 12) ** 2 + (mesh.points[:, 1] - 9) ** 2) / 80))
    other, points, _ = permuted(mesh, seed)
    one, two = (estimate(find_regions(s)) for s in (SizeField(mesh, h), SizeField(other, h[points])))
    assert [str(p.chosen.pattern) for p in one.region_plans if p.chosen] == [
        str(p.chosen.pattern) for p in two.region_plans if p.chosen
    ]
    assert one.n_blocks == two.n_blocks


@pytest.mark.parametrize("name", NAMES)
def test_blocks_of_a_case_are_its_triangles_over_sixteen(name: str) -> None:
    """With the objective size, within 10 %."""
    regions = regions_of(CASES / name / "mesh.msh")
    plan = estimate(regions, objective="size")
    assert_is_plan(plan)
    assert plan.n_blocks == pytest.approx(regions.size.mesh.n_triangles / 16, rel=0.10)


@pytest.mark.parametrize("name", [*REAL, WNAT])
def test_blocks_of_a_real_mesh_are_its_triangles_over_sixteen(shared: Path, name: str) -> None:
    """With the objective size, within 10 %; limited regions counted."""
    regions = regions_of(shared / "meshes" / name)
    plan = estimate(regions, objective="size")
    assert_is_plan(plan)
    assert plan.n_blocks == pytest.approx(regions.size.mesh.n_triangles / 16, rel=0.10)


def test_the_western_north_atlantic_has_the_counts_of_the_paper(shared: Path) -> None:
    """Eq. 24: 18578 / 16 = 1161; as an upper limit 1.75 times the triangles at 64 a block: 508."""
    counted = drivers(regions_of(shared / "meshes" / WNAT))
    assert counted.blocks_by_count == pytest.approx(18578 / 16)
    assert int(counted.blocks_by_count) == 1161
    assert counted.paper_upper_limit.triangles == pytest.approx(32511.5)
    assert round(counted.paper_upper_limit.blocks) == 508


@pytest.mark.parametrize("name", ["islands", "rectangle", "plate"])
def test_blocks_limited_in_gradient_fall_with_the_limit_to_the_count(name: str) -> None:
    regions = regions_of(CASES / name / "mesh.msh")
    counts = [drivers(regions, gradient_limit=g).blocks_gradient_limited for g in (0.1, 0.3, 0.6, 1.2, 50)]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > counts[-1] == pytest.approx(drivers(regions).blocks_by_count, rel=1e-6)


@pytest.mark.parametrize("name", ["islands", "aerofoil", "square"])
def test_blocks_under_an_upper_limit_grow_as_the_ratio_falls(name: str) -> None:
    counted = drivers(regions_of(CASES / name / "mesh.msh"))
    found = {(u.ratio, u.tris_per_block): u for u in counted.blocks_upper_limit}
    assert set(found) == {(4, 16), (2, 16), (4, 64), (2, 64)}
    for n in (16, 64):
        assert found[2, n].blocks >= found[4, n].blocks >= counted.blocks_by_count * 16 / n * (1 - 1e-9)
    for limit in found.values():
        assert limit.blocks == pytest.approx(limit.triangles / limit.tris_per_block)


def test_the_gradient_bound_of_a_ring_has_its_closed_form() -> None:
    """|grad log h| = 1/r, so the integral is 2 pi ln 20, times sqrt(3) over (1/2)^2."""
    bound = drivers(regions_of(CASES / "annulus" / "mesh.msh")).blocks_gradient_bound
    assert bound == pytest.approx(np.sqrt(3) * 2 * np.pi * np.log(20) / 0.25, rel=0.1)


@pytest.mark.parametrize(("name", "chi"), [("square", 1), ("annulus", 0), ("islands", -4)])
def test_charge_and_boundary_charge_are_minus_six_chi(name: str, chi: int) -> None:
    counted = drivers(regions_of(CASES / name / "mesh.msh"))
    assert counted.charge + counted.boundary_charge == pytest.approx(-6 * chi)


@pytest.mark.parametrize(
    ("tris_per_block", "message"),
    [(20, "16 and 25"), (0, "1 and 4"), (-4, "under 1"), (2, "1 and 4"), (99, "81 and 100")],
)
def test_a_block_size_that_is_no_square_names_the_nearest_two(tris_per_block: int, message: str) -> None:
    with pytest.raises(InvalidOption, match=message):
        check_block_size(tris_per_block)
    with pytest.raises(InvalidOption, match=message):
        estimate(regions_of(CASES / "square" / "mesh.msh"), tris_per_block=tris_per_block)


@pytest.mark.parametrize("limit", [0.0, -1.0, float("nan"), float("inf")])
def test_a_gradient_limit_that_is_no_positive_number_is_refused(limit: float) -> None:
    with pytest.raises(InvalidOption, match="gradient limit"):
        estimate(regions_of(CASES / "square" / "mesh.msh"), gradient_limit=limit)


@pytest.mark.parametrize(("name", "n_blocks"), [("rectangle", 40), ("plate", 120), ("annulus", 60)])
def test_the_inverse_needs_at_most_what_was_asked_and_the_next_finer_needs_more(
    name: str, n_blocks: int
) -> None:
    size = regions_of(CASES / name / "mesh.msh").size
    plan_at = planner(size)
    plan = within(plan_at, floor_of(size), size.mesh.n_triangles, n_blocks)
    assert need(plan).n_blocks <= n_blocks
    side = round(np.sqrt(plan.tris_per_block))
    assert side > 1
    assert need(plan_at((side - 1) ** 2)).n_blocks > n_blocks


def test_more_blocks_than_triangles_allow_the_smallest_block() -> None:
    size = size_field(jittered(6, 5, 3907))
    assert within(planner(size), floor_of(size), size.mesh.n_triangles, 10_000).tris_per_block == 1


@pytest.mark.parametrize("name", ["islands", "annulus"])
def test_an_impossible_number_of_blocks_names_the_least_and_its_driver(name: str) -> None:
    size = regions_of(CASES / name / "mesh.msh").size
    with pytest.raises(NoPatternFits, match=r"with 3 blocks; the least is \d+, at \d+ .* forbids fewer"):
        within(planner(size), floor_of(size), size.mesh.n_triangles, 3)
    with pytest.raises(InvalidOption, match="under 1"):
        within(planner(size), floor_of(size), size.mesh.n_triangles, 0)


@pytest.mark.parametrize("name", ["rectangle", "plate"])
def test_the_least_number_of_blocks_that_is_named_is_granted(name: str) -> None:
    """Whatever is asked for: every refusal names the same least, and that many blocks have a plan."""
    size = regions_of(CASES / name / "mesh.msh").size

    def answer(n_blocks: int) -> Plan:
        return within(planner(size), floor_of(size), size.mesh.n_triangles, n_blocks)

    with pytest.raises(NoPatternFits) as refusal:
        answer(1)
    least = int(re.search(r"the least is (\d+)", str(refusal.value))[1])
    assert need(answer(least)).n_blocks == least
    for n_blocks in {2, least - 1} - {0, 1, least}:
        with pytest.raises(NoPatternFits, match=rf"the least is {least},"):
            answer(n_blocks)
