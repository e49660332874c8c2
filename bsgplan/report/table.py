"""The noun Table: rows of plain values under columns with units, and five small renderers of it."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import Any

Value = str | int | float | None
"""A cell: None prints as a dash."""


QUALITY = "quality"
"""The format of a mean ratio."""


@dataclass(frozen=True)
class Column:
    """A column: its name, its unit, and the format of its numbers."""

    name: str
    unit: str = ""
    format: str = ".3g"
    is_right: bool = False
    """Words stand to the right too, as numbers do."""

    @property
    def heading(self) -> str:
        """Name and unit as printed."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


@dataclass(frozen=True)
class Table:
    """A titled table of plain values."""

    title: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Value, ...], ...]
    notes: tuple[str, ...] = ()
    """Sentences under the table."""

    def cells(self) -> list[list[str]]:
        """Return every cell as text, row by row."""
        return [[_text(v, c) for v, c in zip(row, self.columns, strict=True)] for row in self.rows]

    def _repr_html_(self) -> str:
        return html(self)


def text(table: Table) -> str:
    """Return a table as aligned plain text; numbers to the right, words to the left.

    Columns without any name have no line of names.

    >>> print(text(Table("", (Column("pattern"), Column("blocks")), (("7:4:1", 16), ("4:1", 5)))))
    pattern  blocks
    7:4:1        16
    4:1           5
    """
    cells = table.cells()
    widths = [
        max(len(c.heading), *(len(row[i]) for row in cells)) if cells else len(c.heading)
        for i, c in enumerate(table.columns)
    ]
    to_left = [_is_words(table, i) for i in range(len(widths))]
    headings = [c.heading for c in table.columns]
    lines = [headings, *cells] if any(headings) else cells
    body = [
        "  ".join(
            v.ljust(w) if left else v.rjust(w) for v, w, left in zip(line, widths, to_left, strict=True)
        )
        for line in lines
    ]
    head = [table.title, ""] if table.title else []
    return "\n".join(line.rstrip() for line in [*head, *body, *table.notes])


def html(table: Table) -> str:
    """Return a table as HTML, every text escaped."""
    head = "".join(f"<th>{escape(c.heading)}</th>" for c in table.columns)
    rows = "".join("<tr>" + "".join(f"<td>{escape(v)}</td>" for v in row) + "</tr>" for row in table.cells())
    notes = "".join(f"<p>{escape(note)}</p>" for note in table.notes)
    title = f"<caption>{escape(table.title)}</caption>" if table.title else ""
    return f"<table>{title}<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>{notes}"


def markdown(table: Table) -> str:
    """Return a table as Markdown, numbers to the right; the title is left to the heading above.

    >>> print(markdown(Table("", (Column("pattern"), Column("blocks")), (("7:4:1", 16),))))
    | pattern | blocks |
    | :-- | --: |
    | 7:4:1 | 16 |
    """
    rules = [":--" if i == 0 or _is_words(table, i) else "--:" for i in range(len(table.columns))]
    lines = [[c.heading for c in table.columns], rules, *table.cells()]
    body = "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines)
    return "\n\n".join([body, *table.notes])


def rich_table(table: Table) -> Any:
    """Return a table as a rich renderable, its notes below."""
    from rich.console import Group
    from rich.markup import escape as plain
    from rich.table import Table as RichTable

    has_head = any(column.heading for column in table.columns)
    title = plain(table.title) or None
    result = RichTable(title=title, title_justify="left", header_style="bold", show_header=has_head)
    for i, column in enumerate(table.columns):
        result.add_column(plain(column.heading), justify="left" if _is_words(table, i) else "right")
    for row in table.cells():
        result.add_row(*(plain(v) for v in row))
    return Group(result, *(plain(note) for note in table.notes))


def _text(value: Value, column: Column) -> str:
    if value is None:
        return "-"
    return number(value, column.format) if isinstance(value, float) else str(value)


def number(value: float, how: str) -> str:
    """Return a number as text: with `QUALITY` two decimals, or one digit where those would show 0.

    >>> number(0.8, QUALITY), number(0.00041, QUALITY)
    ('0.80', '0.0004')
    """
    if how != QUALITY:
        return format(value, how)
    return f"{value:.2f}" if abs(value) >= 0.01 else f"{value:.1g}"


def _is_words(table: Table, i: int) -> bool:
    if table.columns[i].is_right:
        return False
    values = [row[i] for row in table.rows if row[i] is not None]
    return bool(values) and all(isinstance(v, str) for v in values)
