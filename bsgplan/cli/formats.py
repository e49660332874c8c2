"""The list behind `bsgplan info --formats`: what is read, what is written, and what has a place there."""

from __future__ import annotations

from typing import Any

from ..io.formats import FORMATS, Format
from ..report.table import Column, Table


def format_table() -> Table:
    """Return the registry of formats as a table, one row a format."""
    names = ("name", "suffixes", "read", "written", "needs", "what it is", "keeps")
    return Table(
        "Mesh formats",
        tuple(Column(name) for name in names),
        tuple(_row(found) for found in FORMATS),
        ("The content of a file decides before its suffix; to write, --format takes a name.",),
    )


def format_document() -> list[dict[str, Any]]:
    """Return the same as plain data for a JSON document."""
    return [
        {
            "name": found.name,
            "suffixes": list(found.suffixes),
            "what": found.what,
            "is_read": found.reader is not None,
            "is_written": found.writer is not None,
            "extra": found.extra,
            "keeps": found.keeps,
        }
        for found in FORMATS
    ]


def _row(found: Format) -> tuple[str | None, ...]:
    return (
        found.name,
        " ".join(found.suffixes) or None,
        "yes" if found.reader else None,
        "yes" if found.writer else None,
        found.extra,
        found.what,
        found.keeps or None,
    )
