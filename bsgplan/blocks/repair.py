"""Repair: where a grid has poor triangles its blocks are wanted smaller, and the layout settles once more.

A block is poor mostly because its side is a chord across a bay. There the wanted size is lowered, the
blocks are split, and the topology quenched at low temperature; all else stays as it is.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Floats, Ints
from .domain import Domain
from .gridded import gridded
from .lack import POOR, lacks, qualities
from .layout import BlockGrid, BlockLayout
from .outline import crossings, outline
from .placed import PlacedMesh
from .target import limited, n_blocks

ROUNDS = 3
"""Repairs one after the other; each begins with what the one before left, until one does not help."""

PATIENCE = 8
"""Rounds before them for broken blocks alone, which would be refused: mild ones, nothing else is stirred."""

SHRINK = 0.6
"""The wanted block edge at a poor block is lowered by this factor, ..."""

LEAST = 0.5
"""... but to no less than this multiple of h: sides as short as the input's follow its boundary."""

REACH = 0.75
"""It is lowered within this multiple of the block's longest edge from its middle."""

STEEPEST = 1.0
"""The gradient of the lowered size, unless the target has a stricter limit."""

SWEEPS, COLD = 8, 0.03
"""Sweeps of the quench and their temperature."""

POLISH = 10
"""Sweeps at each exponent of the polish afterwards."""

GAIN = 0.01
"""A repair has to lower the sum of lacks by more than this."""


def repaired(grid: BlockGrid, *, seed: int) -> BlockGrid:
    """Return the grid, or a better one if some of its triangles are inverted, cross or are poor."""
    best = current = _mended(grid, seed)
    for turn in range(ROUNDS):
        poor = poor_blocks(current)
        if not len(poor):
            break
        current = _remade(current, poor, seed + turn, n_coarsenings=ROUNDS)
        if _merit(current) <= (_merit(best)[0], _merit(best)[1] + GAIN):
            break
        best = current
    return best


def _mended(grid: BlockGrid, seed: int) -> BlockGrid:
    """Return the grid with broken blocks made smaller by themselves, as far as that helps."""
    best = current = grid
    for turn in range(PATIENCE):
        broken = broken_blocks(current)
        if not len(broken):
            return current
        current = _remade(current, broken, seed + turn, n_coarsenings=0)
        best = max(best, current, key=_merit)
    return best


def broken_blocks(grid: BlockGrid) -> Ints:
    """Return the blocks that are inverted, have an inverted triangle, or cross others at the boundary."""
    blocks = grid.layout.placed
    is_broken = qualities(blocks) <= 0
    crossing, domain = crossings(blocks.points, outline(blocks)), grid.layout.domain
    if len(crossing) > len(crossings(domain.points, domain.outline)):
        at_boundary, _ = np.nonzero(blocks.neighbours < 0)  # in the order of the outline
        is_broken[at_boundary[crossing.ravel()]] = True
    is_broken[grid.block[qualities(grid.placed) <= 0]] = True
    return np.flatnonzero(is_broken)


def poor_blocks(grid: BlockGrid) -> Ints:
    """Return the blocks that are broken or have a triangle under POOR."""
    is_poor = np.zeros(len(grid.layout.placed.triangles), dtype=bool)
    is_poor[broken_blocks(grid)] = True
    is_poor[grid.block[qualities(grid.placed) < POOR]] = True
    return np.flatnonzero(is_poor)


def _remade(grid: BlockGrid, some: Ints, seed: int, *, n_coarsenings: int) -> BlockGrid:
    """Return the grid of blocks annealed anew in the cold, smaller ones wanted round some."""
    layout = _lowered(grid.layout, some)
    log_size = np.log(layout.target.length / layout.domain.scale)
    blocks = _quenched(layout.domain, layout.placed, log_size, seed, n_coarsenings)
    return gridded(replace(layout, placed=blocks), is_straight=grid.is_straight)


def _merit(grid: BlockGrid) -> tuple[int, float]:
    """Return what a better grid has more of: minus inverted triangles and crossings, minus lacks."""
    n_bad, lack = 0, 0.0
    for mesh in (grid.layout.placed, grid.placed):
        quality = qualities(mesh)
        n_bad += int(np.count_nonzero(quality <= 0)) + len(crossings(mesh.points, outline(mesh)))
        lack = float(lacks(quality).sum())
    return -n_bad, -lack


def _lowered(layout: BlockLayout, poor: Ints) -> BlockLayout:
    """Return the layout with blocks wanted smaller round the poor ones."""
    from scipy.spatial import cKDTree  # 0.1 s that an estimate need not spend

    domain, blocks, target = layout.domain, layout.placed, layout.target
    middles = blocks.points[blocks.triangles].mean(axis=1)[poor]
    log_factor = np.zeros(domain.n_points)
    reach = REACH * _longest(blocks)[poor]
    for at, near in enumerate(cKDTree(domain.points).query_ball_point(middles, reach)):
        corners = domain.triangles[blocks.hints[blocks.triangles[poor[at]]], :3].ravel()
        log_factor[near] = log_factor[corners] = np.log(SHRINK)
    least = LEAST * layout.size.h[domain.source]
    length = np.minimum(target.length, np.maximum(target.length * np.exp(log_factor), least))
    slope = min(target.gradient_limit, STEEPEST)
    own_length = limited(domain, length / domain.scale, slope)
    counts = target.blocks | {"repair": n_blocks(domain, own_length)}
    return replace(layout, target=replace(target, length=domain.scale * own_length, blocks=counts))


def _quenched(
    domain: Domain, blocks: PlacedMesh, log_size: Floats, seed: int, n_coarsenings: int
) -> PlacedMesh:
    """Return blocks remeshed towards the wanted size where they are off it, and annealed in the cold."""
    from .kernel.coarsen import coarsen
    from .kernel.exchange import load, unload
    from .kernel.schedule import cool, polish

    state = load(domain, blocks, log_size, seed=seed)
    coarsen(state, n_coarsenings)
    cool(state, [COLD] * SWEEPS, len(blocks.triangles))
    polish(state, POLISH)
    return unload(state)


def _longest(mesh: PlacedMesh) -> Floats:
    a, b, c = mesh.points[mesh.triangles].swapaxes(0, 1)
    return np.asarray(np.maximum.reduce([np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))]))
