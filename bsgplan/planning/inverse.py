"""The inverse question: the block size that plans a mesh with at most so many blocks, or why none does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import ceil, isqrt, sqrt

from ..errors import InvalidOption, NoPatternFits
from .plan import Plan

EVERY_SIDE = 64
"""Sides of blocks under this are tried one by one, longer ones in steps of a half of this part of them."""

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


def within(
    plan_at: Callable[[int], Plan], least_at: Callable[[int], int], n_triangles: float, n_blocks: int
) -> Plan:
    """Return the plan at the smallest block size that needs at most n_blocks.

    Any larger block that the mesh carries needs fewer still, and more triangles. plan_at makes the plan for
    a number of triangles per block, least_at the need without its patterns, which costs little: plans are
    made only where that is not too much. Sides s whose n_triangles / s^2 exceeds n_blocks are not tried, nor
    those of blocks larger than the mesh. Raises NoPatternFits with the least need and the driver that forbids
    fewer, InvalidOption where n_blocks is under 1.
    """
    if n_blocks < 1:
        raise InvalidOption(f"{n_blocks} blocks is under 1; give the most blocks you accept")
    first = max(1, ceil(sqrt(n_triangles / n_blocks) * (1 - COUNT_TOLERANCE)))
    sides = [side for side in _sides(n_triangles) if side >= first] or [isqrt(int(n_triangles)) or 1]
    needs: dict[int, Need] = {}
    least = cache(lambda side: least_at(side * side))
    for side in sides:
        if least(side) <= n_blocks:
            plan = plan_at(side * side)
            needs[side] = need(plan)
            if needs[side].n_blocks <= n_blocks:
                return plan
    for side in sorted(set(sides) - set(needs), key=lambda side: (least(side), side)):
        if least(side) < min((found.n_blocks for found in needs.values()), default=least(side) + 1):
            needs[side] = need(plan_at(side * side))
    side = min(needs, key=lambda side: (needs[side].n_blocks, -side))
    raise NoPatternFits(
        f"no block size plans this mesh with {n_blocks} blocks; the least is {needs[side].n_blocks}, "
        f"at {side * side} triangles per block, and {needs[side].driver} forbids fewer"
    )


def _sides(n_triangles: float) -> list[int]:
    """Return the sides of blocks that are tried, whatever the question: of blocks no larger than the mesh.

    >>> _sides(70**2)[-4:]
    [64, 66, 68, 70]
    """
    sides, side = [], 1
    while side * side <= n_triangles:
        sides.append(side)
        side += max(1, 2 * side // EVERY_SIDE)
    return sides
