"""A sweep's table: one row a file and block size, whatever fails, is interrupted or dies."""

from __future__ import annotations

import csv
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from bsgplan import plan_blocks, read, write
from bsgplan.cli import main
from bsgplan.errors import InvalidOption, MeshReadError, OutputError
from bsgplan.sweep import sweep
from bsgplan.sweep.engine import local
from bsgplan.sweep.job import COLUMNS, Options, job
from bsgplan.sweep.table import DIED
from bsgplan.sweep.work import plan_rows

CASES = Path(__file__).parents[2] / "cases"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("rectangle", "square"):
        shutil.copy(CASES / name / "mesh.msh", tmp_path / f"{name}.msh")
    (tmp_path / "bad.msh").write_text("no mesh, but, a comma\n")
    return tmp_path


def table(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert all(set(row) == set(COLUMNS) and None not in row.values() for row in rows)
    return rows


def is_alive(group: int) -> bool:
    """Return whether a process group has a process."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def test_one_row_a_file_and_block_size_and_bad_files_are_rows(folder: Path) -> None:
    out = folder / "sweep.csv"
    rows = sweep([str(folder / "*.msh")], out, block_sizes=(4, 16), n_workers=2)
    asked = [
        (str(folder / name), n) for name in ("bad.msh", "rectangle.msh", "square.msh") for n in ("4", "16")
    ]
    assert [(row["file"], row["tris_per_block"]) for row in rows] == asked
    assert sorted((row["file"], row["tris_per_block"]) for row in table(out)) == sorted(asked)
    assert [bool(row["error"]) for row in rows] == [True, True, False, False, False, False]
    plan = plan_blocks(read(folder / "rectangle.msh"), tris_per_block=16).plan
    assert int(rows[3]["blocks"]) == plan.n_blocks
    assert float(rows[3]["q_min"]) == pytest.approx(plan.q_min, rel=1e-5)


def test_an_interrupted_sweep_keeps_whole_rows_and_drops_the_partial_one(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, asked = folder / "sweep.csv", [str(folder / "*.msh")]
    first = sweep(asked, out, block_sizes=(16,), n_workers=1)
    whole = out.read_text()
    out.write_text(whole[:-20])  # killed while the last row was written
    planned = []

    def recorded(jobs, n_workers):
        planned.extend(job.file for job in jobs)
        return local(jobs, n_workers)

    monkeypatch.setattr("bsgplan.sweep.sweeping.local", recorded)
    again = sweep(asked, out, block_sizes=(16,), n_workers=1)
    assert len(planned) == 1
    assert [{**row, "cpu_seconds": ""} for row in again] == [{**row, "cpu_seconds": ""} for row in first]
    assert len(table(out)) == 3
    sweep(asked, out, block_sizes=(16,), n_workers=1)
    assert len(planned) == 1  # all there: nothing is planned


def test_a_changed_file_or_option_is_planned_anew_and_other_rows_stay(folder: Path) -> None:
    out, mesh = folder / "sweep.csv", folder / "square.msh"
    (old,) = sweep([str(mesh)], out)
    shutil.copy(folder / "rectangle.msh", mesh)
    (new,) = sweep([str(mesh)], out)
    assert old["content"] != new["content"]
    assert table(out) == [new]
    sweep([str(mesh)], out, options=Options(objective="blocks"))
    assert [row["options"].split()[0] for row in table(out)] == ["objective=balanced", "objective=blocks"]


def test_sizes_come_from_a_file_and_a_changed_one_is_planned_anew(folder: Path) -> None:
    """The plans of `estimate --size-file`, at any place the sweep is started from."""
    mesh, sizes, out = folder / "square.msh", folder / "sizes.pos", folder / "sweep.csv"
    view = 'View "h" {{ST(-9,-9,0,29,-9,0,-9,29,0){{{0},{0},{0}}};}};'
    asked = Options(size_file=str(sizes))
    plain = read(mesh).mesh
    h = float(plain.edge_lengths.mean())
    found = []
    for size in (h, h / 2):
        sizes.write_text(view.format(size))
        (row,) = sweep([str(mesh)], out, options=asked, n_workers=1)
        found.append(row)
        plan = plan_blocks(read(mesh), size_file=sizes).plan
        assert int(row["blocks"]) == plan.n_blocks
    assert found[0]["content"] != found[1]["content"]
    assert table(out) == found[1:]
    assert int(found[1]["blocks"]) == pytest.approx(4 * int(found[0]["blocks"]), rel=0.1)
    sizes.write_text(view.format(0))
    (row,) = sweep([str(mesh)], out, options=asked, n_workers=1)
    assert "sizes.pos" in row["error"]
    sizes.unlink()
    with pytest.raises(MeshReadError, match="no such file for --size-file"):
        sweep([str(mesh)], out, options=asked)


def test_a_changed_companion_is_planned_anew(folder: Path) -> None:
    """Of a .node with its .ele either is the mesh."""
    write(read(folder / "square.msh"), folder / "square.node")
    first = job(str(folder / "square.node"), (16,), Options())
    with (folder / "square.ele").open("a") as stream:
        stream.write("# changed\n")
    assert job(str(folder / "square.node"), (16,), Options()).content != first.content


def test_a_table_of_something_else_is_left_alone(folder: Path) -> None:
    out = folder / "other.csv"
    out.write_text("a,b\n1,2\n")
    with pytest.raises(OutputError, match="first line"):
        sweep([str(folder / "square.msh")], out)
    assert out.read_text() == "a,b\n1,2\n"


def test_a_pattern_without_files_is_an_error(folder: Path) -> None:
    with pytest.raises(MeshReadError, match=r"no file matches"):
        sweep([str(folder / "*.14")], folder / "sweep.csv")


def test_a_missing_file_given_by_name_is_a_row(folder: Path) -> None:
    (row,) = sweep([str(folder / "gone.msh")], folder / "sweep.csv", n_workers=1)
    assert "no such file" in row["error"]


def test_the_command_ends_with_1_where_a_row_failed(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = folder / "sweep.csv"
    assert main(["sweep", str(folder / "*.msh"), "--out", str(out), "--workers", "1"]) == 1
    printed = capsys.readouterr()
    assert printed.out == f"3 rows in {out}, 1 with an error\n"
    assert "bad.msh" in printed.err
    assert len(printed.err.splitlines()) == 1
    assert main(["sweep", str(folder / "square.msh"), "--out", str(out)]) == 0


def test_a_mesh_that_kills_its_worker_is_a_row_and_the_others_are_planned(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A plug-in of the workers kills the process that opens bad.msh: as the kernel does out of memory."""
    site = folder / "site"
    site.mkdir()
    (site / "sitecustomize.py").write_text(
        "import os, pathlib, signal\n"
        "opened = pathlib.Path.open\n"
        "def deadly(self, *args, **options):\n"
        "    if self.name == 'bad.msh':\n"
        "        os.kill(os.getpid(), signal.SIGKILL)\n"
        "    return opened(self, *args, **options)\n"
        "pathlib.Path.open = deadly\n"
    )
    jobs = [job(str(folder / name), (16,), Options()) for name in ("bad.msh", "rectangle.msh", "square.msh")]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(site), os.environ.get("PYTHONPATH", "")]))
    rows = {row["file"]: row for (row,) in local(jobs, 2)}
    assert len(rows) == 3
    assert [bool(rows[one.file]["error"]) for one in jobs] == [True, False, False]
    assert rows[jobs[0].file]["error"].startswith(DIED)


def test_ctrl_c_ends_the_workers_too_and_the_sweep_goes_on_later(folder: Path) -> None:
    """A plug-in of the workers lets one mesh take ten minutes, as a large one might."""
    site, out = folder / "site", folder / "sweep.csv"
    site.mkdir()
    (site / "sitecustomize.py").write_text(
        "import pathlib, time\n"
        "opened = pathlib.Path.open\n"
        "def slow(self, *args, **options):\n"
        "    if self.name == 'square.msh' and __import__('multiprocessing').parent_process():\n"
        "        time.sleep(600)\n"
        "    return opened(self, *args, **options)\n"
        "pathlib.Path.open = slow\n"
    )
    start = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
    start += "from bsgplan.cli import main; raise SystemExit(main())"
    words = ["sweep", str(folder / "*.msh"), "--out", str(out), "--workers", "1"]
    paths = os.pathsep.join([str(site), *sys.path])
    process = subprocess.Popen(
        [sys.executable, "-c", start, *words], env={**os.environ, "PYTHONPATH": paths}, start_new_session=True
    )
    patience = time.monotonic() + 120
    while not (out.exists() and out.read_text().count("\n") == 3):
        assert time.monotonic() < patience
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to the workers as well
    assert process.wait(60) == 130
    while is_alive(process.pid):  # nothing is left, a moment later
        assert time.monotonic() < patience
        time.sleep(0.05)
    assert [Path(row["file"]).name for row in table(out)] == ["bad.msh", "rectangle.msh"]
    rows = sweep([str(folder / "*.msh")], out, n_workers=1)
    assert [bool(row["error"]) for row in rows] == [True, False, False]


def test_a_cluster_survives_the_death_of_a_worker(folder: Path) -> None:
    """Two workers on this machine, one of them killed while the meshes are planned."""
    distributed = pytest.importorskip("distributed")
    for k in range(6):
        shutil.copy(CASES / "plate" / "mesh.msh", folder / f"plate{k}.msh")
    out, killed = folder / "sweep.csv", []
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
    ) as cluster:
        victim = cluster.workers[0].pid

        def kill_once(_: str) -> None:
            if not killed:
                killed.append(victim)
                os.kill(victim, signal.SIGKILL)

        rows = sweep([str(folder / "*.msh")], out, scheduler=cluster.scheduler_address, progress=kill_once)
    assert killed
    assert {row["file"]: bool(row["error"]) for row in rows} == {
        str(path): path.name == "bad.msh" for path in folder.glob("*.msh")
    }
    assert len({row["blocks"] for row in rows if "plate" in row["file"]}) == 1
    assert len(table(out)) == len(rows) == 9


def test_no_scheduler_is_an_error_of_one_line(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("bsgplan.sweep.engine.CONNECTING", 0.5)
    start = time.monotonic()
    with pytest.raises(InvalidOption, match="no scheduler answers"):
        sweep([str(folder / "square.msh")], folder / "s.csv", scheduler="tcp://127.0.0.1:1")
    assert time.monotonic() - start < 60


def test_a_row_tells_what_was_warned_of(meshes: Path) -> None:
    rows = plan_rows(job(str(meshes / "hanging_nodes.mesh"), (4, 16), Options(split_quads=True)))
    assert [row["error"] for row in rows] == ["", ""]
    assert [row["warnings"].startswith("4 hanging nodes (12, 14, 16, 18, from 0)") for row in rows] == [
        True
    ] * 2
    (row,) = plan_rows(job(str(meshes / "shinnecock_inlet.fort.14"), (64,), Options()))
    assert row["warnings"].startswith("the coordinates look like degrees")
    (row,) = plan_rows(job(str(meshes / "hanging_nodes.mesh"), (4,), Options()))
    assert row["warnings"] == ""
    assert row["error"].startswith("no triangles")


def test_rows_of_a_job_are_plain_text(folder: Path) -> None:
    rows = plan_rows(job(str(folder / "square.msh"), (4, 16), Options()))
    assert [row["tris_per_block"] for row in rows] == ["4", "16"]
    assert all(isinstance(value, str) for row in rows for value in row.values())
