"""`bsgplan layout`: the blocks of a whole mesh and the grid of them."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from .checks import check_above, check_least
from .whole import Whole


def layout(
    file: Path,
    /,
    *,
    tris_per_block: Whole = 16,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    grid: Path | None = None,
    figure: Path | None = None,
    save: Path | None = None,
    json: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    effort: Whole = 100,
    size_tolerance: float = 1.2,
    gradient_limit: float | None = None,
    seed: Whole = 7,
    straight: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    size: str | None = None,
    size_file: Path | None = None,
    keep: str | None = None,
    lonlat: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    split_quads: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    ranks: Whole | None = None,
) -> None:
    """Lay the whole mesh out in blocks and cut them into a grid.

    Parameters
    ----------
    file
        The mesh file.
    tris_per_block
        Triangles per block, a square.
    output
        Write the blocks, one cell each: .vtu, .vtm, .msh, .14 or .pos.
    grid
        Write the triangles with their blocks, in the same formats.
    figure
        Draw blocks and irregular vertices to this .png, .svg or .pdf.
    save
        Write the layout to this .json, with blocks and grid, for bsgplan export.
    json
        Write one JSON document instead of the tables.
    effort
        Sweeps of the annealing: more give fewer irregular vertices and take as much longer.
    size_tolerance
        How far edges may stray: rms of log size at most ln of this.
    gradient_limit
        Bound on the gradient of the block size; default: by how ragged the boundary is, and by what it costs.
    seed
        Another number gives another layout, the same one the same.
    straight
        Keep the sides of blocks straight, for solvers that refine by themselves.
    size
        A point or cell array of the file that holds the edge length wanted; default: the mesh's own edges.
    size_file
        A file that holds the edge length wanted: a .pos, .sol or JIGSAW grid, or a mesh with --size.
    keep
        Boundaries, inner lines and points, by name or number, that blocks must follow: weir,17.
    lonlat
        The coordinates are degrees of longitude and latitude: lay out on a conformal map.
    split_quads
        Cut quads into two triangles each before the layout.
    ranks
        Tell blocks and memory for so many processes.
    """
    check_options(tris_per_block, effort, size_tolerance, gradient_limit, seed, ranks)
    from ..blocks.kernel.anneal import anneal
    from ..compiled import is_cached
    from ..laid_out.export import flavour
    from ..layout_pipeline import lay_out_mesh
    from ..result import dumps
    from .info import open_mesh
    from .output import check_writable, show
    from .progress import bar, interruptible

    check_writable(output, grid, figure, save, sources=(file, size_file))
    if figure is not None:
        from ..report.figure import check_figure_suffix

        check_figure_suffix(figure)
    for path in (output, grid):
        if path is not None:
            flavour(path)
    with bar() as progress, interruptible() as is_stopped:
        mesh_file = open_mesh(file, is_lonlat=lonlat, split_quads=split_quads)
        if not is_cached(anneal):
            print("compiling, once, less than a minute", file=sys.stderr)  # noqa: T201
        result = lay_out_mesh(
            mesh_file,
            tris_per_block=tris_per_block,
            size=size,
            size_file=size_file,
            keep=tuple(word.strip() for word in keep.split(",")) if keep else (),
            effort=effort,
            size_tolerance=size_tolerance,
            gradient_limit=gradient_limit,
            seed=seed,
            is_straight=straight,
            n_ranks=ranks,
            progress=progress,
            is_stopped=is_stopped,
        )
        progress("writing", 1.0)
        for path, write in (
            (output, result.write_blocks),
            (grid, result.write_grid),
            (figure, result.figure),
            (save, result.save),
        ):
            if path is not None:
                write(path)
        document, tables = (result.document(), []) if json else ({}, result.tables())
    if json:
        sys.stdout.write(dumps(document))
    else:
        show(tables)
    if is_stopped():
        sys.stdout.flush()
        raise KeyboardInterrupt


def check_options(
    tris_per_block: int,
    effort: int,
    size_tolerance: float,
    gradient_limit: float | None,
    seed: int,
    ranks: int | None,
) -> None:
    """Raise InvalidOption for a value that is wrong whatever the mesh."""
    from ..planning import check_block_size

    check_block_size(tris_per_block)
    for name, value, least, example in (
        ("--effort", effort, 1, "100"),
        ("--seed", seed, 0, "7"),
        ("--ranks", 1 if ranks is None else ranks, 1, "64"),
    ):
        check_least(name, value, least, example)
    for name, number, bound, example in (
        ("--size-tolerance", size_tolerance, 1.0, "1.2"),
        ("--gradient-limit", 1.0 if gradient_limit is None else gradient_limit, 0.0, "0.6"),
    ):
        check_above(name, number, bound, example)
