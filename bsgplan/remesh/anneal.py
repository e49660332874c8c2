"""A part of a mesh annealed at the mesh's own size: the fewest irregular vertices that fit its frozen rim.

Deterministic: the same seed gives the same mesh.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..blocks.anneal import POLISH
from ..blocks.cooling import STAGES, Schedule, cooled
from ..blocks.placed import PlacedMesh
from ..blocks.smooth import qualities
from .cut import Cut
from .mend import mended

SCHEDULE = Schedule(
    hot=0.35, cold=0.03, moves=2, steered=9, gain=0.3, most_shift=0.2, most_size_weight=2.0, first_shift=-0.05
)  # fmt: skip
"""How parts are annealed: a mesh of few defects has fewer triangles, and they follow a shift slowly."""

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
    n = n_sweeps(len(cut.start.triangles), effort)
    n_stages = min(STAGES, n)
    end = cooled(
        cut.domain,
        cut.start,
        log_size,
        SCHEDULE,
        n_sweeps=n,
        n_wanted=wish.n_triangles,
        rms_wanted=max(wish.size_misfit, 1e-6),
        bend_weight=0.0,
        seed=seed,
        progress=lambda text, share: progress(text, share * n_stages / (n_stages + 1)),
    )
    mesh = polished(cut, end.mesh, log_size, size_weight=end.size_weight, offset=end.offset)
    return mended(cut.domain, mesh, log_size, wish.quality, seed=seed, offset=end.offset)


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
    from ..blocks.kernel.schedule import polish

    state = load(
        cut.domain, mesh, log_size, room=1.0, size_weight=size_weight, bend_weight=0.0, offset=offset
    )
    polish(state, POLISH)
    moved = unload(state)
    return moved if qualities(moved).min() > qualities(mesh).min() else mesh
