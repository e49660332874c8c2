"""A part of a mesh annealed at the mesh's own size: the fewest irregular vertices that fit its frozen rim.

Deterministic: the same seed gives the same mesh. The wanted size is shifted while the annealing runs until
there are as many triangles as wanted, and the weight of sizes raised while edges stray more than before.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..blocks.anneal import POLISH, POWERS, SIZE_WEIGHT, size_rms
from ..blocks.placed import PlacedMesh
from ..blocks.smooth import qualities
from .cut import Cut
from .mend import mended

HOT, COLD = 0.35, 0.03
"""First and last temperature, in units of the energy of a triangle."""

MOVES = 2
"""Moves a triangle and sweep."""

STAGES = 10
"""The annealing halts so many times to relax everything, to renew energies and to steer."""

STEERED = 9
"""Stages after which the count is no longer steered."""

SHIFT, MOST_SHIFT = -0.05, 0.2
"""First and largest shift of the log of the wanted edge: a mesh of few defects has fewer triangles."""

GAIN = 0.3
"""Share of the log of triangles over wanted by which a stage shifts it; they follow slowly."""

MOST_SIZE_WEIGHT = 2.0
"""The most that the weight of sizes is raised to."""

SMALL, MOST_FOLD = 16_000, 4.0
"""Parts of fewer triangles get sqrt(SMALL / triangles) times the sweeps, at most MOST_FOLD times."""


@dataclass(frozen=True)
class Wish:
    """What the annealing steers to."""

    n_triangles: float
    """Triangles wanted."""
    size_misfit: float
    """rms of log(edge / wanted edge) that the part has now."""
    quality: float = 0.0
    """Triangles under this mean ratio are mended."""


def remeshed(
    cut: Cut,
    log_size: Floats,
    wish: Wish,
    *,
    effort: int,
    seed: int,
    progress: Callable[[str, float], None] = lambda _, __: None,
) -> PlacedMesh:
    """Return the part with few irregular vertices, its rim as it was, every triangle positive.

    log_size is the log of the wanted edge at the domain's points, in its unit. effort is the number of sweeps
    for SMALL triangles. progress hears of the irregular vertices and the share of the work done.
    """
    from ..blocks.kernel.anneal import anneal
    from ..blocks.kernel.exchange import load, unload
    from ..blocks.kernel.state import TEMPERATURE
    from ..blocks.kernel.sweeps import relax_all

    mesh, offset, weight = cut.start, SHIFT, SIZE_WEIGHT
    temperatures = HOT * (COLD / HOT) ** np.linspace(0.0, 1.0, n_sweeps(len(mesh.triangles), effort))
    n_stages = min(STAGES, len(temperatures))
    for stage, part in enumerate(np.array_split(temperatures, n_stages)):
        state = load(
            cut.domain, mesh, log_size, seed=seed + stage, size_weight=weight, bend_weight=0.0, offset=offset
        )
        for temperature in part:
            state.scalar[TEMPERATURE] = temperature
            anneal(state, MOVES * len(mesh.triangles))
        relax_all(state, 2)
        mesh = unload(state)
        if stage < STEERED:
            shift = offset + GAIN * np.log(len(mesh.triangles) / wish.n_triangles)
            offset = float(np.clip(shift, -MOST_SHIFT, MOST_SHIFT))
            if stage > 1:
                stray = size_rms(cut.domain, mesh, log_size) / max(wish.size_misfit, 1e-6)
                weight = float(np.clip(weight * np.clip(stray, 0.7, 1.5), SIZE_WEIGHT, MOST_SIZE_WEIGHT))
        progress(f"{np.count_nonzero(mesh.is_irregular)} irregular vertices", (stage + 1) / (n_stages + 1))
    mesh = polished(cut, mesh, log_size, size_weight=weight, offset=offset)
    return mended(cut.domain, mesh, log_size, wish.quality, seed=seed, offset=offset)


def n_sweeps(n_triangles: int, effort: int) -> int:
    """Return the sweeps that a part gets: more where it is small, so that chance matters less.

    >>> n_sweeps(16_000, 30), n_sweeps(300, 30)
    (30, 120)
    """
    return max(1, round(effort * float(np.clip(np.sqrt(SMALL / n_triangles), 1.0, MOST_FOLD))))


def polished(
    cut: Cut, mesh: PlacedMesh, log_size: Floats, *, size_weight: float, offset: float
) -> PlacedMesh:
    """Return the mesh with its vertices moved, more and more for its worst triangle; sizes as they weigh."""
    from ..blocks.kernel.exchange import load, unload
    from ..blocks.kernel.state import POWER
    from ..blocks.kernel.sweeps import relax_all, renew

    state = load(
        cut.domain, mesh, log_size, room=1.0, size_weight=size_weight, bend_weight=0.0, offset=offset
    )
    for power in POWERS:
        state.scalar[POWER] = power
        renew(state)
        relax_all(state, POLISH)
    moved = unload(state)
    return moved if qualities(moved).min() > qualities(mesh).min() else mesh
