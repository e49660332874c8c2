"""A plan as tables: its regions, Table 2 of the paper in total and per region, and what sets the count."""

from __future__ import annotations

from collections.abc import Sequence
from math import isqrt

from ..planning import OBJECTIVES, Candidate, Plan, RegionPlan, choose
from ..planning.plan import n_refinements
from .driver_table import drivers_table
from .table import QUALITY, Column, Table, Value, number

LONGEST_PATTERN = 28
"""Characters of a pattern shown in a row; the rest is in the JSON document."""

MOST_COLUMNS = 6
"""Candidates shown beside the unstructured mesh in a table of one region."""


def tables(plan: Plan, *, all_candidates: bool = False) -> list[Table]:
    """Return the tables of one plan: regions, Table 2 in total, drivers; and Table 2 of each region.

    The tables of single regions come where there are few, or with all_candidates.
    """
    transitions = [p for p in plan.region_plans if p.chosen is not None]
    single = transitions if all_candidates or len(transitions) <= 2 else []
    return [regions_table(plan), *(region_table(p) for p in single), totals_table(plan), drivers_table(plan)]


def regions_table(plan: Plan) -> Table:
    """Return one row a region and their total."""
    columns = (
        Column("region"),
        Column("kind"),
        Column("triangles"),
        Column("fine:coarse", "elements"),
        Column("fronts", "", ".1f"),
        Column("pattern"),
        Column("blocks"),
        Column("planned tris"),
        Column("q_min mesh", "", QUALITY),
        Column("q_min plan", "", QUALITY),
        Column("q_bound", "", QUALITY),
        Column("iota+ mesh"),
        Column("iota+ plan"),
        Column("charge", "", ".1f"),
    )
    rows = [_region_row(p) for p in plan.region_plans]
    mesh = plan.regions.size.mesh
    inside = plan.regions.label >= 0
    total: tuple[Value, ...] = (
        "total",
        f"{len(plan.regions)} region{'' if len(plan.regions) == 1 else 's'}",
        sum(p.region.n_triangles for p in plan.region_plans),
        *(None, None, None),
        plan.n_blocks,
        plan.planned_triangles,
        float(mesh.qualities[inside].min()),
        plan.q_min,
        plan.q_bound,
        sum(p.region.irregularity.positive for p in plan.region_plans),
        plan.irregularity.positive,
        plan.regions.charge,
    )
    title = (
        f"Plan at {plan.tris_per_block} triangles per block ({_block(plan.tris_per_block)}), {plan.objective}"
    )
    return Table(title, columns, (*rows, total), _notes(plan))


def region_table(plan: RegionPlan) -> Table:
    """Return Table 2 of the paper for one region: the unstructured mesh beside the candidates."""
    region = plan.region
    shown = _shown(plan)
    columns = (Column(""), Column("unstructured"), *(Column(_heading(c, plan)) for c in shown))
    rows: list[tuple[Value, ...]] = [
        ("# blocks", None, *(c.n_blocks for c in shown)),
        ("# triangles", region.n_triangles, *(c.planned_triangles for c in shown)),
        ("q_min", number(region.q_min, QUALITY), *(number(c.q_min, QUALITY) for c in shown)),
        ("q_bound", None, *(f"< {c.bounds.q_bound:.2f}" for c in shown)),
        ("iota+", region.irregularity.positive, *(c.pattern.irregularity.positive for c in shown)),
        (
            "per front",
            None,
            *(_shortened(" ".join(f"{i:+d}" for i in c.pattern.front_irregularity)) for c in shown),
        ),
        ("size misfit", None, *(f"{c.misfit:.2f}" for c in shown)),
    ]
    rejected = tuple(f"rejected: {c.pattern}: {c.rejected}." for c in plan.candidates if c.rejected)
    profile = region.profile
    fronts = "closed rings" if region.is_closed else "open strips"
    title = (
        f"Region {region.id}: {profile.fine_elements:.1f} to {profile.coarse_elements:.1f} elements on "
        f"{profile.fronts:.1f} fronts ({profile.layers:.1f} layers), {fronts}"
    )
    return Table(title, columns, tuple(rows), rejected)


def totals_table(plan: Plan) -> Table:
    """Return Table 2 of the paper for the whole domain, one column an objective."""
    transitions = [p for p in plan.region_plans if p.chosen is not None]
    uniform = sum(p.n_blocks for p in plan.region_plans if p.chosen is None)
    chosen = {name: [choose(p.candidates, name) for p in transitions] for name in OBJECTIVES}
    columns = (Column(""), Column("unstructured"), *(Column(f"by {name}") for name in chosen))
    blocks = [uniform + sum(c.n_blocks for c in picks) for picks in chosen.values()]
    irregular = [sum(c.pattern.irregularity.positive for c in picks) for picks in chosen.values()]
    least = [min((c.q_min for c in picks), default=None) for picks in chosen.values()]
    n_triangles = sum(p.region.n_triangles for p in plan.region_plans)
    q_min = min(p.region.q_min for p in plan.region_plans)
    rows: tuple[tuple[Value, ...], ...] = (
        ("# blocks", None, *blocks),
        ("# triangles", n_triangles, *(n * plan.tris_per_block for n in blocks)),
        ("q_min", number(q_min, QUALITY), *(None if q is None else number(q, QUALITY) for q in least)),
        ("iota+", sum(p.region.irregularity.positive for p in plan.region_plans), *irregular),
    )
    note = (
        "iota+ of the unstructured mesh: inside the regions. iota+ of the plans is an upper estimate: "
        "fronts shared by two regions count twice."
    )
    return Table("Whole domain, by objective", columns, rows, (note,))


def block_sizes_table(plans: Sequence[Plan]) -> Table:
    """Return one row a block size: where larger blocks stop paying."""
    columns = (
        Column("triangles per block"),
        Column("regions"),
        Column("blocks"),
        Column("planned", "triangles"),
        Column("q_min", "", QUALITY),
        Column("iota+"),
        Column("by count", "blocks", ".0f"),
        Column("gradient-limited", "blocks", ".0f"),
        Column("boundary floor", "blocks"),
        Column("limited regions"),
    )
    rows = tuple(
        (
            p.tris_per_block,
            len(p.regions),
            p.n_blocks,
            p.planned_triangles,
            p.q_min,
            p.irregularity.positive,
            p.drivers.blocks_by_count,
            p.drivers.blocks_gradient_limited,
            p.drivers.blocks_boundary,
            sum(r.limited is not None for r in p.region_plans),
        )
        for p in plans
    )
    note = (
        "Where gradient-limited exceeds by count, larger blocks cannot follow the size any more; "
        "no layout has fewer blocks than the boundary floor."
    )
    return Table("How the number of blocks answers to the block size", columns, rows, (note,))


def _region_row(p: RegionPlan) -> tuple[Value, ...]:
    region, chosen = p.region, p.chosen
    mark = ("" if region.is_monotone else " *") + (" !" if p.limited else "")
    kind = region.kind + (" ring" if region.is_closed and chosen else "") + mark
    profile = region.profile
    ends = (
        (f"{profile.fine_elements:.1f}:{profile.coarse_elements:.1f}", profile.fronts)
        if chosen
        else (None, None)
    )
    return (
        str(region.id),
        kind,
        region.n_triangles,
        *ends,
        _shortened(str(chosen.pattern)) if chosen else None,
        p.n_blocks,
        p.planned_triangles,
        region.q_min,
        chosen.q_min if chosen else None,
        chosen.bounds.q_bound if chosen else None,
        region.irregularity.positive,
        p.irregularity.positive,
        region.charge,
    )


def _notes(plan: Plan) -> tuple[str, ...]:
    notes = []
    if any(not p.region.is_monotone for p in plan.region_plans):
        notes.append("* merged with a neighbour, no longer monotone.")
    floor = plan.drivers.blocks_boundary
    if plan.n_blocks < floor:
        notes.append(f"! {plan.n_blocks} blocks are fewer than the {floor} that the boundary needs.")
    limited = [p for p in plan.region_plans if p.limited]
    notes += [f"! region {p.region.id}: {p.limited}." for p in limited]
    if n_refinements(plan.tris_per_block) is None:
        side = isqrt(plan.tris_per_block)
        notes.append(
            f"blocks of {plan.tris_per_block} triangles are split {side} x {side}: "
            "no hierarchy of uniform refinements below a block (4, 16, 64, .. have one)."
        )
    return tuple(notes)


def _shown(plan: RegionPlan) -> list[Candidate]:
    """Return the candidates that some objective picks, the best fits after them, rejected ones last."""
    picked = [choose(plan.candidates, name) for name in ("balanced", *OBJECTIVES)]
    first = [plan.chosen] if plan.chosen else []
    others = sorted(plan.candidates, key=lambda c: c.rejected is not None)
    return list(dict.fromkeys([*first, *picked, *others]))[:MOST_COLUMNS]


def _heading(c: Candidate, plan: RegionPlan) -> str:
    mark = " (chosen)" if c is plan.chosen else " (rejected)" if c.rejected else ""
    return _shortened(str(c.pattern)) + mark


def _shortened(words: str) -> str:
    """Return words, or their first and last parts where they are long, cut between counts."""
    if len(words) <= LONGEST_PATTERN:
        return words
    mark = ":" if ":" in words else " "
    parts = words.split(mark)
    head, tail = parts[:1], parts[-2:]
    for part in parts[1:-2]:
        if len(mark.join([*head, part, "..", *tail])) > LONGEST_PATTERN:
            break
        head.append(part)
    return mark.join([*head, "..", *tail])


def _block(tris_per_block: int) -> str:
    k = n_refinements(tris_per_block)
    side = isqrt(tris_per_block)
    return f"{k} uniform refinement{'' if k == 1 else 's'}" if k is not None else f"split {side} x {side}"
