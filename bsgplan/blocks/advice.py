"""Whether a block size is worth the time: told from the target alone, before any block is laid."""

from __future__ import annotations

from .target import Target

POINTLESS = 2.0
"""Where the limits cost this many times the blocks, smaller blocks are better in all: the Bohai Sea in blocks
of 64 needs 2.7 times the blocks, 3.6 times the triangles and more irregular vertices than in blocks of 16."""


def cost(target: Target) -> float:
    """Return blocks that the limits leave over blocks that the size field alone asks for, at least 1."""
    return max(1.0, list(target.blocks.values())[-1] / target.blocks["resolution"])


def advice(target: Target, smaller: Target | None) -> str | None:
    """Return why a block size is pointless, or None; smaller is the target at half the side."""
    factor = cost(target)
    if factor < POINTLESS or target.side == 1:
        return None
    n = target.side**2
    remedy = "a coarser layout of this domain does not exist"
    if smaller is not None:
        remedy = f"--tris-per-block {smaller.side**2} costs {cost(smaller):.1f} x"
    return (
        f"{n} triangles per block are pointless here: islands, bays and channels narrower than a block cut "
        f"blocks down to {factor:.1f} x as many, and so the triangles; {remedy}"
    )
