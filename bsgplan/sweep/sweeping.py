"""The verb sweep: files by their patterns, what is done already, the rest through an engine, row by row."""

from __future__ import annotations

import glob
import os
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path

from ..errors import MeshReadError
from .engine import local, on_cluster
from .job import Options, Row, job
from .table import Sheet, kept_rows, key_of, read_rows


def sweep(
    patterns: Sequence[str],
    out: str | os.PathLike[str],
    *,
    block_sizes: Sequence[int] = (16,),
    options: Options | None = None,
    n_workers: int | None = None,
    scheduler: str | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> list[Row]:
    """Plan every file that matches a pattern at every block size; return the rows of these, as in the file.

    out is a CSV file: rows that it holds already for the same content, options and version are kept and not
    planned again, others are added one by one. n_workers processes of this machine, default one a processor,
    or the workers of the Dask scheduler at that address. A mesh that fails is a row with its error.
    Raises MeshReadError where nothing matches or the size file is missing, OutputError where out cannot be
    written.
    """
    path = Path(out)
    files = matching(patterns, leave=path)
    asked = options or Options()
    if asked.size_file is not None and not Path(asked.size_file).is_file():
        raise MeshReadError(f"{asked.size_file}: no such file for --size-file; check the path")
    jobs = [job(file, tuple(dict.fromkeys(block_sizes)), asked) for file in files]
    rows = kept_rows(read_rows(path), jobs)
    sheet = Sheet(path, rows)
    todo = [rest for one in jobs if (rest := one.without(map(key_of, rows))).block_sizes]
    engine = (
        local(todo, n_workers or usable_processors()) if scheduler is None else on_cluster(todo, scheduler)
    )
    with closing(engine):  # whatever is raised here ends the workers
        for done, new in enumerate(engine, 1):
            sheet.add(new)
            rows += new
            progress(f"planned {done} of {len(todo)} meshes")
    by_key = {key_of(row): row for row in rows}
    return [by_key[one.key(n)] for one in jobs for n in one.block_sizes]


def matching(patterns: Sequence[str], *, leave: Path) -> list[str]:
    """Return the files that match any of the patterns, sorted, each once; `**` goes into folders.

    A name without a pattern is taken as it is; leave is the sweep's own file. Raises MeshReadError where a
    pattern matches nothing.
    """
    found: dict[str, None] = {}
    for pattern in patterns:
        if Path(pattern).is_file() or not set(pattern) & set("*?["):
            found[pattern] = None
            continue
        names = sorted(glob.glob(pattern, recursive=True))  # noqa: PTH207 - keeps the pattern's own spelling
        names = [name for name in names if Path(name).is_file()]
        names = [name for name in names if Path(name).resolve() != leave.resolve()]
        if not names:
            raise MeshReadError(f"no file matches {pattern!r}; quote the pattern, and check the folder")
        found.update(dict.fromkeys(names))
    return list(found)


def usable_processors() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
