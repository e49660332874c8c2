"""Golden tests: every case keeps its counts at each stage (scripts/make_cases.py --expected makes them)."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from bsgplan.cli import main

CASES = Path(__file__).resolve().parent.parent / "cases"
NAMES = sorted(path.parent.name for path in CASES.glob("*/case.toml"))


def planned(name, capsys, *options):
    case = tomllib.loads((CASES / name / "case.toml").read_text())
    words = ["estimate", str(CASES / name / "mesh.msh"), "--tris-per-block", str(case["tris_per_block"])]
    assert main([*words, "--json", *options]) == 0
    return json.loads(capsys.readouterr().out)


def assert_keeps(stage, plan):
    assert {key: plan["mesh"][key] for key in stage["mesh"]} == stage["mesh"]
    kept = [{key: region[key] for key in stage["regions"][0]} for region in plan["regions"]]
    assert kept == stage["regions"]
    assert {key: plan["totals"][key] for key in stage["totals"]} == pytest.approx(stage["totals"])


def test_there_are_at_least_six_cases():
    assert len(NAMES) >= 6


@pytest.mark.parametrize("name", NAMES)
def test_a_case_keeps_its_counts_at_each_stage(name, capsys):
    expected = json.loads((CASES / name / "expected.json").read_text())
    assert_keeps(expected["whole"], planned(name, capsys))


@pytest.mark.parametrize("name", NAMES)
def test_the_blocks_of_a_case_stay_near_its_triangles_over_sixteen(name, capsys):
    totals = planned(name, capsys, "--objective", "size")["totals"]
    assert totals["blocks"] == pytest.approx(totals["blocks_by_count"], rel=0.1)


@pytest.mark.parametrize("name", NAMES)
def test_the_numbers_of_a_plan_add_up(name, capsys):
    plan = planned(name, capsys)
    regions, totals, mesh = plan["regions"], plan["totals"], plan["mesh"]
    assert sum(region["n_triangles"] for region in regions) == mesh["n_triangles"]
    assert sum(region["blocks"] for region in regions) == totals["blocks"]
    assert totals["planned_triangles"] == 16 * totals["blocks"]
    assert sum(region["area"] for region in regions) == pytest.approx(mesh["area"])
    assert sum(region["charge"] for region in regions) == pytest.approx(totals["charge"], abs=1e-6)
    for sign in ("positive", "negative"):
        assert sum(region["irregularity"][sign] for region in regions) == totals["irregularity"][sign]
    assert mesh["irregularity"]["total"] == -6 * mesh["euler_characteristic"]


def test_the_drawn_region_of_the_rectangle_is_the_papers(capsys):
    case = tomllib.loads((CASES / "rectangle" / "case.toml").read_text())
    plan = planned("rectangle", capsys, "--region", case["region"])
    (region,) = plan["regions"]
    assert region["fine_elements"] == pytest.approx(28, abs=2)
    assert region["coarse_elements"] == pytest.approx(4, abs=0.5)
    assert 10 <= region["fronts"] <= 11.5
    listed = {tuple(c["pattern"]): c for c in region["candidates"]}
    seven_five, seven_four = listed[7, 5, 3, 1], listed[7, 4, 1]
    assert (seven_five["blocks"], seven_five["planned_triangles"]) == (24, 384)
    assert seven_five["irregularity"]["positive"] == 2
    assert (seven_four["blocks"], seven_four["planned_triangles"]) == (16, 256)
    assert seven_four["irregularity"]["positive"] == 3
    assert "anisotropic" in listed[7, 1]["rejected"]
    expected = json.loads((CASES / "rectangle" / "expected.json").read_text())
    assert_keeps(expected["region"], plan)
