"""The tables of earlier runs in docs/performance: read back, so that some cases can be measured anew."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

Cells = tuple[str | float, ...]

VALUE = "value"


def stored(path: Path) -> list[Cells]:
    """Return the rows of a stored table, none where there is no file: what is measured, its value, the rest.

    Columns begin where the head has them; the value ends where its head ends.
    """
    if not path.exists():
        return []
    _, _, head, *lines = path.read_text().splitlines()
    end = head.index(VALUE) + len(VALUE)
    starts = [end + 2 + head[end + 2 :].index(word) for word in head[end:].split()] + [None]
    result: list[Cells] = []
    for line in lines:
        what, value = line[:end].rsplit(maxsplit=1)
        rest = (line[a:b].strip() for a, b in pairwise(starts))
        result.append((what.strip(), int(value) if value.lstrip("-").isdigit() else float(value), *rest))
    return result


def merged(old: list[Cells], new: list[Cells]) -> list[Cells]:
    """Return the old rows with those of each case that was measured anew in the place of its old ones."""
    anew: dict[str, list[Cells]] = {}
    for row in new:
        anew.setdefault(_case(row), []).append(row)
    result: list[Cells] = []
    for row in old:
        if _case(row) not in anew:
            result.append(row)
        else:
            result.extend(anew[_case(row)])
            anew[_case(row)] = []
    for rows in anew.values():
        result.extend(rows)
    return result


def _case(row: Cells) -> str:
    return str(row[0]).split(": ", 1)[0]
