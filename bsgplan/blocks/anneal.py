"""From the input's own triangulation to a block layout: remesh down, anneal the topology, polish.

Deterministic: the same seed gives the same layout.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import log

import numpy as np

from ..arrays import Floats
from .cooling import Schedule, cooled
from .domain import Domain
from .placed import PlacedMesh
from .target import n_blocks
from .weights import BLOCKS, SIZE_WEIGHT

SCHEDULE = Schedule(
    weights=BLOCKS,
    hot=0.45,
    cold=0.03,
    moves=10,
    steered=8,
    gain=0.4,
    most_shift=0.2,
    most_size_weight=SIZE_WEIGHT,
    credit=1.0,
)
"""How layouts are annealed at the default tolerance of sizes."""

MOST_SIZE_WEIGHT = 3.0
"""The most that a strict tolerance raises the weight of sizes to."""

SIZE_TOLERANCE = 1.2
"""Default tolerance: rms of log(edge / wanted) at most ln 1.2 asked for."""

ROUNDS = 12
"""Rounds of remeshing before the annealing."""

POLISH = 15
"""Sweeps at each exponent of the polish."""


def annealed(
    domain: Domain,
    start: PlacedMesh,
    log_size: Floats,
    *,
    effort: int,
    size_tolerance: float,
    seed: int,
    progress: Callable[[str, float], None] = lambda _, __: None,
    is_stopped: Callable[[], bool] = lambda: False,
) -> PlacedMesh:
    """Return a layout of the domain with few irregular vertices whose edges follow exp(log_size).

    log_size is given at the domain's points, in its own unit. effort is the number of sweeps. The rms of
    log(edge / wanted) is asked to be at most log(size_tolerance); `most_size_weight` says what that may cost
    in irregular vertices. progress hears of the number of irregular
    vertices and the share of the work done. is_stopped is asked before every sweep; from a True on the mesh
    there is gets some cold sweeps and the polish, no more.
    """
    from .kernel.coarsen import coarsen
    from .kernel.exchange import load, unload
    from .kernel.schedule import polish

    state = load(domain, start, log_size, room=1.5, seed=seed)
    coarsen(state, ROUNDS)
    end = cooled(
        domain,
        unload(state),
        log_size,
        replace(SCHEDULE, most_size_weight=most_size_weight(size_tolerance)),
        n_sweeps=max(effort, 1),
        n_wanted=n_blocks(domain, np.exp(log_size)),
        rms_wanted=float(np.log(size_tolerance)),
        seed=seed,
        progress=progress,
        is_stopped=is_stopped,
    )
    weights = replace(BLOCKS, size=end.size_weight)
    state = load(domain, end.mesh, log_size, seed=seed, weights=weights, offset=end.offset)
    polish(state, POLISH)
    return unload(state)


def most_size_weight(size_tolerance: float) -> float:
    """Return the largest weight of sizes for a tolerance: as the inverse square of its logarithm.

    An rms of log(edge / wanted) of log(size_tolerance) then costs as much at every tolerance.

    >>> most_size_weight(SIZE_TOLERANCE), most_size_weight(1.0)
    (0.55, 3.0)
    """
    if size_tolerance <= 1.0:
        return MOST_SIZE_WEIGHT
    share = (log(SIZE_TOLERANCE) / log(size_tolerance)) ** 2
    return min(SCHEDULE.most_size_weight * share, MOST_SIZE_WEIGHT)
