"""Whether a block size is worth the time: told from the target alone, before any block is laid."""

from __future__ import annotations

from ..sizing import SizeField
from .domain import Domain
from .target import Target, target_of

POINTLESS = 1.5
"""Where the limits cost more than this factor in blocks, even at their highest floor, smaller blocks are
better in all: the Bohai Sea had 3.6 times the triangles in blocks of 64, and more irregular vertices."""


def cost(target: Target) -> float:
    """Return blocks that the limits leave over blocks that the size field alone asks for, at least 1."""
    return max(1.0, target.blocks["boundary"] / target.blocks["resolution"])


def advice(domain: Domain, size: SizeField, side: int, *, gradient_limit: float | None = None) -> str | None:
    """Return why blocks of side x side triangles are pointless on this domain, and which are not; or None."""
    first = target = target_of(domain, size, side, gradient_limit=gradient_limit)
    while cost(target) > POINTLESS and target.side > 1:
        target = target_of(domain, size, target.side // 2, gradient_limit=gradient_limit)
    return None if target is first else told(first, target)


def told(pointless: Target, better: Target) -> str:
    """Return the sentence that advises a smaller block size."""
    return (
        f"{pointless.side**2} triangles per block are pointless here: {pointless.raggedness:.0%} of the "
        f"boundary's length carries no such edge, which makes {cost(pointless):.1f} times the blocks and "
        f"triangles; --tris-per-block {better.side**2} makes {cost(better):.1f} times"
    )
