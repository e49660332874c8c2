"""`bsgplan paper`: every table and figure of the paper, our number beside the paper's."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from ..errors import PaperIsOff


def paper(*, out: Path, json: Annotated[bool, Parameter(negative=())] = False) -> None:
    """Reproduce every table and figure of the paper; exit code 1 if a number of ours is off.

    Parameters
    ----------
    out
        The folder for report.md, report.json and one PNG a figure; made where it is not there.
    json
        Write the JSON document instead of the tables to stdout.
    """
    from ..paper.report import reproduce, slips_table, summary_table
    from ..paper.write import check_folder, write_report
    from ..result import dumps
    from .output import show
    from .progress import stages

    check_folder(out)
    with stages() as progress:
        report = reproduce(progress)
        write_report(report, out, progress)
    if json:
        sys.stdout.write(dumps(report.document()))
    else:
        show([summary_table(report), slips_table(report)])
    if off := report.differing:
        sys.stdout.flush()
        first = off[0]
        raise PaperIsOff(
            f"{len(off)} of {len(report.items)} numbers differ, first {first.section}, {first.name}: "
            f"{first.shown}, not {first.correct}; see {out / 'report.md'}"
        )
