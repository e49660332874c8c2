"""The inverse question: the block size that plans a mesh with at most so many blocks, or why none does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil, sqrt

from ..errors import InvalidOption, NoPatternFits
from .plan import Plan

PATIENCE = 3
"""Block sizes tried after the need has stopped falling."""

COUNT_TOLERANCE = 0.05
"""Patterns may need this much less than triangles / s^2 blocks, by rounding: such sizes are tried too."""


@dataclass(frozen=True)
class Need:
    """Blocks that a plan needs, and the driver that demands them."""

    n_blocks: int
    """The largest of the drivers' counts."""
    driver: str
    """Its name, in words."""


def need(plan: Plan) -> Need:
    """Return the blocks needed at a plan's block size: the largest of patterns, gradient and boundary."""
    counts = {
        "the boundary (three block edges around every loop)": plan.drivers.blocks_boundary,
        f"resolution (the patterns of {len(plan.regions)} regions)": plan.n_blocks,
        f"the size gradient (block size limited to a slope of {plan.gradient_limit:g})": round(
            plan.drivers.blocks_gradient_limited
        ),
    }
    driver = max(counts, key=lambda name: counts[name])
    return Need(counts[driver], driver)


def within(plan_at: Callable[[int], Plan], n_triangles: float, n_blocks: int) -> Plan:
    """Return the plan at the smallest block size that needs at most n_blocks.

    Any larger block that the mesh carries needs fewer still, and more triangles. plan_at makes the plan for
    a number of triangles per block; sides s whose n_triangles / s^2 exceeds n_blocks are not tried, nor
    more once the need no longer falls or a block is larger than the mesh. Raises NoPatternFits with the
    least need and the driver that forbids fewer, InvalidOption where n_blocks is under 1.
    """
    if n_blocks < 1:
        raise InvalidOption(f"{n_blocks} blocks is under 1; give the most blocks you accept")
    side = max(1, ceil(sqrt(n_triangles / n_blocks) * (1 - COUNT_TOLERANCE)))
    least: tuple[int, int, str] | None = None
    stalled = 0
    while stalled < PATIENCE and (least is None or side * side <= n_triangles):
        plan = plan_at(side * side)
        found = need(plan)
        if found.n_blocks <= n_blocks and side * side <= n_triangles:
            return plan
        stalled = 0 if least is None or found.n_blocks < least[0] else stalled + 1
        if least is None or found.n_blocks <= least[0]:  # of equals the last: its driver still binds
            least = (found.n_blocks, side * side, found.driver)
        side += 1 if stalled == 0 else side // 4 + 1
    count, tris_per_block, driver = least if least is not None else (0, 1, "")
    raise NoPatternFits(
        f"no block size plans this mesh with {n_blocks} blocks; the least is {count}, "
        f"at {tris_per_block} triangles per block, and {driver} forbids fewer"
    )
