"""What the pages say in words holds: Python, constants, options, exit codes, keys, arrays, folders, links."""

from __future__ import annotations

import doctest
import importlib
import inspect
import json
import re
from pathlib import Path
from typing import Any

import meshio
import pytest

from bsgplan.cli import errors
from bsgplan.cli.convert import convert
from bsgplan.cli.estimate import estimate
from bsgplan.cli.export import export
from bsgplan.cli.info import info
from bsgplan.cli.layout import layout
from bsgplan.cli.paper import paper
from bsgplan.cli.pattern import pattern
from bsgplan.cli.patterns import patterns
from bsgplan.cli.replace import replace
from bsgplan.cli.sweep import sweep

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = sorted(DOCS.glob("*.md"))
BOOK = (DOCS / "command-line.md").read_text()


def code(page: Path, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(), flags=re.M | re.S)


def section(heading: str) -> str:
    return BOOK.split(f"## {heading}\n")[1].split("\n## ")[0]


@pytest.mark.parametrize("page", [p for p in PAGES if ">>> " in p.read_text()], ids=lambda p: p.name)
def test_python_on_a_page_runs_and_prints_what_it_shows(page: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    assert page.read_text().count("\n>>> ") == sum(b.count(">>> ") for b in code(page, "pycon"))
    test = doctest.DocTestParser().get_doctest("\n".join(code(page, "pycon")), {}, page.name, str(page), 0)
    told: list[str] = []
    result = doctest.DocTestRunner(verbose=False).run(test, out=told.append)
    assert result.attempted > 0
    assert result.failed == 0, "".join(told)


def test_the_python_of_the_readme_runs(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    (block,) = code(ROOT / "README.md", "python")
    exec(compile(block, "README.md", "exec"), {})
    assert re.fullmatch(r"\d+ \d+\n", capsys.readouterr().out)


def test_constants_on_the_pages_are_those_of_the_code() -> None:
    quoted = [
        q for page in PAGES for q in re.findall(r"`([a-z_.]+)\.([A-Z_]+)` = ([\d.]*\d)", page.read_text())
    ]
    assert len(quoted) >= 10
    for module, name, number in quoted:
        there = getattr(importlib.import_module(f"bsgplan.{module}"), name)
        assert float(number) == pytest.approx(there), f"{module}.{name}"


def test_every_option_is_explained_and_none_is_made_up() -> None:
    commands = (convert, estimate, export, info, layout, pattern, patterns, paper, replace, sweep)
    names = {name for command in commands for name in inspect.signature(command).parameters}
    names -= {"file", "files", "counts", "ends"}
    options = {f"--{name.replace('_', '-')}" for name in names} | {"--debug", "--help"}
    rows = set(re.findall(r"^\| `(--[a-z-]+)`", BOOK, flags=re.M))
    assert rows == options
    for page in [*PAGES, ROOT / "README.md"]:
        lines = re.findall(r"^(?:\$ )?bsgplan .*", page.read_text(), flags=re.M)
        used = {word for line in lines for word in re.findall(r"--[a-z-]+", line)}
        assert used <= options | {"--version"}, page.name


@pytest.mark.parametrize("command", [estimate, layout], ids=["estimate", "layout"])
def test_defaults_in_the_table_of_options_are_those_of_the_program(command: Any) -> None:
    parameters = inspect.signature(command).parameters
    table = section(f"Options of {command.__name__}")
    for option, default in re.findall(r"^\| `--([a-z-]+)` \| `?([\w.]+)`? \|", table, flags=re.M):
        there = parameters[option.replace("-", "_")].default
        if there is not None:
            assert str(there) == default, option


def test_exit_codes_are_all_explained() -> None:
    codes = {value for name, value in vars(errors).items() if name.isupper() and isinstance(value, int)}
    assert {int(row) for row in re.findall(r"^\| (\d+) \|", section("Exit codes"), flags=re.M)} == codes


@pytest.mark.parametrize("name", ["examples/info", "examples/estimate", "layout/plate"])
def test_every_key_of_a_document_is_explained(name: str) -> None:
    document = json.loads((DOCS / f"{name}.json").read_text())
    words = set(re.findall(r"`(\w+)`", section("JSON documents")))
    variable = {"ignored", "arrays", "boundaries"}  # their keys are those of the file
    assert not {key for key in keys(document, variable) if key not in words}


def keys(value: Any, leave: set[str]) -> set[str]:
    if isinstance(value, list):
        return {key for item in value for key in keys(item, leave)}
    if not isinstance(value, dict):
        return set()
    below = {key for k, item in value.items() if k not in leave for key in keys(item, leave)}
    return set(value) | below


def test_vtk_arrays_are_those_of_the_files(tmp_path: Path) -> None:
    import bsgplan

    result = bsgplan.plan_blocks(bsgplan.read(ROOT / "cases/rectangle/mesh.msh"))
    result.write_vtk(tmp_path / "plan.vtu")
    result.write_vtk_patterns(tmp_path / "patterns.vtu")
    cells, points, patterns = (
        set(
            re.findall(
                r"`(\w+)`", "\n".join(line.split("|")[1] for line in table.splitlines() if line[:1] == "|")
            )
        )
        for table in re.split(r"^\| (?:cell|point) array \| meaning \|$", section("VTK files"), flags=re.M)[
            1:
        ]
    )
    plan = meshio.read(tmp_path / "plan.vtu")
    assert cells == set(plan.cell_data)
    assert points == set(plan.point_data)
    assert patterns == set(meshio.read(tmp_path / "patterns.vtu").cell_data)


def test_the_picture_of_the_folders_shows_what_there_is() -> None:
    package = ROOT / "bsgplan"
    picture = code(DOCS / "architecture.md", "")[1].split("cases/")[0]
    shown, folder = set(), package
    for line in picture.splitlines()[1:]:
        if (head := re.match(r"  ([\w/]+)(/|\.py)", line)) is not None:
            folder = package / head[1] if head[2] == "/" else package
            shown.add(folder)
        for name in re.findall(r"\w+\.py", line):
            assert (folder / name).is_file(), f"{folder.name}/{name}"
    assert shown == {path.parent for path in package.rglob("__init__.py")}


def test_links_lead_to_files() -> None:
    for page in [*PAGES, ROOT / "README.md"]:
        for target in re.findall(r"\]\(([^)#]+?)(?:#[^)]*)?\)", page.read_text()):
            assert target.startswith("http") or (page.parent / target).exists(), f"{page.name}: {target}"


def test_the_commands_of_the_pages_name_cases_that_exist() -> None:
    for page in [*PAGES, ROOT / "README.md"]:
        for path in re.findall(r"cases/[a-z]+/mesh\.msh", page.read_text()):
            assert (ROOT / path).is_file(), f"{page.name}: {path}"
