"""What a command prints, and the check that what it shall write can be written."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import InvalidOption, OutputError

if TYPE_CHECKING:
    from ..report import Table


def show(tables: Sequence[Table]) -> None:
    """Print tables: as plain text when piped or with NO_COLOR, with rich on a terminal."""
    from ..report.table import rich_table, text

    if sys.stdout.isatty() and not os.environ.get("NO_COLOR"):
        from rich.console import Console

        console = Console()
        if console.width >= max(len(line) for table in tables for line in text(table).splitlines()[:3]):
            for table in tables:
                console.print(rich_table(table))
            return
    sys.stdout.write("\n\n".join(text(table) for table in tables) + "\n")


def check_writable(*paths: Path | None, sources: Sequence[Path | None] = ()) -> None:
    """Raise OutputError for the first path that cannot be written, before any work is done.

    InvalidOption where two outputs have one name, or one is a source.
    """
    given = [path for path in paths if path is not None]
    for k, path in enumerate(given):
        if path.resolve() in [other.resolve() for other in given[:k]]:
            raise InvalidOption(f"{path}: two outputs have this name; give each its own")
        if path.resolve() in [source.resolve() for source in sources if source is not None]:
            raise InvalidOption(f"{path}: is a file that is read; give the output another name")
        folder = path.parent
        if path.is_dir():
            raise OutputError(f"{path}: is a folder; give a file name")
        if not folder.is_dir():
            raise OutputError(f"{path}: the folder {folder} does not exist; create it first")
        if not os.access(folder, os.W_OK):
            raise OutputError(f"{path}: the folder {folder} is not writable; choose another")
