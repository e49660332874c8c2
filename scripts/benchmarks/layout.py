"""Layouts against gmsh, JIGSAW and their input: the medians of some seeds, and what is demanded of them.

Irregular vertices are interior ones of valence other than 6 and boundary ones whose triangles do not fit
their angle, counted by the same function on every side; edges are held against s h by a five-point rule.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from math import nan
from pathlib import Path
from statistics import median

import numpy as np

import bsgplan
from bsgplan.blocks import lay_out
from bsgplan.blocks.advice import advice
from bsgplan.blocks.lay_out import EFFORT
from bsgplan.blocks.layout import BlockLayout
from bsgplan.blocks.measures import (
    boundary_deviation,
    grid_measures,
    input_measures,
    layout_measures,
)
from bsgplan.errors import LayoutRefused
from bsgplan.io import read_lonlat
from bsgplan.laid_out.specks import without_specks
from bsgplan.sizing import SizeField, size_field

from .cost import cpu_of
from .layout_cases import ALL, CASES, Case
from .layout_outcome import POOR, Outcome, medians, medians_of, n_irregular, n_off, n_poor
from .rival import rival_of
from .row import Row

TITLE = "Layouts"

REPOSITORY = Path(__file__).parents[2]

MESHES = Path(os.environ.get("BSGPLAN_SHARED", REPOSITORY.parent / "shared")) / "meshes"

MILLISECONDS_PER_BLOCK = 20.0
"""Most CPU time of a layout with its grid and their verdict, by block."""

FIRST_SEED = 7

COUNTS = (0.97, 1.0, 1.03)
"""Shares of our count at which gmsh runs: its medians stand beside those of our seeds."""

RUNS = 4
"""The most layouts to come near JIGSAW's count."""


def rows(*, only: str = "", seeds: int = 3, effort: int = EFFORT) -> Iterator[Row]:
    """Measure the cases whose names start with one of the words, separated by commas."""
    words = tuple(word.strip() for word in only.split(",")) if only else ("",)
    _compile()
    for case in ALL:
        if not case.name.startswith(words):
            continue
        if not (_folder(case) / case.path).is_file():
            yield Row(f"{case.name}: no file {case.path}, not measured", nan)
            continue
        yield from case_rows(case, seeds=seeds, effort=effort)


def case_rows(case: Case, *, seeds: int, effort: int = EFFORT) -> Iterator[Row]:
    """Measure one case: layouts of some seeds, gmsh's run beside the one of the median count."""
    path = _folder(case) / case.path
    mesh_file = (read_lonlat if case.is_lonlat else bsgplan.read)(path)
    _, size = without_specks(mesh_file, size_field(mesh_file.mesh), side=case.side)  # as the command does
    try:
        outcomes = _outcomes(case, size, seeds, effort)
    except LayoutRefused as refusal:
        yield Row(f"{case.name}: REFUSED, {refusal}", nan, below=0.0)
        return
    for row in (*_block_rows(case, outcomes), *_grid_rows(case, size, outcomes)):
        yield replace(row, what=f"{case.name}: {row.what}")


def _outcomes(case: Case, size: SizeField, seeds: int, effort: int) -> list[Outcome]:
    run = partial(_outcome, case, effort=effort)
    if case.jigsaw is None:
        return [run(size, seed=FIRST_SEED + k) for k in range(seeds)]
    wanted, _ = case.jigsaw
    factor, best, best_factor = 1.0, None, 1.0
    for _ in range(RUNS):
        outcome = run(replace(size, h=factor * size.h), seed=FIRST_SEED)
        n = outcome.grid.layout.n_blocks
        if best is None or abs(n - wanted) < abs(best.grid.layout.n_blocks - wanted):
            best, best_factor = outcome, factor
        if abs(n / wanted - 1) < case.jigsaw_near / 2:
            break
        factor *= float(np.sqrt(n / wanted))
    scaled = replace(size, h=best_factor * size.h)
    return [best, *(run(scaled, seed=FIRST_SEED + k) for k in range(1, seeds))]


def _outcome(case: Case, size: SizeField, *, seed: int, effort: int) -> Outcome:
    grid, cpu = cpu_of(lambda: lay_out(size, tris_per_block=case.side**2, effort=effort, seed=seed))
    return Outcome(grid, layout_measures(grid.layout), grid_measures(grid), boundary_deviation(grid)[0], cpu)


def _block_rows(case: Case, outcomes: list[Outcome]) -> Iterator[Row]:
    counts = [o.grid.layout.n_blocks for o in outcomes]
    middle = sorted(outcomes, key=lambda o: o.grid.layout.n_blocks)[len(outcomes) // 2].grid.layout
    expected = middle.target.blocks["resolution"]
    ours = medians(outcomes, lambda o: o.blocks)
    off = [n_off(o.grid.layout.mesh) for o in outcomes]
    theirs = _rivals(middle) if case.has_rival else []
    gmsh = medians_of([layout_measures(their) for their in theirs]) if theirs else {}
    beside = _beside(gmsh) if gmsh else {}
    yield Row("blocks", median(counts), f"{expected:.0f} by s h alone", beside=beside.get("blocks", ""))
    if case.jigsaw is not None:
        wanted, irregular = case.jigsaw
        yield Row(
            "blocks over JIGSAW's, off by",
            abs(median(counts) / wanted - 1),
            "",
            below=case.jigsaw_near,
            beside=f"{wanted} blocks",
        )
        yield Row(
            "irregular inside over JIGSAW's",
            ours["interior"] / irregular,
            "x",
            below=case.jigsaw_share,
            beside=f"{irregular} irregular",
        )
    yield Row(
        "irregular", ours["irregular"], f"{ours['interior']:g} inside", beside=beside.get("irregular", "")
    )
    if case.has_rival:
        if not gmsh:
            yield Row("gmsh failed or was given up, not compared", nan)
        else:
            share = 1 - ours["irregular"] / gmsh["irregular"]
            yield Row("irregular vertices that gmsh has and we have not", share, "", above=case.fewer)
    yield Row("q_min of blocks", ours["q_min"], "", above=case.q_blocks, beside=beside.get("q_min", ""))
    yield Row("1 % of q of blocks", ours["q_p01"], beside=beside.get("q_p01", ""))
    rms, over = ours["rms"], gmsh.get("rms")
    yield Row("rms of log(edge / s h)", rms, beside=beside.get("rms", ""))
    if over is not None and case.rms_times is not None:
        yield Row("that over gmsh's", rms / over, "x", below=case.rms_times)
    if over is not None and case.rms_plus is not None:
        yield Row("that above gmsh's", rms - over, "", below=case.rms_plus)
    yield Row(
        "vertices off by 2 edges or more",
        median(off),
        "",
        below=1 if case.is_even else None,
        beside=f"{median(n_off(their.mesh) for their in theirs):g}" if theirs else "",
    )
    cost = median(1e3 * o.cpu / o.grid.layout.n_blocks for o in outcomes)
    yield Row("ms CPU a block, grid included", cost, "", below=_most_time(case))


def _most_time(case: Case) -> float:
    return MILLISECONDS_PER_BLOCK + case.side**2  # and 1 ms a triangle of the grid


def _grid_rows(case: Case, size: SizeField, outcomes: list[Outcome]) -> Iterator[Row]:
    before = input_measures(size)
    ours = medians(outcomes, lambda o: o.fine)
    interior = before.irregular_interior / max(ours["interior"], 1)
    least = case.gain_interior
    if least is not None and ours["interior"] <= case.enough_interior:
        least = min(least, interior)
    gain = n_irregular(before) / max(ours["irregular"], 1)
    yield Row(
        "irregular inside, input over grid",
        interior,
        "x",
        above=least,
        beside=f"{before.irregular_interior} over {ours['interior']:g}",
    )
    yield Row("irregular in all, input over grid", gain, "x", above=case.gain)
    q = case.q_grid
    if q is not None and case.is_as_good:
        q = max(q, before.q_min)
    yield Row("q_min of the grid", ours["q_min"], "", above=q, beside=f"input {before.q_min:.3f}")
    inverted = max(int(np.count_nonzero(o.grid.mesh.qualities <= 0)) for o in outcomes)
    yield Row("inverted triangles, any seed", inverted, "", below=1)
    if case.is_no_poorer:
        poor, had = (median(n_poor(o.grid.mesh) for o in outcomes), n_poor(size.mesh))
        yield Row(f"triangles of q under {POOR}", poor, "", below=had + 1, beside=f"input {had}")
    if case.is_warned:
        layout = outcomes[0].grid.layout
        told = advice(layout.domain, size, case.side)
        yield Row("warned of blocks too large", float(told is not None), "", above=1)
    yield Row("triangles, grid over input", ours["triangles"] / before.n_triangles, "x", below=case.triangles)
    yield Row("rms of log(edge / h)", ours["rms"], beside=f"input {before.edge_ratio.rms_log:.3f}")
    deviation = median(o.deviation for o in outcomes)
    yield Row("deviation of the boundary in fine edges", deviation, "", below=case.deviation)


def _rivals(layout: BlockLayout) -> list[BlockLayout]:
    """Return the blocks that gmsh makes of the same domain, sizes and about the count, polished.

    Runs at each of COUNTS: what it makes where blocks are few jumps from one count to the next.
    """
    domain = layout.domain
    wanted = layout.side * layout.size.h[domain.source] / domain.scale
    meshes = [rival_of(domain, layout.target, wanted, round(c * layout.n_blocks)) for c in COUNTS]
    return [replace(layout, placed=mesh) for mesh in meshes if mesh is not None]


def _beside(m: dict[str, float]) -> dict[str, str]:
    return {
        "blocks": f"{m['blocks']:g}",
        "irregular": f"{m['irregular']:g}, {m['interior']:g} inside",
        "q_min": f"{m['q_min']:.3f}",
        "q_p01": f"{m['q_p01']:.3f}",
        "rms": f"{m['rms']:.3f}",
    }


def _folder(case: Case) -> Path:
    return REPOSITORY if case.path.startswith(CASES) else MESHES


def _compile() -> None:
    """Lay out a small case, so that compilation is not measured."""
    mesh = bsgplan.read(REPOSITORY / CASES / "plate" / "mesh.msh").mesh
    lay_out(size_field(mesh), tris_per_block=16, effort=1)
