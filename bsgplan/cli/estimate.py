"""`bsgplan estimate`: the plan of a mesh."""

from __future__ import annotations

import sys
from math import log
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from ..errors import InvalidOption
from .checks import check_above
from .whole import Whole


def estimate(
    file: Path,
    /,
    *,
    tris_per_block: str | None = None,
    blocks: Whole | None = None,
    objective: str = "balanced",
    size: str | None = None,
    size_file: Path | None = None,
    lonlat: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    split_quads: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    region: Annotated[str | None, Parameter(allow_leading_hyphen=True)] = None,
    persistence: float = 1.3,
    plateau: float = 0.05,
    gradient_limit: float = 0.6,
    every_triangle: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    candidates: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    json: Annotated[bool, Parameter(negative=(), show_default=False)] = False,
    save: Path | None = None,
    figure: Path | None = None,
    vtk: Path | None = None,
    vtk_patterns: Path | None = None,
) -> None:
    """Plan the blocks of a mesh: regions, patterns, blocks, quality and irregularity.

    Parameters
    ----------
    file
        The mesh file.
    tris_per_block
        Triangles per block, a square (default 16: two refinements), or several: 4,16,64.
    blocks
        Instead: the block size that needs at most so many blocks, the smallest such.
    objective
        What patterns are chosen for: size, blocks, irregularity, quality or balanced.
    size
        A point or cell array of the file that holds the edge length wanted; default: the mesh's own edges.
    size_file
        Take the edge length wanted from this file: a Gmsh .pos, a Medit .sol, a JIGSAW grid or any mesh.
    lonlat
        The coordinates are degrees of longitude and latitude: plan on a conformal map, give metres.
    split_quads
        Split each quad into two triangles along its better diagonal, and plan them too.
    region
        Plan one region only: "POLYGON((..))", x0,y0,x1,y1 or a GeoJSON file, in the file's coordinates.
    persistence
        Fine and coarse spots whose sizes differ by less than this ratio are noise.
    plateau
        Where |grad h| is under this the size counts as constant: a uniform zone.
    gradient_limit
        Bound on the gradient of the block size in the gradient-limited count.
    every_triangle
        Plan on every triangle also where there are 200 000 or more, not on a thinned mesh: up to three times
        as long.
    candidates
        Show the candidates of every region.
    json
        Write one JSON document instead of the tables.
    save
        Write the JSON document to this file too.
    figure
        Draw size field, regions, patterns and budget to this .png, .svg or .pdf.
    vtk
        Write the mesh with regions, sizes, front coordinate, charge and block fronts to this .vtu or .vtk.
    vtk_patterns
        Write the chosen patterns as subdivided blocks to this .vtu or .vtk.
    """
    sizes = block_sizes(tris_per_block, blocks)
    check_options(objective, persistence, plateau, gradient_limit)
    if len(sizes) > 1 and (figure or vtk or vtk_patterns):
        raise InvalidOption(f"--figure and --vtk show one plan, not {len(sizes)}; give one block size")
    polygon = _polygon(region)
    from ..pipeline import plan_blocks
    from ..result import dumps
    from .info import open_mesh
    from .output import check_writable, show
    from .progress import stages

    check_writable(save, figure, vtk, vtk_patterns, sources=(file, size_file))
    check_suffixes(figure, vtk, vtk_patterns)
    with stages() as progress:
        progress("reading")
        result = plan_blocks(
            open_mesh(file, is_lonlat=lonlat, split_quads=split_quads),
            tris_per_block=sizes,
            n_blocks=blocks,
            size=size,
            size_file=size_file,
            region=polygon,
            objective=objective,
            persistence=log(persistence),
            plateau=plateau,
            gradient_limit=gradient_limit,
            every_triangle=every_triangle,
            progress=progress,
        )
        progress("writing")
        for path, write in (
            (vtk, result.write_vtk),
            (vtk_patterns, result.write_vtk_patterns),
            (figure, result.figure),
            (save, result.save),
        ):
            if path is not None:
                write(path)
    if json:
        sys.stdout.write(dumps(result.document()))
    else:
        show(result.tables(all_candidates=candidates))


def block_sizes(text: str | None, n_blocks: int | None) -> tuple[int, ...]:
    """Return the triangles per block of --tris-per-block, each a square; raises InvalidOption.

    >>> block_sizes("4,16", None)
    (4, 16)
    """
    from ..planning import check_block_size

    if n_blocks is not None and text is not None:
        raise InvalidOption("--blocks asks for what --tris-per-block gives; give one of the two")
    if n_blocks is not None and n_blocks < 1:
        raise InvalidOption(f"--blocks {n_blocks} is under 1; give the most blocks you accept")
    sizes = []
    for word in ("16" if text is None else text).split(","):
        try:
            sizes.append(int(word))
        except ValueError:
            raise InvalidOption(
                f"--tris-per-block {word.strip()!r} is no whole number; give a square, or several as 4,16"
            ) from None
        check_block_size(sizes[-1])
    return tuple(dict.fromkeys(sizes))


def check_options(objective: str, persistence: float, plateau: float, gradient_limit: float) -> None:
    """Raise InvalidOption for a value that is wrong whatever the mesh."""
    from ..planning import OBJECTIVES

    if objective not in OBJECTIVES:
        raise InvalidOption(f"--objective {objective!r} is unknown; choose one of {', '.join(OBJECTIVES)}")
    for name, value, least, example in (
        ("--persistence", persistence, 1.0, "1.3"),
        ("--plateau", plateau, 0.0, "0.05"),
        ("--gradient-limit", gradient_limit, 0.0, "0.6"),
    ):
        check_above(name, value, least, example)


def check_suffixes(figure: Path | None, vtk: Path | None, vtk_patterns: Path | None) -> None:
    """Raise InvalidOption for a picture or VTK file of another format, before any work is done."""
    from ..io.vtk_cells import check_suffix

    if figure:
        from ..report.figure import check_figure_suffix

        check_figure_suffix(figure)
    for path in (vtk, vtk_patterns):
        if path:
            check_suffix(path)


def _polygon(region: str | None) -> Any:
    if region is None:
        return None
    from ..regions.selection import parse_region

    return parse_region(region)
