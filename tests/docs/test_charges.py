"""The table of discs in docs/theory is what scripts/make_charges.py makes."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NUMBER = re.compile(r"[+-]?\d*\.\d+")


def test_the_table_of_discs_is_what_the_script_makes() -> None:
    script = runpy.run_path(str(ROOT / "scripts" / "make_charges.py"))
    made = script["text"](script["table"]({name: script["load"](name) for name in script["FIELDS"]}))
    stored = (ROOT / "docs" / "theory" / "charges.txt").read_text()
    assert NUMBER.sub("#", made).split() == NUMBER.sub("#", stored).split()
    numbers = [[float(n) for n in NUMBER.findall(words)] for words in (made, stored)]
    assert numbers[0] == pytest.approx(numbers[1], abs=0.02)
