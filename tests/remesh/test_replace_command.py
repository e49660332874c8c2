"""`bsgplan replace`: what it writes and prints, what stays, and one-line errors."""

from __future__ import annotations

import json
import os
import signal
import time
from pathlib import Path

import numpy as np
import pytest

import bsgplan
from bsgplan.cli import main
from bsgplan.io.read import read_lonlat
from bsgplan.remesh import replace

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
    assert document["is_interrupted"] is False
    assert document["parts"][0]["strips"]["tried"] == 1
    assert document["budget"]["positive"] + document["budget"]["negative"] == pytest.approx(region["budget"])


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


def interrupted(monkeypatch: pytest.MonkeyPatch, n_times: int) -> list[float]:
    """Let n Ctrl-C arrive after the first stage of the annealing; return the list of shares it tells."""
    shares: list[float] = []

    def replace_with_signals(size, *, progress, **options):
        def told(text: str, share: float) -> None:
            progress(text, share)
            shares.append(share)
            for _ in range(n_times if len(shares) == 1 else 0):
                os.kill(os.getpid(), signal.SIGINT)
                time.sleep(0.01)  # Python runs the handler between two instructions

        return replace(size, progress=told, **options)

    monkeypatch.setattr("bsgplan.replace_pipeline.replace", replace_with_signals)
    return shares


def test_ctrl_c_writes_what_there_is_and_exits_130(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shares = interrupted(monkeypatch, 1)
    output = tmp_path / "r.msh"
    words = ["--region", REGION, "--effort", "60", "--json", "-o", str(output)]
    assert main(["replace", str(CASE), *words]) == 130
    told = capsys.readouterr()
    document = json.loads(told.out)
    assert told.err.splitlines()[-1] == "interrupted"
    assert document["is_interrupted"] is True
    assert len(shares) == 1
    assert bsgplan.read(output).mesh.n_triangles == document["after"]["n_triangles"]
    assert document["after"]["q_min"] >= document["before"]["q_min"] - 0.02


def test_a_second_ctrl_c_stops_at_once_and_writes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    before = signal.default_int_handler
    signal.signal(signal.SIGINT, before)  # a shell starts what runs in the background deaf to Ctrl-C
    interrupted(monkeypatch, 2)
    assert main(["replace", str(CASE), "--region", REGION, "-o", str(tmp_path / "r.msh")]) == 130
    told = capsys.readouterr()
    assert (told.out, told.err) == ("", "interrupted\n")
    assert list(tmp_path.iterdir()) == []
    assert signal.getsignal(signal.SIGINT) is before
