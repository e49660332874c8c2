"""`bsgplan pattern`: what a pattern is worth."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from ..errors import InvalidOption
from .whole import Whole

if TYPE_CHECKING:
    from ..patterns import Pattern


def pattern(
    counts: str,
    /,
    *,
    length: float | None = None,
    refine: Whole = 2,
    closed: Annotated[bool, Parameter(negative=())] = False,
    figure: Path | None = None,
    vtk: Path | None = None,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Show what a pattern is worth: blocks, irregularity, bounds, best length, quality.

    Parameters
    ----------
    counts
        Elements of each front, as 7:4:1.
    length
        Length of the transition in heights, the length of a front (rings: in circumferences).
    refine
        Uniform refinements of each block: 2 gives 16 triangles a block.
    closed
        Fronts are closed rings around a cylinder.
    figure
        Draw the pattern with its irregular vertices to this .png, .svg or .pdf.
    vtk
        Write the refined pattern to this .vtu, with the displacement that moves its vertices.
    json
        Write one JSON document instead of the tables.
    """
    from ..io.vtk_cells import check_suffix
    from ..patterns import Pattern
    from ..report.pattern_document import check_pattern, pattern_document
    from ..report.pattern_tables import pattern_tables
    from ..result import dumps
    from .output import check_writable, show

    wanted = Pattern.parse(counts, is_closed=closed)
    check_pattern(wanted, length, refine)
    if vtk is not None:
        check_suffix(vtk)
    if figure is not None:
        _check_figure(figure)
    check_writable(figure, vtk)
    if vtk is not None:
        _write_vtk(vtk, wanted, length, refine)
    if figure is not None:
        from ..report.figure import save_figure
        from ..report.pattern_figure import pattern_figure

        save_figure(pattern_figure(wanted, length=length, refine=refine), figure)
    document = pattern_document(wanted, length=length, refine=refine)
    if json:
        sys.stdout.write(dumps(document))
    else:
        show(pattern_tables(document))


def _check_figure(path: Path) -> None:
    from ..report.figure import SUFFIXES

    if path.suffix.lower() not in SUFFIXES:
        raise InvalidOption(
            f"{path}: suffix {path.suffix!r} is no figure format; write {', '.join(SUFFIXES)}"
        )


def _write_vtk(path: Path, wanted: Pattern, length: float | None, refine: int) -> None:
    """Write refined blocks with the cell arrays block, level, quality and the point array displacement."""
    import numpy as np

    from ..io.vtk_cells import write_cells
    from ..patterns import best_length, best_spacing, realise, subdivide
    from ..patterns.frustum import pattern_qualities
    from ..report.pattern_document import moved_pattern, straight_shape

    shape = straight_shape(wanted, best_length(wanted).length if length is None else length)
    positions = best_spacing(wanted, shape).positions
    realised = realise(wanted, shape, positions)
    moved = moved_pattern(realised) or realised
    points, triangles, block = subdivide(realised.points, realised.triangles, 2**refine)
    displaced, _, _ = subdivide(moved.points, moved.triangles, 2**refine)
    flat = np.zeros((len(points), 3 - points.shape[1]))
    write_cells(
        path,
        points,
        (("triangle", triangles),),
        point_data={"displacement": np.column_stack([displaced - points, flat])},
        cell_data={
            "block": [block],
            "level": [realised.front[realised.triangles].min(axis=1)[block]],
            "quality": [pattern_qualities(wanted, shape, positions)[block]],
        },
    )
