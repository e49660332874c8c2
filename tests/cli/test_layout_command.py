"""`bsgplan layout` on the command line: what it tells and writes, Ctrl-C, every way to get it wrong."""

from __future__ import annotations

import json
import os
import pty
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import meshio
import numpy as np
import pytest

from bsgplan.blocks import lay_out
from bsgplan.blocks.advice import advice
from bsgplan.blocks.domain import domain_of
from bsgplan.cli import main
from bsgplan.io import read
from bsgplan.laid_out import load_layout
from bsgplan.layout_pipeline import compile_kernels
from bsgplan.sizing import size_field

CASES = Path(__file__).resolve().parents[2] / "cases"
SQUARE = str(CASES / "square" / "mesh.msh")
QUICK = ("--effort", "5")

MEASURES = {
    "n_triangles", "n_blocks", "q_min", "q_mean", "q_p01", "irregular_interior", "irregular_boundary",
    "irregular_boundary_fitted", "irregularity", "edge_ratio",
}  # fmt: skip


def said(capsys, *words):
    code = main(["layout", *words])
    return code, *capsys.readouterr()


@pytest.fixture(scope="module", autouse=True)
def kernels():
    """Compiled before any test, so that none hears of it."""
    compile_kernels()


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """One layout of the square with every output."""
    folder = tmp_path_factory.mktemp("layout")
    names = {"-o": "blocks.vtu", "--grid": "grid.vtu", "--figure": "layout.png", "--save": "layout.json"}
    words = [word for option, name in names.items() for word in (option, str(folder / name))]
    assert main(["layout", SQUARE, *QUICK, *words]) == 0
    return folder


def test_the_tables_stand_side_by_side(capsys):
    code, out, err = said(capsys, SQUARE, *QUICK, "--ranks", "7")
    assert (code, err) == (0, "")
    head = next(line for line in out.splitlines() if "estimate" in line)
    assert head.split() == ["input", "estimate", "layout", "grid"]
    rows = [line.split("  ")[0] for line in out.splitlines()]
    assert rows.index("q_min (layout: straight blocks)") < rows.index("blocks")
    assert "floor: iota+ + iota- = -6 chi = -6, of which 4 corners carry -8 .. -4" in out
    assert "7 ranks:" in out
    assert "8-byte P1 unknowns" in out
    assert max(map(len, out.splitlines())) <= 120


def test_the_document_has_the_keys_promised(capsys):
    code, out, _ = said(capsys, SQUARE, *QUICK, "--json", "--tris-per-block", "64", "--ranks", "3")
    found = json.loads(out)
    assert (code, found["schema"]) == (0, "bsgplan.layout/1")
    for part in ("input", "estimate", "layout", "grid"):
        assert set(found[part]) == MEASURES, part
        assert set(found[part]["irregularity"]) == {"positive", "negative"}
    for part in ("input", "layout", "grid"):
        assert set(found[part]["edge_ratio"]) == {"p05", "p50", "p95", "rms_log"}
        total = found[part]["irregularity"]
        assert total["positive"] + total["negative"] == found["floor"]["irregularity"] == -6
    n = found["layout"]["n_blocks"]
    assert found["input"]["n_blocks"] is None
    assert found["grid"]["n_triangles"] == 64 * n
    assert [level["n_triangles"] for level in found["levels"]] == [n, 4 * n, 16 * n, 64 * n]
    assert found["ranks"]["blocks_most"] == -(-n // 3)
    assert found["ranks"]["memory"] == found["ranks"]["blocks_most"] * (3 + 6 + 15 + 45) * 5 * 8
    assert found["seconds_cpu"] > 0
    assert found["is_interrupted"] is False
    assert found["layout"]["irregular_interior"] == found["grid"]["irregular_interior"]


def test_the_files_hold_one_layout(written):
    blocks, grid = (meshio.read(written / name) for name in ("blocks.vtu", "grid.vtu"))
    n = len(blocks.cells_dict["triangle"])
    assert np.array_equal(np.sort(blocks.cell_data["block"][0].ravel()), np.arange(n))
    assert np.array_equal(np.bincount(grid.cell_data["block"][0].astype(int).ravel()), np.full(n, 16))
    assert load_layout(written / "layout.json", "blocks").mesh.n_triangles == n
    assert load_layout(written / "layout.json", "grid").mesh.n_triangles == 16 * n
    assert json.loads((written / "layout.json").read_text())["layout"]["n_blocks"] == n
    assert (written / "layout.png").read_bytes()[:4] == b"\x89PNG"
    assert len(list(written.iterdir())) == 4


def test_the_same_seed_gives_the_same_layout(capsys):
    def one(seed):
        found = json.loads(said(capsys, SQUARE, *QUICK, "--json", "--seed", seed)[1])
        return {**found, "seconds_cpu": 0}

    assert one("11") == one("11")
    assert one("11") != one("12")


def test_straight_blocks_keep_the_quality_of_the_blocks(capsys):
    found = json.loads(said(capsys, str(CASES / "plate/mesh.msh"), *QUICK, "--straight", "--json")[1])
    assert found["is_straight"] is True
    assert found["grid"]["q_min"] == pytest.approx(found["layout"]["q_min"])


def test_depth_gives_time_steps(capsys, meshes):
    path = str(meshes / "bahamas_bight_of_abaco.fort.14")
    code, out, _ = said(capsys, path, *QUICK, "--json", "--tris-per-block", "4")
    found = json.loads(out)
    assert code == 0
    assert 0 < found["time_step"]["grid"] < 20 * found["time_step"]["input"]
    assert "sqrt(g depth)" in said(capsys, path, *QUICK, "--tris-per-block", "4")[1]


WRONG = [
    (["--tris-per-block", "20"], "16 and 25"),
    (["--tris-per-block", "4,16"], "4,16"),
    (["--effort", "0"], "under 1"),
    (["--seed", "-1"], "under 0"),
    (["--ranks", "0"], "under 1"),
    (["--size-tolerance", "1"], "above 1"),
    (["--size-tolerance", "nan"], "above 1"),
    (["--gradient-limit", "0"], "above 0"),
    (["--figure", "layout.gif"], ".png"),
    (["-o", "blocks.xyz"], ".xyz"),
    (["--grid", "grid"], "no format"),
    (["--keep", "nowhere"], "bottom"),
    (["--keep", "999999"], "count from 0"),
    (["-o", "a.vtu", "--grid", "a.vtu"], "two outputs"),
    (["--save", SQUARE], "a file that is read"),
]


@pytest.mark.parametrize(("words", "told"), WRONG, ids=[" ".join(words) for words, _ in WRONG])
def test_wrong_usage_is_one_line_and_exit_2(capsys, tmp_path, monkeypatch, words, told):
    monkeypatch.chdir(tmp_path)
    code, out, err = said(capsys, SQUARE, *words)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert told in err
    assert list(tmp_path.iterdir()) == []


def test_bad_input_is_one_line_and_exit_3(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for words, told in (
        (["nowhere.msh"], "no such file"),
        ([SQUARE, "--size", "depth"], "no array 'depth'"),
        ([SQUARE, "--save", "nowhere/layout.json"], "does not exist"),
    ):
        code, out, err = said(capsys, *words)
        assert (code, out, err.count("\n")) == (3, "", 1)
        assert told in err
    assert list(tmp_path.iterdir()) == []


def interrupted(monkeypatch, n_times):
    """Let n Ctrl-C arrive after the first stage of the annealing; return the list of stages it tells."""
    stages = []

    def lay_out_with_signals(size, *, progress, **options):
        def told(text, share):
            progress(text, share)
            stages.append(share)
            for _ in range(n_times if len(stages) == 1 else 0):
                os.kill(os.getpid(), signal.SIGINT)
                time.sleep(0.01)  # Python runs the handler between two instructions

        return lay_out(size, progress=told, **options)

    monkeypatch.setattr("bsgplan.laid_out.paired.lay_out", lay_out_with_signals)
    return stages


def test_ctrl_c_writes_the_layout_so_far_and_exits_130(capsys, tmp_path, monkeypatch):
    stages = interrupted(monkeypatch, 1)
    output = tmp_path / "blocks.vtu"
    code, out, err = said(capsys, SQUARE, "--effort", "40", "--json", "-o", str(output))
    found = json.loads(out)
    assert (code, err) == (130, "interrupted\n")
    assert found["is_interrupted"] is True
    assert len(stages) == 1
    assert found["grid"]["q_min"] > 0.3
    assert len(meshio.read(output).cells_dict["triangle"]) == found["layout"]["n_blocks"]
    stages.clear()
    assert said(capsys, SQUARE, "--effort", "40")[1].startswith(
        "Layout in blocks of 16 triangles, stopped early"
    )


def test_a_second_ctrl_c_stops_at_once_and_writes_nothing(capsys, tmp_path, monkeypatch):
    before = signal.default_int_handler
    signal.signal(signal.SIGINT, before)  # a shell starts what runs in the background deaf to Ctrl-C
    interrupted(monkeypatch, 2)
    code, out, err = said(capsys, SQUARE, *QUICK, "-o", str(tmp_path / "blocks.vtu"))
    assert (code, out, err) == (130, "", "interrupted\n")
    assert list(tmp_path.iterdir()) == []
    assert signal.getsignal(signal.SIGINT) is before


def test_a_terminal_sees_the_irregular_vertices_fall(written):
    ours, theirs = pty.openpty()
    command = [sys.executable, "-m", "bsgplan", "layout", SQUARE, "--effort", "600"]
    environment = {**os.environ, "TERM": "xterm"}
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=theirs, env=environment) as process:
        os.close(theirs)
        told = b""
        while chunk := next_bytes(ours):
            told += chunk
    assert process.returncode == 0
    assert re.search(rb"\d+ irregular vertices", told)


def next_bytes(stream: int) -> bytes:
    try:
        return os.read(stream, 4096)
    except OSError:  # the other end is closed
        return b""


def test_a_block_size_that_a_coast_cannot_carry_is_told_before_the_work(meshes):
    size = size_field(read(meshes / "north_sea.msh").mesh)
    domain = domain_of(size.mesh)
    said_so = advice(domain, size, 8)
    assert said_so is not None
    assert "64 triangles per block are pointless" in said_so
    assert "--tris-per-block 4 makes 1." in said_so
    assert advice(domain, size, 2) is None


def test_a_square_carries_blocks_of_any_size():
    size = size_field(read(SQUARE).mesh)
    assert [advice(domain_of(size.mesh), size, side) for side in (1, 2, 4, 8)] == [None] * 4


def test_the_warning_is_one_line_on_stderr(capsys, monkeypatch):
    monkeypatch.setattr("bsgplan.layout_pipeline.advice", lambda *_, **__: "pointless here")
    code, _, err = said(capsys, SQUARE, *QUICK)
    assert (code, err) == (0, "warning: pointless here\n")
