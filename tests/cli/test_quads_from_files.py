"""Meshes with quads at the command line: measured apart, refused, split."""

from __future__ import annotations

import json

import meshio
import numpy as np
import pytest

from bsgplan.cli import main
from bsgplan.report.mesh_report import measures_without_triangles


@pytest.fixture
def mixed(tmp_path):
    """A square of one quad beside a square of two triangles."""
    points = np.array([[0.0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [0, 1]])
    cells = [("quad", [[0, 1, 4, 5]]), ("triangle", [[1, 2, 3], [1, 3, 4]])]
    path = tmp_path / "mixed.vtu"
    meshio.write_points_cells(path, points, cells, {}, {"h": [np.array([2.0]), np.array([1.0, 1.0])]})
    return str(path)


@pytest.fixture
def quads(tmp_path):
    """One quad and nothing else, 60 degrees at two corners."""
    points = np.array([[0.0, 0], [1, 0], [1.5, np.sqrt(0.75)], [0.5, np.sqrt(0.75)]])
    path = tmp_path / "quads.vtu"
    meshio.write_points_cells(path, points, [("quad", [[0, 1, 2, 3]])])
    return str(path)


def said(capsys, *words: str) -> tuple[int, str, str]:
    code = main(list(words))
    return code, *capsys.readouterr()


def test_estimate_refuses_quads_and_names_the_remedy(mixed, quads, capsys):
    code, out, err = said(capsys, "estimate", mixed)
    assert (code, out) == (3, "")
    assert "1 quads beside 2 triangles" in err
    assert "--split-quads" in err
    code, out, err = said(capsys, "estimate", quads)
    assert (code, out) == (3, "")
    assert "split its quads with --split-quads" in err


def test_split_quads_are_planned_with_their_cell_data(mixed, capsys):
    words = ("estimate", mixed, "--split-quads", "--tris-per-block", "1", "--json")
    code, out, _ = said(capsys, *words, "--size", "h")
    assert code == 0
    document = json.loads(out)
    assert document["mesh"]["n_triangles"] == 4
    assert document["mesh"]["area"] == pytest.approx(2)
    assert document["mesh"]["notes"][0] == "1 quad split along the better diagonal"
    assert document["size_field"]["h_max"] == pytest.approx(2, rel=0.05)


def test_info_measures_quads_where_there_is_nothing_else(quads, capsys):
    code, out, _ = said(capsys, "info", quads, "--json")
    assert code == 0
    mesh = json.loads(out)["mesh"]
    assert (mesh["n_triangles"], mesh["n_points"], mesh["q_min"]) == (0, 4, None)
    found = mesh["quads"]
    assert (found["angle_min"], found["angle_max"]) == pytest.approx((60, 120))
    assert found["irregularity"] == {"positive": 0, "negative": -4, "total": -4}
    assert mesh["notes"] == ["no triangles; --split-quads makes triangles of the quads"]
    code, out, _ = said(capsys, "info", quads, "--lonlat")
    assert code == 0
    assert "angles of quads" in out
    assert " m" in out
    code, out, _ = said(capsys, "info", quads, "--split-quads", "--json")
    assert json.loads(out)["mesh"]["q_min"] == pytest.approx(1)


def test_documents_of_quads_and_of_triangles_have_the_same_keys(mixed, quads, capsys):
    documents = [json.loads(said(capsys, "info", path, "--json")[1])["mesh"] for path in (mixed, quads)]
    assert set(documents[0]) == set(documents[1])
    assert set(documents[0]["quads"]) == set(documents[1]["quads"])
    assert set(measures_without_triangles()) <= set(documents[0])


def test_a_quad_that_names_no_point_is_refused(tmp_path, capsys):
    path = tmp_path / "broken.14"
    path.write_text("broken\n1 4\n1 0 0 1\n2 1 0 1\n3 1 1 1\n4 0 1 1\n1 4 1 2 3 9\n")
    for option in ((), ("--split-quads",)):
        code, out, err = said(capsys, "info", str(path), *option)
        assert (code, out) == (3, "")
        assert "node 9" in err
