"""`bsgplan sweep`: many meshes at many block sizes, into one CSV file."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from ..errors import InvalidOption, NoPatternFits
from .whole import Whole


def sweep(
    *files: str,
    out: Path,
    tris_per_block: str = "16",
    workers: Whole | None = None,
    scheduler: str | None = None,
    objective: str = "balanced",
    size: str | None = None,
    size_file: Path | None = None,
    lonlat: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    split_quads: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    persistence: float = 1.3,
    plateau: float = 0.05,
    gradient_limit: float = 0.6,
) -> None:
    """Plan many meshes at many block sizes, in parallel, into a CSV file: one row a mesh and block size.

    A mesh that fails is a row with its error, and the exit code is 1. An interrupted sweep goes on where it
    stopped: rows of the same file content, options and version are kept.

    Parameters
    ----------
    files
        Mesh files or quoted patterns: 'meshes/*.14' 'runs/**/*.msh'.
    out
        The CSV file.
    tris_per_block
        Triangles per block, a square, or several: 4,16,64.
    workers
        Processes on this machine; default one a processor.
    scheduler
        Instead: address of a Dask scheduler, tcp://host:8786, whose workers see the files (extra dask).
    objective
        What patterns are chosen for: size, blocks, irregularity, quality or balanced.
    size
        A point or cell array of each file that holds the edge length wanted; default: the mesh's own edges.
    size_file
        Take it from this file, for every mesh: a Gmsh .pos, a Medit .sol, a JIGSAW grid or any mesh.
    lonlat
        The coordinates are degrees of longitude and latitude.
    split_quads
        Split each quad into two triangles, and plan those too.
    persistence
        Fine and coarse spots whose sizes differ by less than this ratio are noise.
    plateau
        Where |grad h| is under this the size counts as constant: a uniform zone.
    gradient_limit
        Bound on the gradient of the block size in the gradient-limited count.
    """
    from ..sweep.job import Options
    from ..sweep.sweeping import sweep as sweep_files
    from .estimate import block_sizes, check_options
    from .output import check_writable
    from .progress import stages

    sizes = block_sizes(tris_per_block, None)
    check_options(objective, persistence, plateau, gradient_limit)
    if not files:
        raise InvalidOption("no mesh files; give some, or a quoted pattern such as 'meshes/*.14'")
    if workers is not None and workers < 1:
        raise InvalidOption(f"--workers {workers} is under 1; give the processes to use")
    if workers is not None and scheduler is not None:
        raise InvalidOption(
            "--workers are those of this machine, --scheduler has its own; give one of the two"
        )
    check_writable(out, sources=[*map(Path, files), size_file])
    with stages() as progress:
        rows = sweep_files(
            files,
            out,
            block_sizes=sizes,
            options=Options(
                objective=objective,
                size=size,
                size_file=None if size_file is None else str(size_file),
                is_lonlat=lonlat,
                split_quads=split_quads,
                persistence=persistence,
                plateau=plateau,
                gradient_limit=gradient_limit,
            ),
            n_workers=workers,
            scheduler=scheduler,
            progress=progress,
        )
    n_failed = sum(bool(row["error"]) for row in rows)
    sys.stdout.write(f"{len(rows)} rows in {out}, {n_failed} with an error\n")
    if n_failed:
        first = next(row for row in rows if row["error"])
        raise NoPatternFits(
            f"{n_failed} of {len(rows)} rows failed, the first {first['file']}: {first['error']}"
        )
