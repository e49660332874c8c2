"""Stored tables of the bench: read back as they were written, some cases measured anew."""

from __future__ import annotations

import importlib
from pathlib import Path
from types import ModuleType

import pytest

from bsgplan.report.table import Column, Table, text

ROOT = Path(__file__).parents[2]
HEADS = ("measured on one core", "value", "unit", "beside", "demand")


@pytest.fixture
def tables(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(ROOT / "scripts"))
    return importlib.import_module("benchmarks.stored")


@pytest.mark.parametrize(
    "path", sorted((ROOT / "docs" / "performance").glob("*.txt")), ids=lambda path: path.stem
)
def test_a_stored_table_is_read_as_it_was_written(tables: ModuleType, path: Path) -> None:
    rows = tables.stored(path)
    heads = HEADS if rows and len(rows[0]) == len(HEADS) else (*HEADS[:3], HEADS[4])
    title = path.read_text().splitlines()[0]
    assert text(Table(title, tuple(map(Column, heads)), tuple(rows))) + "\n" == path.read_text()


def test_cases_measured_anew_take_the_place_of_their_old_rows(tables: ModuleType) -> None:
    old = [("a: x", 1), ("a: y", 2), ("b: x", 3)]
    assert tables.merged(old, [("b: x", 4), ("c: x", 5)]) == [*old[:2], ("b: x", 4), ("c: x", 5)]
    assert tables.merged(old, [("a: x", 6)]) == [("a: x", 6), ("b: x", 3)]


def test_there_need_not_be_a_table(tables: ModuleType, tmp_path: Path) -> None:
    assert tables.stored(tmp_path / "none.txt") == []
