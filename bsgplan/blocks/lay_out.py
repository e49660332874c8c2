"""The verb: from a mesh and its size field to a verified grid of blocks."""

from __future__ import annotations

from collections.abc import Callable
from math import isqrt

import numpy as np

from ..arrays import Bools, Ints
from ..errors import InvalidOption
from ..sizing import SizeField
from .anneal import SIZE_TOLERANCE, annealed
from .domain import domain_of
from .gridded import gridded, unbent
from .layout import BlockGrid, BlockLayout
from .placed import place
from .repair import repaired
from .target import target_of
from .verify import verified

EFFORT = 100
"""Default sweeps of the annealing."""


def lay_out(
    size: SizeField,
    *,
    tris_per_block: int = 16,
    effort: int = EFFORT,
    size_tolerance: float = SIZE_TOLERANCE,
    gradient_limit: float | None = None,
    seed: int = 7,
    interfaces: Bools | None = None,
    kept: Ints | None = None,
    is_straight: bool = False,
    progress: Callable[[str, float], None] = lambda _, __: None,
    is_stopped: Callable[[], bool] = lambda: False,
) -> BlockGrid:
    """Return the block-structured grid of a size field's mesh, its blocks tris_per_block triangles each.

    interfaces marks edges of the mesh that no block may cross, kept lists points that must be corners of
    blocks. gradient_limit bounds the gradient of the block size; None chooses by the raggedness of the
    boundary. is_stopped ends the annealing early where it gives True: the best layout so far is finished.
    Raises InvalidMesh for a surface in space, LayoutRefused where no valid layout was found.
    """
    side = isqrt(tris_per_block)
    if side * side != tris_per_block:
        raise InvalidOption(f"{tris_per_block} triangles per block is no square; give for example 16")
    domain = domain_of(size.mesh, interfaces=interfaces, kept=kept)
    target = target_of(domain, size, side, gradient_limit=gradient_limit)
    log_size = np.log(target.length / domain.scale)
    start = place(domain, target.is_corner, target.turning)
    blocks = annealed(
        domain,
        start,
        log_size,
        effort=effort,
        size_tolerance=size_tolerance,
        seed=seed,
        progress=progress,
        is_stopped=is_stopped,
    )
    layout = BlockLayout(size, domain, target, blocks)
    return verified(unbent(repaired(gridded(layout, is_straight=is_straight), seed=seed)))
