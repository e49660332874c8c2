"""The verb gridded: a layout's blocks cut into triangles, on the true boundary and smooth unless straight."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from .lack import merit, qualities
from .layout import BlockGrid, BlockLayout
from .placed import grown
from .smooth import smooth
from .subdivide import subdivide

SHARES = ((0.7, 0.3), (0.4, 0.3), (0.0, 0.02))
"""Shares of the way to its curve that a side is bent, and the mean ratio of triangles under which it is:
part of the way where all of it would make poor triangles, no way where inverted ones were left."""


def gridded(layout: BlockLayout, *, is_straight: bool = False) -> BlockGrid:
    """Return the grid of a layout."""
    n_edges = len(layout.placed.topology.edges)
    return _grid(layout, np.zeros(n_edges) if is_straight else np.ones(n_edges), is_straight)


def unbent(grid: BlockGrid) -> BlockGrid:
    """Return the grid with sides of blocks less bent where triangles are inverted otherwise.

    The grid leaves the boundary there by a part of the bay that a chord cuts off, which the deviation tells.
    Where that does not help, as at the tip of a sharp bay, the sides stay bent.
    """
    edges = grid.layout.placed.topology
    bend = np.zeros(len(edges.edges)) if grid.is_straight else np.ones(len(edges.edges))
    for share, poor in SHARES:
        is_flat = qualities(grid.placed) < poor
        if grid.is_straight or not is_flat.any():
            break
        is_poor = np.zeros(grid.layout.n_blocks, dtype=bool)
        is_poor[grid.block[is_flat]] = True
        less = bend.copy()
        less[edges.cell_edges[grown(grid.layout.placed, is_poor, 1)]] = share
        other = _grid(grid.layout, less, is_straight=False)
        if merit(other.placed) > merit(grid.placed):
            grid, bend = other, less
    return grid


def _grid(layout: BlockLayout, bend: Floats, is_straight: bool) -> BlockGrid:
    domain, side = layout.domain, layout.side
    log_size = np.log(layout.target.length / domain.scale)
    cut = subdivide(domain, layout.placed, side, log_size, bend=bend)
    fine = cut.mesh if is_straight else smooth(domain, cut.mesh, log_size - np.log(side))
    return BlockGrid(layout, fine, cut.block, cut.i, cut.j, is_straight)
