"""The block counts of the whole domain that do not depend on patterns, each with its formula."""

from __future__ import annotations

from ..planning import Plan
from ..sizing.charge import NOISE
from .table import Column, Table, Value


def drivers_table(plan: Plan) -> Table:
    """Return the block counts that do not depend on patterns, each with its formula."""
    d = plan.drivers
    rows: list[tuple[Value, ...]] = [
        (
            "blocks by count",
            d.blocks_by_count,
            "triangles the size asks for / triangles per block, Eq. 24",
        ),
        (
            "blocks, gradient-limited",
            d.blocks_gradient_limited,
            f"integral of 1 / block area, |grad H| <= {plan.gradient_limit:g}, H <= s h",
        ),
        (
            "blocks, boundary-limited",
            d.blocks_boundary_limited,
            "as a layout is made: islands, corners, bays and channels bound the block edge too",
        ),
        (
            "gradient bound",
            d.blocks_gradient_bound,
            "sqrt(3) integral |grad log h|^2 dA / (ln tau)^2, ln tau = .5",
        ),
        ("boundary floor", d.blocks_boundary, "3 x boundary loops - 2 chi: three block edges around a loop"),
    ]
    rows += [
        (
            f"upper limit, R = {u.ratio:g}, {u.tris_per_block} a block",
            u.blocks,
            f"h' = min(h, {u.ratio:g} x the region's least h): {u.triangles:,.0f} triangles",
        )
        for u in d.blocks_upper_limit
    ]
    paper = d.paper_upper_limit
    rows += [
        (
            f"the paper's upper limit, {paper.tris_per_block} a block",
            paper.blocks,
            f"1.75 x triangles = {paper.triangles:,.0f}",
        ),
    ]
    noise = f"+-{NOISE * max(1, len(plan.regions)) ** 0.5:.1f}"
    notes = (
        f"irregularity budget in units of iota: interior {d.charge:+.1f} ({noise}), boundary "
        f"{d.boundary_charge:+.1f}; -(3/pi) flux of grad log h, together -6 chi.",
    )
    return Table(
        "What sets the number of blocks",
        (Column("driver"), Column("blocks", "", ",.0f"), Column("formula")),
        tuple(rows),
        notes,
    )
