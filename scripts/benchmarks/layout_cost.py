"""What layouts cost, and how that grows: two archipelagos, the larger of 20 000 blocks of 16 triangles."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .cost import cost_of_python
from .meshes import archipelago
from .row import Row

TITLE = "Cost of layouts"

SIDE = 4

N_TRIANGLES = (80_000, 320_000)
"""Triangles of the two meshes."""

EFFORT = 100
"""Sweeps: the default."""


class LayoutCost(NamedTuple):
    """One layout."""

    n_input: int
    """Triangles of the mesh."""
    n_blocks: int
    n_triangles: int
    """Triangles of the grid."""
    blocks: float
    """CPU seconds until the blocks are annealed."""
    grid: float
    """CPU seconds from there to the verified grid, the polish of the blocks included."""
    peak: float
    """Largest resident set of the process, bytes."""


def rows(*, effort: int = EFFORT) -> Iterator[Row]:
    """Lay out both; memory is that of the larger over that of the smaller, by triangle of difference."""
    small, large = (layout_cost(n, effort) for n in N_TRIANGLES)
    for cost in (small, large):
        what = f"{cost.n_blocks} blocks of {SIDE**2}"
        each = 1e3 * cost.blocks / cost.n_blocks
        yield Row(f"{what}: blocks", each, "ms CPU a block", below=20 * effort / EFFORT)
        yield Row(f"{what}: grid", 1e3 * cost.grid / cost.n_triangles, "ms CPU a triangle", below=1)
    growth = (large.blocks / large.n_blocks) / (small.blocks / small.n_blocks)
    yield Row("CPU a block, the larger over the smaller", growth, "x", below=1.3)
    memory = (large.peak - small.peak) / (large.n_input - small.n_input)
    yield Row("memory a triangle of the input", memory, "B", below=5000)


def layout_cost(n_triangles: int, effort: int) -> LayoutCost:
    """Lay out an archipelago of about so many triangles in a process of its own."""
    mesh = archipelago(n_triangles)
    with tempfile.TemporaryDirectory() as folder:
        path, result = Path(folder) / "mesh.npz", Path(folder) / "cost.json"
        np.savez(path, points=mesh.points, triangles=mesh.triangles)
        script = Path(__file__).with_name("layout_run.py")
        used = cost_of_python([str(script), str(path), str(SIDE), str(effort), str(result)])
        return LayoutCost(mesh.n_triangles, **json.loads(result.read_text()), peak=used.peak)
