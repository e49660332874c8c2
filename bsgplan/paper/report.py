"""The noun Report and the verb reproduce: every table and figure of the paper, ours beside it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..report import Table
from ..report.table import Column, Value
from . import blocks, bounds, fronts, rectangles, region, replaced, squares, strips
from .item import Item, Section
from .printed import row_heading

SCHEMA = "bsgplan.paper/1"

SECTIONS: tuple[Callable[[], Section], ...] = (
    bounds.table_1,
    squares.figure_1,
    strips.figure_2,
    strips.figure_3,
    fronts.figure_4,
    fronts.figure_5,
    rectangles.figure_6,
    rectangles.figure_7,
    replaced.figure_8,
    region.figure_9,
    blocks.table_2,
    blocks.figure_10,
    blocks.patterns,
    bounds.equation_24,
    bounds.words,
)
"""In the order of the paper."""


@dataclass(frozen=True, eq=False)
class Report:
    """All sections."""

    sections: tuple[Section, ...]

    @property
    def items(self) -> tuple[Item, ...]:
        """All numbers."""
        return tuple(item for section in self.sections for item in section.items)

    @property
    def differing(self) -> tuple[Item, ...]:
        """Numbers of ours that do not show the correct digits."""
        return tuple(item for item in self.items if item.agrees is False)

    @property
    def slips(self) -> tuple[Item, ...]:
        """Numbers and words that the paper has wrong."""
        return tuple(item for item in self.items if item.is_slip)

    def document(self) -> dict[str, Any]:
        """Return the document `bsgplan.paper/1`."""
        return {
            "schema": SCHEMA,
            "agrees": not self.differing,
            "items": [item.document() for item in self.items],
            "figures": [f"{section.key}.png" for section in self.sections if section.figure],
            "skipped": {section.key: section.skipped for section in self.sections if section.skipped},
        }


def reproduce(progress: Callable[[str], None] = lambda _: None) -> Report:
    """Return the report; a few seconds. progress hears the name of each section before it is made."""
    sections = []
    for make in SECTIONS:
        progress(make.__name__.replace("_", " "))
        sections.append(make())
    return Report(tuple(sections))


def section_table(section: Section) -> Table:
    """Return the numbers of a section in the paper's form: under each heading the printed and our number.

    Printed numbers in brackets are not in the paper, or correct it.
    """
    rows = dict.fromkeys(item.row for item in section.items)
    columns = dict.fromkeys(item.column for item in section.items)
    by_place = {(item.row, item.column): item for item in section.items}
    has_printed = {c for c in columns if any(i.paper or i.correct for i in section.items if i.column == c)}
    headings = [Column(row_heading(section.key))]
    for column in columns:
        headings += [Column(column)] if column in has_printed else []
        headings += [Column("ours" if column in has_printed else f"{column}, ours")]
    cells: list[tuple[Value, ...]] = []
    for row in rows:
        line: list[Value] = [row]
        for column in columns:
            item = by_place.get((row, column))
            line += [None if item is None else printed_text(item)] if column in has_printed else []
            line += [None if item is None else f"{item.shown}{' !' if item.agrees is False else ''}"]
        cells.append(tuple(line))
    return Table("", tuple(headings), tuple(cells))


def printed_text(item: Item) -> str | None:
    """Return the paper's number, and in brackets the correct one where it is another.

    >>> printed_text(Item("table_1", "8", "q", "0.94", "0.95", 0.9473))
    '0.94 [0.95]'
    """
    if item.paper is None:
        return None if item.correct is None else f"[{item.correct}]"
    return f"{item.paper} [{item.correct}]" if item.is_slip else item.paper


def slips_table(report: Report) -> Table:
    """Return where the paper slips: its number, the correct one and ours; the reasons are its notes."""
    columns = tuple(Column(name) for name in ("", "where", "paper", "correct", "ours"))
    rows = tuple(
        (f"{k}", _where(report, i), i.paper, i.correct, i.shown) for k, i in enumerate(report.slips, 1)
    )
    notes = tuple(f"{k}. {item.reason}" for k, item in enumerate(report.slips, 1))
    return Table("Where the paper slips", columns, rows, notes)


def summary_table(report: Report) -> Table:
    """Return how many numbers of each section agree."""
    columns = tuple(Column(name) for name in ("section", "agree", "differ", "slips", "not compared"))
    rows: tuple[tuple[Value, ...], ...] = tuple(
        (
            section.title,
            *(sum(item.agrees is truth for item in section.items) for truth in (True, False)),
            sum(item.is_slip for item in section.items),
            sum(item.agrees is None for item in section.items),
        )
        for section in report.sections
    )
    notes = tuple(f"{section.title}: {section.skipped}" for section in report.sections if section.skipped)
    return Table("The paper, reproduced", columns, rows, notes)


def _where(report: Report, item: Item) -> str:
    section = next(s for s in report.sections if s.key == item.section)
    return f"{section.title.partition(':')[0]}: {item.name}"
