"""Every file in ../shared/meshes: it agrees with an independent measurement, or fails in one line."""

from __future__ import annotations

import csv
import json
import re

import meshio
import numpy as np
import pytest
from conftest import SHARED
from predicates import assert_identity_holds, assert_is_mesh_file, plan_key

from bsgplan.cli import main
from bsgplan.errors import BsgplanError
from bsgplan.io import read
from bsgplan.io.read import read_raw
from bsgplan.io.sniff import sniff
from bsgplan.pipeline import plan_blocks
from bsgplan.report.mesh_report import vertex_lengths
from bsgplan.result import mesh_document

FOLDER = SHARED / "meshes"


def measured() -> list[dict[str, str]]:
    """Return the rows of MEASURED.tsv, empty where the meshes are absent."""
    if not (FOLDER / "MEASURED.tsv").exists():
        return []
    lines = (line for line in (FOLDER / "MEASURED.tsv").read_text().splitlines() if not line.startswith("#"))
    return list(csv.DictReader(lines, delimiter="\t"))


def is_read(name: str) -> bool:
    """Return True where the registry has a reader for a file."""
    try:
        return sniff(FOLDER / name).reader is not None
    except BsgplanError:
        return False


def has_triangles(row: dict[str, str]) -> bool:
    return row["vertices/triangles (quads)"][0].isdigit()


READ = [row for row in measured() if has_triangles(row) and is_read(row["name"])]
UNMEASURED = [row for row in measured() if not has_triangles(row)]
FILES = sorted(p for p in FOLDER.rglob("*") if p.is_file()) if FOLDER.is_dir() else []


def first_number(text: str) -> float:
    return float(re.match(r"[\d.e+-]+", text)[0])


def assert_printed(value: float, printed: str) -> None:
    """The value rounded to the printed digits is the printed one, give or take half the last digit."""
    expected = first_number(printed)
    mantissa = re.match(r"[\d.]+", printed)[0]
    n_digits = len(mantissa.replace(".", "").lstrip("0")) or 1
    assert abs(value - expected) <= 0.51 * 10 ** (np.floor(np.log10(expected)) - n_digits + 1), (
        value,
        printed,
    )


@pytest.mark.parametrize("row", READ, ids=[row["name"] for row in READ])
def test_agrees_with_the_independent_measurement(row):
    mesh_file = read(FOLDER / row["name"])
    assert_is_mesh_file(mesh_file)
    assert_identity_holds(mesh_file.mesh)
    found = mesh_document(mesh_file)
    counts = [int(n) for n in re.findall(r"\d+", row["vertices/triangles (quads)"])]
    assert [found["n_points"], found["n_triangles"]] == counts[:2]
    n_quads = counts[2] if len(counts) > 2 else 0
    assert found["ignored"].get("quad", 0) == n_quads
    assert (found["quads"] or {"n_quads": 0})["n_quads"] == n_quads
    components = [int(n) for n in re.findall(r"\d+", row["components"])]
    assert components in ([found["n_components"]], [found["n_components"], found["n_components_vertex"]])
    assert found["n_boundary_loops"] == int(row["boundary loops"])
    edges = row["edge min/med/max"].split(" / ")
    for name, printed in zip(("edge_min", "edge_median", "edge_max"), edges, strict=True):
        assert_printed(found[name], printed)
    ratio, of_edges, middle = re.findall(r"[\d.e+]+", row["size ratio h (edge; 1-99%)"])
    assert_printed(found["size_ratio"], ratio)
    assert_printed(found["edge_max"] / found["edge_min"], of_edges)
    low, high = np.percentile(vertex_lengths(mesh_file.mesh.topology, mesh_file.mesh.edge_lengths), [1, 99])
    assert_printed(high / low, middle)
    q_min, q_mean = re.findall(r"[\d.e-]+", row["q min (mean)"])
    assert_printed(found["q_min"], q_min)
    assert found["q_mean"] == pytest.approx(float(q_mean), abs=0.0051)
    interior = [int(n) for n in row["irregular interior / interior"].split(" / ")]
    assert [found["irregular_interior"], found["n_interior"]] == interior
    boundary = [int(n) for n in row["irregular boundary / boundary"].split(" / ")]
    assert [found["irregular_boundary"], found["n_boundary"]] == boundary


NOTED = {
    "wnat_test_18578.fort.14": {"pinches": 15, "n_points": 9934, "n_triangles": 18578},
    "clockwise_Test_Case_4.2.fort.14": {"notes": ["4622 clockwise triangles turned counter-clockwise"]},
    "helmholtz_apartment.vtk": {"notes": ["524 clockwise triangles turned counter-clockwise"]},
    "quadratic_tri.msh": {"notes": ["cells of higher order are taken by their corners"], "n_triangles": 119},
    "multizone_cht_3cyl_ffd.su2": {"n_triangles": 1552, "notes": ["4 zones joined, their points stay apart"]},
    "katrina_wnat_om2d.fort.14": {"n_boundary_loops": 1 + 42, "bounds": [-97.9, -60.0, 8.0, 45.7]},
    "columbia_plume_02_normal.msh": {"n_boundary_loops": 1 + 5},
    "north_sea.msh": {"n_boundary_loops": 1 + 36},
    "weirs_internal_overflow.fort.14": {"n_components": 3},
    "vew1d_coincident_seams.fort.14": {"notes": ["302 points coincide with another point; they stay apart"]},
    "partial_physical_groups_9101.msh": {"ignored": {"quad": 9950, "hexahedron": 4881}},
    "bohai_yellow_sea_BYS_20814.2dm": {"n_boundary_loops": 24},
    "bunny_adaptive.off": {"n_boundary_loops": 0, "n_boundary": 0},
    "osteonT1_11.mesh": {"arrays": {"points": ["medit:ref"], "cells": ["medit:ref"]}},
}
"""What the last column of the measurement says in words, where a number of ours says it too."""


@pytest.mark.parametrize("name", NOTED)
def test_what_the_measurement_notes_in_words_is_found(meshes, name, capsys):
    assert main(["info", str(meshes / name), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["mesh"]
    for key, expected in NOTED[name].items():
        if key == "notes":
            assert any(note.startswith(expected[0]) for note in found["notes"])
        elif key == "bounds":
            assert found["bounds"] == pytest.approx(expected, abs=0.1)
        elif key == "ignored":
            assert {kind: found["ignored"].get(kind) for kind in expected} == expected
        else:
            assert found[key] == expected


def test_the_slivers_of_the_measurement_are_found(meshes):
    """8 of q < 0.1 are noted."""
    assert np.count_nonzero(read(meshes / "wnat_test_18578.fort.14").mesh.qualities < 0.1) == 8


def test_no_measured_mesh_and_no_twin_is_left_out(meshes):
    """A mesh that the registry stopped to recognise would be dropped from the lists above in silence."""
    assert len(READ) + len(UNMEASURED) == len(measured()) == 25
    assert all(is_read(original(twin)) for twin in TWINS)
    assert len(TWINS) == len(list((meshes / "oracle").iterdir()))
    sources = (meshes / "SOURCES.tsv").read_text().splitlines()[1:]
    kept = {line.split("\t")[0] for line in sources if not line.startswith("malformed")}
    assert kept == {row["name"] for row in measured()}


@pytest.mark.parametrize("row", UNMEASURED, ids=[row["name"] for row in UNMEASURED])
def test_quads_are_measured_where_triangles_are_not(row, capsys):
    assert main(["info", str(FOLDER / row["name"]), "--json"]) == 0
    quads = json.loads(capsys.readouterr().out)["mesh"]["quads"]
    assert quads["n_quads"] == int(re.search(r"\((\d+) quads\)", row["vertices/triangles (quads)"])[1])
    assert quads["n_interior"] + quads["n_boundary"] == quads["n_points"]


@pytest.mark.parametrize(
    ("name", "n_triangles"), [("mesh_RAE2822_turb.su2", 27642), ("square_triquad.mesh", 858)]
)
def test_split_quads_give_the_triangles_that_the_measurement_notes(meshes, name, n_triangles, capsys):
    assert main(["info", str(meshes / name), "--json", "--split-quads"]) == 0
    found = json.loads(capsys.readouterr().out)["mesh"]
    assert found["n_triangles"] == n_triangles
    assert found["quads"] is None
    assert found["n_components"] == 1
    if name.startswith("mesh_RAE"):
        assert found["size_ratio"] == pytest.approx(5e5, rel=0.02)
        assert found["q_min"] == pytest.approx(0.001, abs=5e-5)


TWINS = sorted(p.name for p in FOLDER.glob("oracle/*.vtu"))


def original(twin: str) -> str:
    """Return the name of the file that a twin was converted from."""
    name = twin.removesuffix(".vtu")
    return "la.1.node" if name == "la.1" else name


@pytest.mark.parametrize("twin", [name for name in TWINS if is_read(original(name))])
def test_a_twin_has_the_plan_of_its_original(twin):
    """Plans are made where the arrays differ: the same arrays have the same plan."""
    files = [read(path) for path in (FOLDER / original(twin), FOLDER / "oracle" / twin)]
    one, other = (found.mesh for found in files)
    if np.array_equal(one.points, other.points) and np.array_equal(one.triangles, other.triangles):
        return
    (counts, sizes), (other_counts, other_sizes) = (plan_key(plan_blocks(found).plan) for found in files)
    assert counts == other_counts
    assert sizes == pytest.approx(other_sizes, rel=1e-9)


FORT14 = [row["name"] for row in READ if row["name"].endswith(".14")]


@pytest.mark.parametrize("name", FORT14)
def test_our_fort14_reader_agrees_with_the_converted_file(name):
    ours, other = read(FOLDER / name), meshio.read(FOLDER / "oracle" / f"{name}.vtu")
    assert np.array_equal(ours.mesh.points, other.points[:, :2])
    if not ours.notes or "clockwise" not in ours.notes[0]:
        assert np.array_equal(ours.mesh.triangles, other.cells_dict["triangle"])
    assert np.array_equal(np.sort(ours.mesh.triangles), np.sort(other.cells_dict["triangle"]))
    assert np.array_equal(ours.point_data["depth"], other.point_data["depth"])


@pytest.mark.parametrize("path", FILES, ids=[str(p.relative_to(FOLDER)) for p in FILES])
def test_every_file_is_read_or_refused_in_one_line(path, capsys):
    try:
        raw = read_raw(path)[1]
        if len(raw.triangles):
            read(path)
        expected = 0 if len(raw.triangles) or len(raw.quads) else 3
    except BsgplanError:
        expected = 3
    assert main(["info", str(path), "--json"]) == expected
    out, err = capsys.readouterr()
    errors = [line for line in err.splitlines() if line.startswith("error: ")]
    assert len(errors) == (expected != 0)
    assert "Traceback" not in err
    assert (out == "") == (expected != 0)


def test_the_four_malformed_files_name_their_line(meshes):
    for path in sorted((meshes / "malformed_fort14").iterdir()):
        with pytest.raises(BsgplanError, match=r"\.14: line \d+: .*;"):
            read(path)


def test_coincident_points_are_told_and_not_merged(meshes):
    found = read(meshes / "vew1d_coincident_seams.fort.14")
    assert found.mesh.n_points == 4832
    assert any(note.startswith("302 points coincide") for note in found.notes)
    seams = [b for b in found.boundaries if b.code == 64]
    assert sum(b.n_nodes for b in seams) == 302
    for seam in seams:
        assert np.array_equal(found.mesh.points[seam.nodes], found.mesh.points[seam.partners])
