"""The report as a folder: report.md, report.json and one PNG a figure, each whole or not at all.

Everything is made in a temporary folder beside the wanted one; only when all of it is there are the files
renamed, so an error leaves what was there before.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from ..atomic import naming
from ..errors import OutputError
from ..report.table import markdown
from .report import Report, section_table, slips_table, summary_table

DOTS = 110
"""Pixels an inch of the pictures."""
HEAD = """# The paper, reproduced

Every table and figure of Zint and Grosso, *On the Link between Mesh Size Adaptation and Irregular Vertices*,
our number beside the paper's. A number in brackets is not in the paper: it is what independent reckoning
gives, where the paper prints none or slips. Ours agrees where it rounds to the printed digits; `!` marks one
that does not. Irregular vertices are red where positive, blue where negative. Figure 8, a region replaced
inside a mesh, is of a mesh of ours. `bsgplan paper --out report/` makes this page; its exit code is 1 where a
number differs.
"""


def write_report(
    report: Report, folder: str | os.PathLike[str], progress: Callable[[str], None] = lambda _: None
) -> list[str]:
    """Write the report into a folder, made where it is not there, and return the names of its files.

    Raises OutputError where that cannot be done.
    """
    target = Path(folder)
    with _staged(target) as stage:
        for section in report.sections:
            if section.figure is not None:
                progress(f"drawing {section.key}")
                drawn = section.figure()
                drawn.savefig(stage / f"{section.key}.png", dpi=DOTS, bbox_inches="tight", pad_inches=0.08)
        (stage / "report.md").write_text(page(report), encoding="utf-8")
        text = json.dumps(report.document(), indent=2, allow_nan=False) + "\n"
        (stage / "report.json").write_text(text, encoding="utf-8")
        return sorted(path.name for path in stage.iterdir())


def page(report: Report) -> str:
    """Return the report as a Markdown page, its pictures beside it."""
    parts = [HEAD.strip(), markdown(summary_table(report)), "## Where the paper slips"]
    parts.append(markdown(slips_table(report)))
    for section in report.sections:
        parts += [f"## {section.title}", section.text]
        if section.figure is not None:
            parts.append(f"![{section.title}]({section.key}.png)")
        parts.append(markdown(section_table(section)))
        if section.skipped:
            parts.append(f"Skipped: {section.skipped}")
    return "\n\n".join(parts) + "\n"


def check_folder(folder: str | os.PathLike[str]) -> None:
    """Raise OutputError where the report cannot be written into this folder, before any work is done."""
    target = Path(folder)
    if target.exists() and not target.is_dir():
        raise OutputError(f"{target}: is a file; give a folder for the report")
    parent = target.resolve().parent
    if not parent.is_dir():
        raise OutputError(f"{target}: the folder {parent} does not exist; create it first")
    for place in (parent, *([target] if target.is_dir() else [])):
        if not os.access(place, os.W_OK):
            raise OutputError(f"{target}: the folder {place} is not writable; choose another")


@contextlib.contextmanager
def _staged(target: Path) -> Iterator[Path]:
    """Give an empty folder beside the target; when the block ends well, rename its files into the target."""
    check_folder(target)
    there = target.resolve()
    with naming(target):
        stage = Path(tempfile.mkdtemp(prefix=f".{there.name}.", dir=there.parent))
        try:
            yield stage
            if not there.exists():
                umask = os.umask(0)
                os.umask(umask)
                stage.chmod(0o777 & ~umask)
                stage.rename(there)
                return
            for path in sorted(stage.iterdir()):
                path.replace(there / path.name)
        finally:
            shutil.rmtree(stage, ignore_errors=True)
