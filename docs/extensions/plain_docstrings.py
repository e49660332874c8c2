"""Docstrings of the house are plain text with `code` in it: keep length**2 and |x| from reading as markup."""

from __future__ import annotations

import re
from typing import Any


def escape(line: str) -> str:
    """Return a line of plain text as reStructuredText that says the same; `code` becomes a literal."""
    pieces = re.split(r"`+([^`]+)`+", line)
    pieces[::2] = [re.sub(r"([*|_\\])", r"\\\1", piece) for piece in pieces[::2]]
    pieces[1::2] = [f"``{piece}``" for piece in pieces[1::2]]
    return "".join(pieces)


def process(_app: Any, _what: str, _name: str, _obj: Any, _options: Any, lines: list[str]) -> None:
    """Escape every line outside doctests, in place as autodoc wants it."""
    in_doctest = False
    for i, line in enumerate(lines):
        in_doctest = line.lstrip().startswith(">>>") or (in_doctest and bool(line.strip()))
        if not in_doctest:
            lines[i] = escape(line)


def setup(app: Any) -> dict[str, bool]:
    """Listen to autodoc."""
    app.connect("autodoc-process-docstring", process)
    return {"parallel_read_safe": True}
