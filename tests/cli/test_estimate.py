"""`bsgplan estimate` on the command line: every option, every way to get it wrong, nothing half-written."""

from __future__ import annotations

import json
import os
from pathlib import Path

import meshio
import numpy as np
import pytest

from bsgplan.cli import main

CASES = Path(__file__).resolve().parents[2] / "cases"
SQUARE, RECTANGLE, PLATE = (str(CASES / name / "mesh.msh") for name in ("square", "rectangle", "plate"))


def said(capsys, *words):
    code = main(["estimate", *words])
    return code, *capsys.readouterr()


def planned(capsys, *words):
    code, out, _ = said(capsys, *words, "--json")
    assert code == 0
    return json.loads(out)


WRONG = [
    (["--tris-per-block", "20"], "16 and 25"),
    (["--tris-per-block", "0"], "under 1"),
    (["--tris-per-block", "-4"], "under 1"),
    (["--tris-per-block", "1" + 20 * "0"], "give fewer"),
    (["--tris-per-block", "four"], "'four'"),
    (["--tris-per-block", ""], "''"),
    (["--tris-per-block", "4,17"], "16 and 25"),
    (["--blocks", "0"], "under 1"),
    (["--blocks", "ten"], "ten"),
    (["--blocks", "5", "--tris-per-block", "4"], "one of the two"),
    (["--objective", "beauty"], "balanced"),
    (["--persistence", "1"], "above 1"),
    (["--persistence", "nan"], "above 1"),
    (["--plateau", "0"], "above 0"),
    (["--gradient-limit", "-1"], "above 0"),
    (["--region", "POINT(0 0)"], "Point"),
    (["--region", "POLYGON((0 0,1 1,1 0,0 1,0 0))"], "Self-intersection"),
    (["--region", "POLY("], "WKT"),
    (["--region", "0,0,1"], "a box has four"),
    (["--region", "0,0,0,1"], "no area"),
    (["--region", "-5"], "not understood"),
    (["--figure", "plan.gif"], ".png"),
    (["--vtk", "plan.txt"], ".vtu"),
    (["--vtk-patterns", "plan.txt"], ".vtu"),
    (["--tris-per-block", "4,16", "--figure", "plan.png"], "one block size"),
    (["--frobnicate"], "frobnicate"),
]


@pytest.mark.parametrize(("words", "told"), WRONG, ids=[" ".join(words) for words, _ in WRONG])
def test_wrong_usage_is_one_line_and_exit_2(capsys, tmp_path, monkeypatch, words, told):
    monkeypatch.chdir(tmp_path)
    code, out, err = said(capsys, SQUARE, *words)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert told in err
    assert list(tmp_path.iterdir()) == []


BAD = [
    (["nowhere.msh"], "no such file"),
    ([SQUARE, "--size", "depth"], "no array 'depth'"),
    ([SQUARE, "--region", "nowhere.geojson"], "No such file"),
    ([SQUARE, "--save", "nowhere/plan.json"], "does not exist"),
    ([SQUARE, "--figure", "nowhere/plan.png"], "does not exist"),
    ([SQUARE, "--vtk", "."], "is a folder"),
]


@pytest.mark.parametrize(("words", "told"), BAD, ids=[" ".join(words[-2:]) for words, _ in BAD])
def test_bad_input_and_output_are_one_line_and_exit_3(capsys, tmp_path, monkeypatch, words, told):
    monkeypatch.chdir(tmp_path)
    code, out, err = said(capsys, *words)
    assert (code, out, err.count("\n")) == (3, "", 1)
    assert told in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf])
def test_a_size_that_is_no_length_is_refused(capsys, tmp_path, value):
    points = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    size = np.array([1.0, 1.0, value, 1.0])
    path = tmp_path / "mesh.vtu"
    meshio.write_points_cells(path, points, [("triangle", [[0, 1, 2], [0, 2, 3]])], {"h": size})
    code, out, err = said(capsys, str(path), "--size", "h")
    assert (code, out) == (3, "")
    assert "positive and finite" in err


def test_no_plan_for_the_request_is_exit_1(capsys):
    code, out, err = said(capsys, RECTANGLE, "--region", "50,50,60,60")
    assert (code, out) == (1, "")
    assert "holds no triangle" in err
    code, out, err = said(capsys, RECTANGLE, "--blocks", "1")
    assert (code, out) == (1, "")
    assert "the least is" in err
    assert "forbids fewer" in err


def test_two_outputs_of_one_name_are_wrong_usage(capsys, tmp_path):
    same = str(tmp_path / "plan.vtu")
    code, _, err = said(capsys, SQUARE, "--vtk", same, "--vtk-patterns", same)
    assert code == 2
    assert "two outputs" in err


def test_the_mesh_itself_is_never_overwritten(capsys):
    code, _, err = said(capsys, SQUARE, "--save", SQUARE)
    assert code == 2
    assert "is a file that is read" in err


def test_a_pipe_is_not_replaced_by_a_file(capsys, tmp_path):
    pipe = tmp_path / "pipe.json"
    os.mkfifo(pipe)
    code, _, err = said(capsys, SQUARE, "--save", str(pipe))
    assert code == 3
    assert "no regular file" in err
    assert pipe.is_fifo()


def test_a_link_is_written_through(capsys, tmp_path):
    target, link = tmp_path / "target.json", tmp_path / "link.json"
    target.write_text("old")
    link.symlink_to(target)
    assert said(capsys, SQUARE, "--save", str(link))[0] == 0
    assert link.is_symlink()
    assert json.loads(target.read_text())["schema"] == "bsgplan.estimate/1"


def test_the_boundary_is_named_where_it_forbids_fewer_blocks(capsys):
    shoreline = str(CASES / "shoreline" / "mesh.msh")
    _, _, err = said(capsys, shoreline, "--blocks", "30")
    assert "the boundary" in err


def test_one_triangle_is_planned_and_drawn(capsys, tmp_path):
    path = tmp_path / "one.vtu"
    meshio.write_points_cells(path, np.array([[0.0, 0], [1, 0], [0, 1]]), [("triangle", [[0, 1, 2]])])
    document = planned(capsys, str(path), "--figure", str(tmp_path / "one.png"))
    assert document["totals"]["blocks"] == 1


@pytest.mark.parametrize("unit", [1e80, 1e-80])
def test_units_beyond_reckoning_are_refused(capsys, tmp_path, unit):
    path = tmp_path / "huge.vtu"
    points = unit * np.array([[0.0, 0], [1, 0], [0, 1]])
    meshio.write_points_cells(path, points, [("triangle", [[0, 1, 2]])])
    code, _, err = said(capsys, str(path))
    assert code == 3
    assert "another unit" in err


def test_several_block_sizes_are_several_plans(capsys):
    document = planned(capsys, SQUARE, "--tris-per-block", "4,16,64")
    assert [plan["tris_per_block"] for plan in document["plans"]] == [4, 16, 64]
    blocks = [plan["totals"]["blocks"] for plan in document["plans"]]
    assert blocks == sorted(blocks, reverse=True)
    assert "regions" not in document


def test_the_inverse_needs_no_more_blocks_than_asked(capsys):
    document = planned(capsys, RECTANGLE, "--blocks", "40")
    assert document["totals"]["blocks"] <= 40


def test_a_region_may_be_a_box_a_polygon_or_a_file(capsys, tmp_path):
    corners = [[0.3, 0], [0.96, 0], [0.96, 1], [0.3, 1], [0.3, 0]]
    file = tmp_path / "region.geojson"
    file.write_text(json.dumps({"type": "Polygon", "coordinates": [corners]}))
    wkt = "POLYGON((0.3 0, 0.96 0, 0.96 1, 0.3 1, 0.3 0))"
    plans = [planned(capsys, RECTANGLE, "--region", r) for r in ("0.3,0,0.96,1", wkt, str(file))]
    assert plans[0]["regions"] == plans[1]["regions"] == plans[2]["regions"]


def test_a_box_may_start_with_a_negative_number(capsys):
    document = planned(capsys, RECTANGLE, "--region", "-1,-1,5,2")
    assert document["mesh"]["n_triangles"] == planned(capsys, RECTANGLE)["mesh"]["n_triangles"]


def test_a_named_size_is_planned_uncalibrated(capsys):
    document = planned(capsys, PLATE, "--size", "size")
    assert document["size_field"]["source"] == "size"
    assert document["totals"]["blocks_by_count"] == pytest.approx(
        document["size_field"]["expected_triangles"] / 16
    )


def test_every_output_is_written_and_the_document_is_the_printed_one(capsys, tmp_path):
    names = {
        "--vtk": "plan.vtu",
        "--vtk-patterns": "patterns.vtu",
        "--figure": "plan.png",
        "--save": "p.json",
    }
    words = [word for option, name in names.items() for word in (option, str(tmp_path / name))]
    document = planned(capsys, RECTANGLE, *words)
    assert {path.name for path in tmp_path.iterdir()} == set(names.values())
    assert json.loads((tmp_path / "p.json").read_text()) == document


def test_the_table_says_what_the_document_says(capsys):
    _, out, _ = said(capsys, RECTANGLE)
    document = planned(capsys, RECTANGLE)
    total = next(line for line in out.splitlines() if line.startswith("total")).split()
    assert str(document["totals"]["blocks"]) in total
    assert str(document["totals"]["planned_triangles"]) in total
    assert out.isascii()
