"""`bsgplan info`: the table and the JSON document."""

from __future__ import annotations

import json

import pytest

from bsgplan.cli import main

SQUARE = "a square\n2 4\n1 0 0 1\n2 1 0 1\n3 1 1 1\n4 0 1 1\n1 3 1 2 3\n2 3 1 3 4\n"

KEYS = [
    "path",
    "format",
    "n_points",
    "n_triangles",
    "n_components",
    "n_boundary_loops",
    "euler_characteristic",
    "pinches",
    "genus",
    "q_min",
    "q_mean",
    "angle_min",
    "edge_ratio_max",
    "edge_min",
    "edge_median",
    "edge_max",
    "size_ratio",
    "irregularity",
    "irregular_interior",
    "n_interior",
    "irregular_boundary",
    "n_boundary",
    "irregular_boundary_fitted",
    "area",
    "bounds",
    "ignored",
    "quads",
    "boundaries",
    "arrays",
    "notes",
    "projection",
]


@pytest.fixture
def square(tmp_path):
    path = tmp_path / "square.14"
    path.write_text(SQUARE)
    return str(path)


def test_json_is_one_document_and_nothing_else(square, capsys):
    assert main(["info", square, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "bsgplan.info/1"
    mesh = document["mesh"]
    assert set(KEYS) <= set(mesh)
    assert (mesh["n_points"], mesh["n_triangles"], mesh["euler_characteristic"], mesh["genus"]) == (
        4,
        2,
        1,
        0,
    )
    assert mesh["irregularity"] == {"positive": 0, "negative": -6, "total": -6}
    assert mesh["angle_min"] == pytest.approx(45)
    assert mesh["edge_ratio_max"] == pytest.approx(2**0.5)
    assert mesh["area"] == pytest.approx(1)
    assert mesh["bounds"] == [0, 1, 0, 1]
    assert mesh["quads"] is None
    assert mesh["projection"] is None


def test_the_table_names_its_units(square, capsys):
    assert main(["info", square, "--lonlat"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert "triangles                  2" in out
    assert " m^2" in out
    assert "oblique stereographic" in out


def test_degrees_without_the_option_give_a_warning(square, capsys):
    assert main(["info", square]) == 0
    out, err = capsys.readouterr()
    assert "file unit" in out
    assert err.startswith("warning: ")
    assert "--lonlat" in err
    assert err.count("\n") == 1


def test_no_degrees_with_the_option_are_bad_input(tmp_path, capsys):
    path = tmp_path / "metres.14"
    path.write_text(SQUARE.replace("3 1 1 1\n4", "3 1 1000 1\n4"))
    assert main(["info", str(path), "--lonlat"]) == 3
    assert "latitude 1000" in capsys.readouterr().err


def test_quads_are_measured_apart(meshes, capsys):
    assert main(["info", str(meshes / "square_triquad.mesh"), "--json"]) == 0
    quads = json.loads(capsys.readouterr().out)["mesh"]["quads"]
    assert quads["n_quads"] == 200
    assert quads["irregularity"]["total"] == -4 * quads["euler_characteristic"]
