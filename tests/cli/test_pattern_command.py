"""`bsgplan pattern`: the numbers of NOTES.md, files, and one line for what is wrong."""

from __future__ import annotations

import json

import meshio
import numpy as np
import pytest

from bsgplan.cli import main


def document(capsys, *words):
    assert main(["pattern", *words, "--json"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    return json.loads(out)


@pytest.mark.parametrize(
    ("text", "blocks", "fronts", "q"),
    [
        ("7:5:3:1", 24, [-2, 0, 0, 2], 0.5),
        ("7:4:1", 16, [-3, 0, 3], 0.5),
        ("7:2:1", 12, [-5, 4, 1], 0.5),
        ("7:4:2:1", 20, [-3, 1, 1, 1], 0.756),
        ("4:2:1", 9, [-2, 1, 1], 0.866),
    ],
)
def test_the_document_of_a_pattern(capsys, text, blocks, fronts, q):
    found = document(capsys, text, "--refine", "2")
    assert found["schema"] == "bsgplan.pattern/1"
    assert (found["pattern"], found["n_blocks"], found["n_triangles"]) == (text, blocks, 16 * blocks)
    assert [front["irregularity"] for front in found["fronts"]] == fronts
    assert all(front["irregularity"] == front["positive"] + front["negative"] for front in found["fronts"])
    assert round(found["best"]["q_min"], 3) == q
    assert found["asked"] is None
    assert found["irregularity"]["positive"] == sum(i for i in fronts if i > 0)
    assert found["irregularity_of_vertices"]["positive"] >= found["irregularity"]["positive"]


def test_bounds_of_table_2_and_moved_vertices(capsys):
    found = document(capsys, "7:4:1", "--length", "0.7")
    bounds = {name: round(value, 2) for name, value in found["bounds"].items()}
    assert bounds == {
        "q_bound": 0.95,
        "positive_spread": 0.95,
        "positive_concentrated": 0.9,
        "angle": 45.0,
        "edge_ratio": 1.31,
    }
    for at in (found["best"], found["asked"]):
        assert at["q_min"] <= at["moved_walls_fixed"] + 1e-9
        assert at["moved_length_free"] >= 0.70
        assert at["positions"][0] == 0
        assert at["positions"][-1] == pytest.approx(at["length"])
    assert found["asked"]["length"] == 0.7
    assert found["best"]["shortest"] <= found["best"]["length"] <= found["best"]["longest"]


def test_the_tables_show_both_counts_of_irregularity(capsys):
    assert main(["pattern", "4:2:1", "--length", "0.5"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert "sums over fronts, Eq. 20 and 21" in out
    assert "counted on the triangulation" in out
    assert "0.670" in out
    assert "asked" in out


def test_rings_are_counted_as_rings(capsys):
    found = document(capsys, "12:6:6", "--closed")
    assert found["is_closed"]
    assert found["n_blocks"] == 30
    assert [front["irregularity"] for front in found["fronts"]] == [-6, 6, 0]
    assert found["best"]["moved_walls_sliding"] is None
    assert 0.8 < found["best"]["q_min"] <= 1


def test_refinements_multiply_triangles_by_four(capsys):
    counts = [document(capsys, "4:1", "--refine", str(k))["n_triangles"] for k in range(4)]
    assert counts == [5, 20, 80, 320]


@pytest.mark.parametrize("words", [["7:4:1", "--length", "0.7"], ["12:6:6", "--closed"], ["40:20"]])
def test_figures_are_written(tmp_path, capsys, words):
    for suffix in ("png", "svg"):
        path = tmp_path / f"p.{suffix}"
        assert main(["pattern", *words, "--figure", str(path)]) == 0
        assert path.stat().st_size > 5000
    assert capsys.readouterr().err == ""


def test_the_figure_marks_each_irregular_vertex_once():
    from bsgplan.patterns import Pattern
    from bsgplan.report.pattern_figure import BLUE, RED, pattern_figure

    for pattern, n_red, n_blue in ((Pattern((7, 4, 1)), 2, 3), (Pattern((12, 6, 6), True), 6, 6)):
        axes = pattern_figure(pattern).axes[0]
        marks = {line.get_color(): len(line.get_xdata()) for line in axes.lines if line.get_marker() == "o"}
        assert (marks[RED], marks[BLUE]) == (n_red, n_blue)


def test_the_vtk_file_holds_refined_blocks_and_the_displacement(tmp_path, capsys):
    path = tmp_path / "p.vtu"
    assert main(["pattern", "7:4:1", "--length", "0.7", "--refine", "2", "--vtk", str(path)]) == 0
    assert capsys.readouterr().err == ""
    mesh = meshio.read(path)
    assert len(mesh.cells[0].data) == 256
    assert set(mesh.cell_data) == {"block", "level", "quality"}
    assert np.unique(mesh.cell_data["block"][0]).size == 16
    assert sorted(np.bincount(mesh.cell_data["level"][0]) // 16) == [5, 11]
    assert mesh.cell_data["quality"][0].min() == pytest.approx(0.5)
    moved = mesh.points + mesh.point_data["displacement"]
    assert np.ptp(moved, axis=0) == pytest.approx([0.7, 1, 0])
    assert not np.allclose(moved, mesh.points)


@pytest.mark.parametrize(
    "words",
    [
        ["7:x"],
        ["7"],
        ["7:0"],
        ["7:-1"],
        [""],
        ["4:2", "--closed"],
        ["7:4:1", "--length", "0"],
        ["7:4:1", "--length", "nan"],
        ["7:4:1", "--length", "long"],
        ["7:4:1", "--refine", "-1"],
        ["7:4:1", "--refine", "11"],
        ["999999:999999"],
        ["7:4:1", "--figure", "p.bmp"],
        ["7:4:1", "--vtk", "p.obj"],
        [],
        ["7:4:1", "--colour"],
    ],
)
def test_what_is_wrong_by_itself_is_one_line_and_code_2(capsys, words):
    assert main(["pattern", *words]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert err.count("\n") == 1


def test_outputs_that_cannot_be_written_are_code_3(tmp_path, capsys):
    for option, name in (("--figure", "p.png"), ("--vtk", "p.vtu")):
        assert main(["pattern", "7:4:1", option, str(tmp_path / "none" / name)]) == 3
        out, err = capsys.readouterr()
        assert out == ""
        assert "does not exist" in err
        assert err.count("\n") == 1
