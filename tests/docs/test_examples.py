"""What the documentation shows is what the program does: stored examples are run again and compared."""

from __future__ import annotations

import json
import math
import re
import runpy
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
MAKE = runpy.run_path(str(ROOT / "scripts" / "make_docs.py"))
AGAIN = "run scripts/make_docs.py and read what changed"

TEXT_TOLERANCE = 0.02
"""Numbers in texts are rounded, and the last digit may differ between machines."""

JSON_TOLERANCE = 1e-6
"""Numbers of documents, relative; the solvers stop early, but at the same step."""


def tokens(text: str) -> list[str]:
    return re.findall(r"[+-]?\d[\d,]*(?:\.\d+)?|\.\d+|[^\W\d]+|[^\s\w]", text)


def value(token: str) -> float | None:
    try:
        return float(token.replace(",", ""))
    except ValueError:
        return None


def differences(stored: str, made: str) -> list[str]:
    """Return what differs between two texts: words and order exactly, numbers within the tolerance."""
    old, new = tokens(stored), tokens(made)
    if len(old) != len(new):
        return [f"{len(old)} words and numbers stored, {len(new)} now"]
    pairs = [(a, b, value(a), value(b)) for a, b in zip(old, new, strict=True)]
    return [
        f"{a} -> {b}"
        for a, b, x, y in pairs
        if a != b and (x is None or y is None or not math.isclose(x, y, rel_tol=TEXT_TOLERANCE))
    ]


def document_differences(old: Any, new: Any, where: str = "") -> list[str]:
    if isinstance(old, dict) and isinstance(new, dict):
        missing = [f"{where}.{key}" for key in old.keys() ^ new.keys()]
        return missing + [
            d
            for key in old.keys() & new.keys()
            for d in document_differences(old[key], new[key], f"{where}.{key}")
        ]
    if isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        return [
            d
            for i, (a, b) in enumerate(zip(old, new, strict=True))
            for d in document_differences(a, b, f"{where}[{i}]")
        ]
    if isinstance(old, float) and isinstance(new, float):
        same = math.isclose(old, new, rel_tol=JSON_TOLERANCE, abs_tol=JSON_TOLERANCE)
    else:
        same = old == new
    return [] if same else [f"{where}: {old!r} -> {new!r}"]


@pytest.mark.parametrize("name", MAKE["TEXTS"])
def test_a_stored_transcript_is_what_the_command_says(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NO_COLOR", "1")
    stored = (DOCS / "examples" / name).read_text()
    assert not differences(stored, MAKE["transcript"](MAKE["TEXTS"][name])), AGAIN


@pytest.mark.parametrize("name", MAKE["DOCUMENTS"])
def test_a_stored_document_is_what_the_command_prints(name: str) -> None:
    stored = json.loads((DOCS / "examples" / name).read_text())
    made = json.loads(MAKE["document"](MAKE["DOCUMENTS"][name]))
    assert not document_differences(stored, made), AGAIN


def test_every_example_is_stored_and_shown() -> None:
    pages = "\n".join(page.read_text() for page in DOCS.glob("*.md"))
    stored = {path.name for path in (DOCS / "examples").iterdir()}
    assert stored == {*MAKE["TEXTS"], *MAKE["DOCUMENTS"]}
    assert stored == set(re.findall(r"\{literalinclude\} examples/(\S+)", pages))


def test_a_changed_number_is_noticed() -> None:
    assert not differences("q 0.75, 1,114 blocks", "q 0.76, 1,115 blocks")
    for stored, made in (("7:4:2:1", "7:4:1:1"), ("+2 -2", "+2 +2"), ("a 1", "b 1"), ("a 1", "a 1 1")):
        assert differences(stored, made)


def test_pictures_are_there_and_small() -> None:
    pages = [*DOCS.glob("*.md"), ROOT / "README.md"]
    shown = {name for page in pages for name in re.findall(r"pictures/(\S+?\.png)", page.read_text())}
    sizes = {path.name: path.stat().st_size for path in (DOCS / "pictures").iterdir()}
    assert shown == set(sizes) == {f"{name}.png" for name in MAKE["DRAWN"]}
    assert max(sizes.values()) <= MAKE["LARGEST_PICTURE"]
    assert sum(sizes.values()) < 2_000_000
