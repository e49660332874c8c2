"""The verb gridded: a layout's blocks cut into triangles, on the true boundary and smooth unless straight."""

from __future__ import annotations

import numpy as np

from .layout import BlockGrid, BlockLayout
from .smooth import smooth
from .subdivide import subdivide


def gridded(layout: BlockLayout, *, is_straight: bool = False) -> BlockGrid:
    """Return the grid of a layout."""
    domain, side = layout.domain, layout.side
    log_size = np.log(layout.target.length / domain.scale)
    cut = subdivide(domain, layout.placed, side, log_size, snap=not is_straight)
    fine = cut.mesh if is_straight else smooth(domain, cut.mesh, log_size - np.log(side))
    return BlockGrid(layout, fine, cut.block, cut.i, cut.j, is_straight)
