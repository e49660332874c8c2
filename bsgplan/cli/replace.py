"""`bsgplan replace`: parts of a mesh exchanged for parts with far fewer irregular vertices."""

from __future__ import annotations

import sys
from math import isfinite
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from ..errors import InvalidOption
from .checks import check_least
from .whole import Whole


def replace(
    file: Path,
    /,
    *,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    region: str | None = None,
    move_boundary: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    min_quality: float | None = None,
    tolerance: float = 0.1,
    effort: Whole = 30,
    seed: Whole = 7,
    size: str | None = None,
    size_file: Path | None = None,
    lonlat: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    split_quads: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    json: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    save: Path | None = None,
    figure: Path | None = None,
) -> None:
    """Replace parts of a mesh where that leaves far fewer irregular vertices, sizes and quality kept.

    Parameters
    ----------
    file
        The mesh file.
    output
        Write the mesh with its data and boundaries, in the format of the suffix.
    region
        Replace inside this polygon only: "POLYGON((..))", x0,y0,x1,y1 or a GeoJSON file, in the file's
        coordinates.
    move_boundary
        Let points of the mesh's boundary slide along it, come and go; corners and ends of boundaries stay.
    min_quality
        Leave a part alone whose worst triangle would be under this mean ratio.
    tolerance
        Share by which the number of triangles and the size misfit of a part may change.
    effort
        Sweeps of the annealing: more give fewer irregular vertices and take as much longer.
    seed
        Another number gives another mesh, the same one the same.
    size
        A point or cell array of the file that holds the edge length wanted; default: the mesh's own edges.
    size_file
        Take the edge length wanted from this file: a Gmsh .pos, a Medit .sol, a JIGSAW grid or any mesh.
    lonlat
        The coordinates are degrees of longitude and latitude: work on a conformal map, write degrees.
    split_quads
        Split each quad into two triangles along its better diagonal first.
    json
        Write one JSON document instead of the tables.
    save
        Write the JSON document to this file too.
    figure
        Draw before and after, irregular vertices red and blue, to this .png, .svg or .pdf.
    """
    check_options(min_quality, tolerance, effort, seed)
    from ..io.write import writable
    from ..regions.selection import parse_region
    from ..remesh.accept import Terms
    from ..replace_pipeline import replace_in
    from ..result import dumps
    from .info import open_mesh
    from .output import check_writable, show
    from .progress import bar, interruptible

    polygon = None if region is None else parse_region(region)
    if output is not None:
        writable(output)
    if figure is not None:
        from ..report.figure import check_figure_suffix

        check_figure_suffix(figure)
    check_writable(output, save, figure, sources=(file, size_file))
    with bar() as progress, interruptible() as is_stopped:
        progress("reading", 0.0)
        result = replace_in(
            open_mesh(file, is_lonlat=lonlat, split_quads=split_quads),
            region=polygon,
            size=size,
            size_file=size_file,
            move_boundary=move_boundary,
            terms=Terms(tolerance, min_quality),
            effort=effort,
            seed=seed,
            progress=progress,
            is_stopped=is_stopped,
        )
        progress("writing", 1.0)
        for path, write in ((output, result.write), (save, result.save), (figure, result.figure)):
            if path is not None:
                write(path)
    if json:
        sys.stdout.write(dumps(result.document()))
    else:
        show(result.tables())
    if is_stopped():
        sys.stdout.flush()
        raise KeyboardInterrupt


def check_options(min_quality: float | None, tolerance: float, effort: int, seed: int) -> None:
    """Raise InvalidOption for a value that is wrong whatever the mesh."""
    for name, value, least, example in (("--effort", effort, 1, "30"), ("--seed", seed, 0, "7")):
        check_least(name, value, least, example)
    if not (isfinite(tolerance) and tolerance >= 0):
        raise InvalidOption(f"--tolerance {tolerance:g} is under 0; give for example 0.1")
    if min_quality is not None and not 0 <= min_quality <= 1:
        raise InvalidOption(f"--min-quality {min_quality:g} is no mean ratio; give one of 0 .. 1, as 0.7")
