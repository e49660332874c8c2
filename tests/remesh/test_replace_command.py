"""`bsgplan replace`: what it writes and prints, what stays, and one-line errors."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import bsgplan
from bsgplan.cli import main
from bsgplan.io.read import read_lonlat

CASE = Path(__file__).resolve().parents[2] / "cases" / "transition" / "mesh.msh"
REGION = "0.2,0.1,1,0.9"


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("replace")
    words = ["replace", str(CASE), "--region", REGION, "--effort", "15", "--save", str(folder / "r.json")]
    assert main([*words, "-o", str(folder / "r.msh"), "--figure", str(folder / "r.png")]) == 0
    return folder


def test_the_document_tells_before_and_after(done: Path) -> None:
    document = json.loads((done / "r.json").read_text())
    assert document["schema"] == "bsgplan.replace/1"
    (region,) = document["regions"]
    assert region["after"]["irregular_interior"] < 0.35 * region["before"]["irregular_interior"]
    for measures in (document["before"], region["after"]):
        assert {"n_triangles", "irregular_interior", "irregular_boundary", "q_min", "q_mean"} <= set(measures)
        assert set(measures["irregularity"]) >= {"positive", "negative"}
    assert document["parts"][0]["is_replaced"]


def test_what_is_outside_stays_and_groups_are_kept(done: Path) -> None:
    before, after = bsgplan.read(CASE), bsgplan.read(done / "r.msh")
    document = json.loads((done / "r.json").read_text())
    assert after.mesh.n_triangles == document["after"]["n_triangles"]
    x0, y0, x1, y1 = map(float, REGION.split(","))
    centre = before.mesh.centroids
    outside = ~((centre > [x0, y0]) & (centre < [x1, y1])).all(axis=1)
    old = {p.tobytes() for p in before.mesh.points[before.mesh.triangles[outside]]}
    new = {p.tobytes() for p in after.mesh.points[after.mesh.triangles]}
    assert old <= new
    for a, b in zip(before.boundaries, after.boundaries, strict=True):
        assert (a.name, a.n_nodes) == (b.name, b.n_nodes)
        assert np.array_equal(before.mesh.points[a.nodes], after.mesh.points[b.nodes])


def test_a_mesh_in_degrees_keeps_its_degrees_depths_and_boundaries(meshes: Path, tmp_path: Path) -> None:
    """Shinnecock Inlet, a box at the inlet: the rest bit for bit in the file itself."""
    path = meshes / "shinnecock_inlet.fort.14"
    source = read_lonlat(path)
    west, south = source.degrees[source.boundaries[0].nodes].mean(axis=0)
    box = f"{west - 0.1},{south - 0.05},{west + 0.1},{south + 0.1}"
    out = tmp_path / "out.14"
    assert main(["replace", str(path), "--lonlat", f"--region={box}", "--effort", "10", "-o", str(out)]) == 0
    before, after = bsgplan.read(path), bsgplan.read(out)
    old = {
        (*p, z) for p, z in zip(before.mesh.points.tolist(), before.point_data["depth"].tolist(), strict=True)
    }
    new = {
        (*p, z) for p, z in zip(after.mesh.points.tolist(), after.point_data["depth"].tolist(), strict=True)
    }
    assert len(old & new) > 0.5 * len(old)
    assert len(before.boundaries) == len(after.boundaries)
    for a, b in zip(before.boundaries, after.boundaries, strict=True):
        assert np.array_equal(before.mesh.points[a.nodes], after.mesh.points[b.nodes])


@pytest.mark.parametrize(
    ("words", "code", "told"),
    [
        (["--tolerance", "-1"], 2, "--tolerance"),
        (["--effort", "0"], 2, "--effort"),
        (["--min-quality", "2"], 2, "--min-quality"),
        (["--region", "5,5,6,6"], 1, "holds no triangle"),
        (["-o", "mesh.nothing"], 2, "no format that is written"),
        (["-o", str(CASE)], 2, "is a file that is read"),
    ],
)
def test_errors_are_one_line(
    words: list[str], code: int, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["replace", str(CASE), *words]) == code
    error = capsys.readouterr().err
    assert told in error
    assert error.count("\n") == 1


def test_what_is_refused_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--region", "0.2,0.1,0.5,0.4", "--effort", "2", "--min-quality", "0.999"]
    assert main(["replace", str(CASE), *words]) == 0
    assert "asked for" in capsys.readouterr().out
