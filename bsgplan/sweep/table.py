"""The CSV file of a sweep: whole rows only, at any time, also where the sweep was interrupted.

Rows are added one write at a time. An interrupted sweep can leave a last line without its end; it is dropped
when the file is opened again, and so are rows of a file that has changed since.
"""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from ..atomic import replacing, unwritten
from ..errors import OutputError
from .job import COLUMNS, KEY, Job, Key, Row


def key_of(row: Row) -> Key:
    """Return what tells a row from any other."""
    file, tris_per_block, options, content, version = (row[name] for name in KEY)
    return file, tris_per_block, options, content, version


def read_rows(path: Path) -> list[Row]:
    """Return the whole rows of a sweep's file, none where there is no file; raises OutputError for others."""
    try:
        text = path.read_bytes().decode()
    except FileNotFoundError:
        return []
    except (OSError, UnicodeDecodeError):
        raise OutputError(f"{path}: is there and is no table of a sweep; give another name") from None
    whole = text[: text.rfind("\n") + 1]
    lines = list(csv.reader(io.StringIO(whole)))
    if not text or text == _line(COLUMNS)[: len(text)]:  # interrupted before its first row
        return []
    if not lines or lines[0] != list(COLUMNS):
        raise OutputError(
            f"{path}: its first line is not that of a sweep of this version; give another name or remove it"
        )
    return [dict(zip(COLUMNS, line, strict=True)) for line in lines[1:] if len(line) == len(COLUMNS)]


def kept_rows(rows: Iterable[Row], jobs: Sequence[Job]) -> list[Row]:
    """Return the rows that stay: those of other questions, and the answers to these that still hold."""
    asked = {(job.file, str(n), str(job.options)): job.key(n) for job in jobs for n in job.block_sizes}
    kept: dict[Key, Row] = {}
    for row in rows:
        key = key_of(row)
        if asked.get(key[:3], key) == key and not row["error"].startswith(DIED):
            kept[key] = row
    return list(kept.values())


DIED = "the worker died"
"""Beginning of the error of a mesh that ended its worker: such rows are tried again."""


class Sheet:
    """A sweep's file that rows are added to, from a set of rows that it starts with."""

    def __init__(self, path: Path, rows: Iterable[Row]) -> None:
        with replacing(path) as temporary:
            text = _line(COLUMNS) + "".join(_line([row[name] for name in COLUMNS]) for row in rows)
            temporary.write_text(text, encoding="utf-8", newline="")
        self.path = path

    def add(self, rows: Iterable[Row]) -> None:
        """Add whole rows with one write; raises OutputError."""
        text = "".join(_line([row[name] for name in COLUMNS]) for row in rows)
        try:
            with self.path.open("ab", buffering=0) as stream:
                stream.write(text.encode())
                os.fsync(stream.fileno())
        except OSError as error:
            raise OutputError(f"{self.path}: {unwritten(error)}") from None


def _line(cells: Sequence[str]) -> str:
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerow(cells)
    return stream.getvalue()
