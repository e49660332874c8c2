"""The inverse question: the largest block that plans a mesh with at most so many blocks, or why not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..errors import InvalidOption, NoPatternFits
from .plan import Plan

LARGEST_SIDE = 64
"""Elements along a block edge beyond which no block size is tried: 4096 triangles a block."""


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
        f"resolution (the patterns of {len(plan.regions)} regions)": plan.n_blocks,
        f"the size gradient (block size limited to a slope of {plan.gradient_limit:g})": round(
            plan.drivers.blocks_gradient_limited
        ),
        "the boundary (three block edges around every loop)": plan.drivers.blocks_boundary,
    }
    driver = max(counts, key=lambda name: counts[name])
    return Need(counts[driver], driver)


def coarsest(plan_at: Callable[[int], Plan], n_blocks: int) -> Plan:
    """Return the plan with the largest triangles per block that needs at most n_blocks.

    plan_at makes the plan for a number of triangles per block. Sides 1, 2, 3, .. are tried as long as the
    need can still fall. Raises NoPatternFits with the least need and its driver where none is small enough.
    """
    if n_blocks < 1:
        raise InvalidOption(f"{n_blocks} blocks is under 1; give the most blocks you accept")
    first = plan_at(1)
    least, least_at = need(first), 1
    best = first if least.n_blocks <= n_blocks else None
    side, stalled = 2, 0
    while side <= LARGEST_SIDE and stalled < 3:
        plan = plan_at(side * side)
        found = need(plan)
        if found.n_blocks <= n_blocks:
            best = plan
        if found.n_blocks < least.n_blocks:
            least, least_at, stalled = found, side * side, 0
        else:
            stalled += 1
        if plan.drivers.blocks_by_count < 1:
            break
        side += 1
    if best is not None:
        return best
    raise NoPatternFits(
        f"no block size plans this mesh with {n_blocks} blocks; the least is {least.n_blocks}, "
        f"at {least_at} triangles per block, and {least.driver} forbids fewer"
    )
