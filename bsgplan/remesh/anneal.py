"""A part of a mesh annealed at the mesh's own size: the fewest irregular vertices that fit its frozen rim.

Deterministic: the same seed gives the same mesh.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Floats
from ..blocks.cooling import cooled
from ..blocks.placed import PlacedMesh
from .by_strips import CLEANUP, Tries, with_strips
from .cut import Cut
from .mend import mended
from .polish import polished
from .restore import restored
from .wish import Wish

SCHEDULE = replace(CLEANUP, hot=0.35, first_shift=-0.05)
"""How parts are annealed: a mesh of few defects has fewer triangles, and they follow a shift slowly."""

SMALL, MOST_FOLD = 16_000, 4.0
"""Parts of fewer triangles get sqrt(SMALL / triangles) times the sweeps, at most MOST_FOLD times."""

STRIPS = 0.5
"""Share of the sweeps that strips get: they have little to forget."""

MAIN = 0.7
"""Share of the time that the annealing of the part's own triangles takes, for the progress bar."""


@dataclass(frozen=True, eq=False)
class Remeshed:
    """A part annealed."""

    mesh: PlacedMesh
    """The mesh, its rim as it was, every triangle positive."""
    strips: Tries
    """What came of strips in it."""


def remeshed(
    cut: Cut,
    log_size: Floats,
    wish: Wish,
    *,
    n_sweeps: int,
    seed: int,
    progress: Callable[[str, float], None] = lambda _, __: None,
    is_stopped: Callable[[], bool] = lambda: False,
) -> Remeshed:
    """Return the part with few irregular vertices, its rim as it was, every triangle positive.

    log_size is the log of the wanted edge at the domain's points, in its unit. progress hears of the
    irregular vertices and the share of the work done. is_stopped is asked before every sweep; from a True on
    there is a quench and a polish, no more.
    """
    end = cooled(
        cut.domain,
        cut.start,
        log_size,
        SCHEDULE,
        n_sweeps=n_sweeps,
        n_wanted=wish.n_triangles,
        rms_wanted=max(wish.size_misfit, 1e-6),
        seed=seed,
        progress=lambda text, share: progress(text, share * MAIN),
        is_stopped=is_stopped,
    )
    mesh = polished(cut.domain, end.mesh, log_size, size_weight=end.size_weight, offset=end.offset)
    mesh, strips = with_strips(
        cut.domain, mesh, log_size, wish,
        n_sweeps=max(1, round(STRIPS * n_sweeps)), seed=seed,
        progress=lambda text, share: progress(text, MAIN + share * (1 - MAIN)), is_stopped=is_stopped,
    )  # fmt: skip
    if not is_stopped():
        mesh = mended(cut.domain, mesh, log_size, wish.least, seed=seed, offset=end.offset)
        mesh = restored(
            cut.domain, cut.start, mesh, log_size, wish.floor, seed=seed, offset=end.offset
        )  # fmt: skip
    return Remeshed(mesh, strips)


def n_sweeps(n_triangles: int, effort: int) -> int:
    """Return the sweeps that a part gets: more where it is small, so that chance matters less.

    >>> n_sweeps(16_000, 30), n_sweeps(300, 30)
    (30, 120)
    """
    return max(1, round(effort * float(np.clip(np.sqrt(SMALL / n_triangles), 1.0, MOST_FOLD))))
