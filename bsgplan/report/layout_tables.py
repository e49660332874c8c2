"""The tables of a layout: input, estimate, layout and grid side by side, the limits, the levels."""

from __future__ import annotations

import math

from ..blocks.levels import BYTES_PER_UNKNOWN, VECTORS
from ..blocks.measures import EdgeRatio, Measures
from ..planning import Plan
from ..words import counted
from .layout_document import LayoutReport
from .table import QUALITY, Column, Table, Value, number

LIMITS = {
    "resolution": "triangles of the size field / triangles per block",
    "gradient": "... where its gradient is at most {slope:g}",
    "boundary": "... and where islands, corners, bays and channels carry no larger block",
}
"""What each count of the target stands for."""


def tables(report: LayoutReport) -> list[Table]:
    """Return every table of a layout."""
    return [comparison_table(report), limits_table(report), levels_table(report)]


def comparison_table(report: LayoutReport) -> Table:
    """Return input, estimate, layout and grid side by side, straight blocks' q_min first."""
    columns = [
        measured(report.before),
        foretold(report.plan),
        measured(report.blocks),
        measured(report.triangles),
    ]
    columns[0]["size"] = columns[3]["size"] = "h"
    columns[2]["size"] = "s h"
    if report.time_steps is not None:
        for column, step in zip((columns[0], columns[3]), report.time_steps, strict=True):
            column["time step"] = f"{step:.3g}"
    most, common = report.deviation
    columns[3]["off boundary"] = f"{common:.2f} {most:.2f}"
    rows = [
        (name, *(column.get(key) for column in columns))
        for key, name in ROWS.items()
        if any(key in column for column in columns)
    ]
    cells: tuple[tuple[Value, ...], ...] = tuple(rows)
    side = report.grid.layout.side
    return Table(
        f"Layout in blocks of {side**2} triangles" + (", stopped early" if report.is_interrupted else ""),
        (
            Column(""),
            Column("input", is_right=True),
            Column("estimate", is_right=True),
            Column("layout", is_right=True),
            Column("grid", is_right=True),
        ),
        cells,
        (*floor_notes(report), f"{report.seconds_cpu:.1f} s of CPU for layout and grid."),
    )


ROWS = {
    "q_min": "q_min (layout: straight blocks)",
    "q_p01": "q of the worst 1 %",
    "q_mean": "q, mean",
    "blocks": "blocks",
    "triangles": "triangles",
    "interior": "irregular inside",
    "boundary": "irregular on the boundary",
    "fitted": "... fitted to its angles",
    "iota": "irregularity iota+ iota-",
    "size": "edges are measured in",
    "edges": "edges, 5 50 95 %",
    "rms": "rms of their log",
    "off boundary": "off the boundary, 99 % max [h]",
    "time step": "least edge / sqrt(g depth) [s]",
}
"""Rows of the comparison, in order."""


def measured(m: Measures) -> dict[str, Value]:
    """Return the cells of one measured mesh."""
    cells: dict[str, Value] = {
        "q_min": number(m.q_min, QUALITY),
        "q_p01": number(m.q_p01, QUALITY),
        "q_mean": number(m.q_mean, QUALITY),
        "triangles": m.n_triangles,
        "interior": m.irregular_interior,
        "boundary": m.irregular_boundary,
        "fitted": m.irregular_boundary_fitted,
        "iota": f"{m.irregularity.positive:+d} {m.irregularity.negative:+d}",
        "edges": _edges(m.edge_ratio),
        "rms": f"{m.edge_ratio.rms_log:.3f}",
    }
    return cells if m.n_blocks is None else cells | {"blocks": m.n_blocks}


def foretold(plan: Plan) -> dict[str, Value]:
    """Return the cells of the estimate."""
    iota = plan.irregularity
    cells: dict[str, Value] = {
        "blocks": plan.n_blocks,
        "triangles": plan.planned_triangles,
        "iota": f"{iota.positive:+d} {iota.negative:+d}",
    }
    return cells if plan.q_min is None else cells | {"q_min": number(plan.q_min, QUALITY)}


def floor_notes(report: LayoutReport) -> tuple[str, ...]:
    """Return what no layout can go below: by topology and corners, and by the size field."""
    floor, drivers = report.floor, report.plan.drivers
    low, high = floor.corners
    carried = f"{low:+d}" if low == high else f"{low:+d} .. {high:+d}"
    return (
        f"floor: iota+ + iota- = -6 chi = {floor.irregularity:+d}, of which {floor.n_corners} corners carry "
        f"{carried}: at least {floor.irregular} more irregular vertices;",
        f"the size field asks for {drivers.charge:+.1f} inside and {drivers.boundary_charge:+.1f} "
        "on the boundary.",
    )


def limits_table(report: LayoutReport) -> Table:
    """Return what each limit of the block size costs."""
    target = report.grid.layout.target
    rows: list[tuple[Value, ...]] = []
    before = math.nan
    for name, blocks in target.blocks.items():
        meaning = LIMITS.get(name, name).format(slope=target.gradient_limit)
        more: tuple[Value, Value] = (None, None)
        if not math.isnan(before):
            more = (blocks - before, (blocks - before) * target.side**2)
        rows.append((name, float(blocks), *more, meaning))
        before = blocks
    note = f"edges of blocks against the target so limited: {_edges(report.on_target)}, rms of log "
    return Table(
        "What limits the block size",
        (
            Column("limit"),
            Column("blocks", "", ",.0f"),
            Column("more", "", "+,.0f"),
            Column("triangles", "", "+,.0f"),
            Column("wanted"),
        ),
        tuple(rows),
        (f"{note}{report.on_target.rms_log:.3f}.",),
    )


def levels_table(report: LayoutReport) -> Table:
    """Return triangles and unknowns of every level, and memory per rank where ranks are asked for."""
    ranks = report.ranks
    topology = report.grid.layout.placed.topology
    n_interfaces = len(topology.edges) - int(topology.is_boundary_edge.sum())
    rows: list[tuple[Value, ...]] = []
    sides = tuple(level.side for level in report.levels)
    for k, level in enumerate(report.levels):
        row: tuple[Value, ...] = (
            k,
            level.side,
            level.n_triangles,
            level.p1,
            level.p2,
            level.interface_edges,
        )
        rows.append(row if ranks is None else (*row, ranks.memory(sides[: k + 1]) / 2**20))
    columns = [
        Column("level"),
        Column("s"),
        Column("triangles"),
        Column("P1 unknowns"),
        Column("P2 unknowns"),
        Column("interface edges"),
    ]
    notes = [f"{counted(n_interfaces, 'interface')} between blocks."]
    if ranks is not None:
        columns.append(Column("per rank", "MiB", ".3g"))
        notes.append(
            f"{counted(ranks.n_ranks, 'rank')}: {ranks.blocks_least} to {ranks.blocks_most} blocks each, "
            f"most over mean {ranks.imbalance:.2f}; memory of the fullest: {VECTORS} vectors of"
        )
        notes.append(
            f"{BYTES_PER_UNKNOWN}-byte P1 unknowns, each block with its own rim, this level and all coarser "
            "ones, no matrices (P2: 4 x)."
        )
    return Table("Levels of refinement", tuple(columns), tuple(rows), tuple(notes))


def _edges(ratio: EdgeRatio) -> str:
    return f"{ratio.p05:.2f} {ratio.p50:.2f} {ratio.p95:.2f}"
