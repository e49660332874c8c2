"""`bsgplan paper` in process: files, documents, exit codes, and every number of the paper."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from bsgplan.cli import main
from bsgplan.paper import Report, Section, region, remesher, report, reproduce, strips
from bsgplan.paper.item import items_of
from bsgplan.paper.printed import TABLES, printed
from bsgplan.paper.write import page, write_report
from bsgplan.patterns import Pattern, Shape, best_spacing, realise, vertex_irregularity_of_fronts

PAGE = Path(__file__).parents[2] / "docs" / "paper.md"
REMESHER = re.compile(r"^(\| a, isotropic|\| (\w+: )?Figure [67]:|Skipped:|Figure [67]:|\| mesh \|)")
"""Lines that depend on whether mmg is installed."""


@pytest.fixture(scope="module")
def made() -> Report:
    return reproduce()


def ours(made: Report, section: str, row: str, column: str) -> object:
    (item,) = (i for i in made.items if (i.section, i.row, i.column) == (section, row, column))
    return item.ours


def test_every_number_of_ours_is_the_correct_one(made: Report) -> None:
    assert [(i.section, i.name, i.ours, i.correct) for i in made.items if i.agrees is False] == []


def test_every_printed_number_has_one_of_ours_beside_it(made: Report) -> None:
    assert {s.key for s in made.sections} == set(TABLES)
    without = {(i.section, i.row) for i in made.items if i.ours is None and i.correct is not None}
    assert without == {("words", "a size function may be")}
    assert sum(len(printed(s)) for s in TABLES) == sum(
        i.paper is not None or i.correct is not None for i in made.items
    )


def test_numbers_that_the_brief_of_the_paper_names(made: Report) -> None:
    assert [ours(made, "figure_1", "c, edge flipped", c) for c in ("iota", "iota+", "iota-")] == [-6, 1, -7]
    assert ours(made, "figure_6", "b, 40:39:..:10", "triangles") == 1500
    assert ours(made, "figure_6", "b, fronts at best positions", "q_min") == pytest.approx(0.803, abs=5e-4)
    assert ours(made, "figure_7", "b, 128:64:..:1", "triangles") == 381
    assert ours(made, "table_2", "triangles, 16 a block", "7:5:3:1") == 384
    assert ours(made, "equation_24", "18578 triangles, 16 a block", "paper") == 1161.125
    assert 10 <= ours(made, "figure_9", "fronts", "paper") <= 11
    assert ours(made, "figure_6", "b, 40:39:..:10", "irregular vertices") == 2


def test_4_2_1_and_4_3_2_1_cross_just_under_a_length_of_1() -> None:
    short, long = (Pattern.parse(text) for text in ("4:2:1", "4:3:2:1"))
    gain = [
        best_spacing(long, Shape.rectangle(x)).q_min - best_spacing(short, Shape.rectangle(x)).q_min
        for x in (0.93, 0.99)
    ]
    assert gain[0] < 0 < gain[1]


@pytest.mark.parametrize("text", strips.PATTERNS)
def test_negative_irregularity_lies_on_the_front_with_more_elements(text: str) -> None:
    realised = realise(Pattern.parse(text), Shape.rectangle(1.0), np.array([0.0, 1.0]))
    first, second = vertex_irregularity_of_fronts(realised)
    assert (first.positive, second.negative) == (0, 0)


def test_the_package_loads_no_pictures_and_no_remesher() -> None:
    words = "import sys, bsgplan.paper; print(sorted({'matplotlib', 'mmgpy', 'meshio'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_all_slips_are_told_with_their_reason(made: Report) -> None:
    assert len(made.slips) == 10
    assert all(item.reason and item.agrees is not False for item in made.slips)
    text = page(made)
    assert all(item.reason in text for item in made.slips)


def test_the_command_writes_report_document_and_pictures(
    made: Report, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(report, "reproduce", lambda _: made)
    assert main(["paper", "--out", str(tmp_path / "report"), "--json"]) == 0
    out, err = capsys.readouterr()
    document = json.loads(out)
    assert err == ""
    assert (document["schema"], document["agrees"]) == ("bsgplan.paper/1", True)
    keys = {"section", "name", "paper", "ours", "correct", "agrees", "is_slip", "reason"}
    assert all(set(item) == keys for item in document["items"])
    folder = tmp_path / "report"
    assert json.loads((folder / "report.json").read_text()) == document
    pictures = {path.name for path in folder.glob("*.png")}
    drawn = {f"figure_{n}.png" for n in range(1, 11)}
    assert pictures == set(document["figures"]) == drawn
    assert all((folder / name).read_bytes()[:4] == b"\x89PNG" for name in pictures)
    assert set(re.findall(r"\]\((\w+\.png)\)", (folder / "report.md").read_text())) == pictures
    assert [path.name for path in tmp_path.iterdir()] == ["report"]
    assert folder.stat().st_mode & 0o700 == 0o700


def test_a_number_that_differs_is_exit_code_1_and_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    off = Section("figure_1", "Figure 1", "Off.", items_of("figure_1", {("b, refined", "iota"): -5}))
    monkeypatch.setattr(report, "SECTIONS", (lambda: off,))
    monkeypatch.setattr(report.SECTIONS[0], "__name__", "off", raising=False)
    assert main(["paper", "--out", str(tmp_path / "report")]) == 1
    out, err = capsys.readouterr()
    assert "Figure 1" in out
    assert err.startswith("error: 1 of 9 numbers differ, first figure_1, b, refined, iota: -5, not -6")
    assert "-5 !" in (tmp_path / "report" / "report.md").read_text()


def test_an_error_leaves_the_folder_as_it_was(tmp_path: Path) -> None:
    folder = tmp_path / "report"
    folder.mkdir()
    (folder / "report.md").write_text("before")

    def fails() -> None:
        raise RuntimeError("no figure")

    broken = Section("figure_1", "Figure 1", "", items_of("figure_1", {}), fails)  # type: ignore[arg-type]
    with pytest.raises(RuntimeError, match="no figure"):
        write_report(Report((strips.figure_2(), broken)), folder)
    assert [path.name for path in tmp_path.rglob("*")] == ["report", "report.md"]
    assert (folder / "report.md").read_text() == "before"
    write_report(Report((strips.figure_2(),)), folder)
    assert sorted(path.name for path in folder.iterdir()) == ["figure_2.png", "report.json", "report.md"]


def test_a_folder_that_cannot_be_is_exit_code_3(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").write_text("")
    assert main(["paper", "--out", str(tmp_path / "file")]) == 3
    assert "is a file; give a folder" in capsys.readouterr().err
    assert main(["paper", "--out", str(tmp_path / "no" / "report")]) == 3
    assert "does not exist; create it first" in capsys.readouterr().err
    assert main(["paper"]) == 2


def test_without_the_case_figure_9_is_skipped_and_says_so(tmp_path: Path) -> None:
    section = region.figure_9(tmp_path)
    assert "cases/rectangle is not there" in section.skipped
    assert all(item.ours is None and item.agrees is None for item in section.items)
    assert "Skipped: not measured" in page(Report((section,)))


def test_without_mmg_the_remeshed_figures_say_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mmgpy", None)
    with pytest.raises(remesher.NoRemesher, match="pip install"):
        remesher.remeshed(1.0, lambda x: 0.2 + 0 * x)


def test_with_mmg_a_rectangle_is_remeshed_to_its_size() -> None:
    pytest.importorskip("mmgpy")
    mesh = remesher.remeshed(1.0, lambda x: 0.1 + 0 * x)
    assert mesh.area == pytest.approx(1.0)
    assert 150 < mesh.n_triangles < 350  # equilateral triangles of edge .1 are 231
    assert mesh.qualities.min() > 0.4


def test_the_page_of_the_docs_is_what_the_command_makes(made: Report) -> None:
    stored, now = (
        [line for line in text.splitlines() if not REMESHER.match(line)]
        for text in (PAGE.read_text().replace("](pictures/paper_", "]("), page(made))
    )
    assert [line for line in stored if line] == [line for line in now if line], "run scripts/make_docs.py"
