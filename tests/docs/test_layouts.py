"""What docs/layout.md shows: the document has the keys of today, estimates hold in the table of cases."""

from __future__ import annotations

import json
import re
import runpy
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
MAKE = runpy.run_path(str(ROOT / "scripts" / "make_docs.py"))
TABLE = (ROOT / "docs/layout/cases.md").read_text().splitlines()
STORED = json.loads((ROOT / "docs/layout/plate.json").read_text())


def shape(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: shape(item) for key, item in value.items()}
    return [shape(item) for item in value] if isinstance(value, list) else type(value).__name__


def test_the_stored_document_is_like_the_one_made_today():
    made = json.loads(MAKE["document"](MAKE["LAYOUT_DOCUMENT"]))
    assert shape(made) == shape(STORED)
    assert made["input"]["irregularity"] == STORED["input"]["irregularity"]
    assert made["input"]["edge_ratio"] == pytest.approx(STORED["input"]["edge_ratio"])
    assert made["layout"]["n_blocks"] == pytest.approx(STORED["layout"]["n_blocks"], rel=0.1)


def test_the_table_has_a_row_for_every_case_and_estimates_are_within_15_percent():
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in TABLE[2:]]
    assert [row[0] for row in rows] == list(MAKE["CASES"])
    for name, _, limited, laid_out, *_ in rows:
        assert abs(int(laid_out) / int(limited) - 1) <= 0.15, name


def test_the_layout_has_far_fewer_irregular_vertices_than_the_input():
    for line in TABLE[2:]:
        before, after = (int(cell) for cell in re.findall(r"\d+", line)[-2:])
        assert after <= before / 10, line
