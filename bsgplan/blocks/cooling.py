"""The annealing in stages that layouts and parts of meshes share: cool, relax everything, steer.

The wanted size is shifted while it runs until there are as many triangles as wanted, and the weight of sizes
raised while edges stray more than asked.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Floats
from ..sizing.misfit import size_misfit
from .domain import Domain
from .order import in_order
from .placed import PlacedMesh
from .weights import Weights

STAGES = 10
"""The annealing halts so many times to relax everything, to renew energies and to steer."""

WATCHED = 2
"""Stages before the weight of sizes is steered: edges stray while it is hot."""

PULL, MOST_CREDIT = 5.0, 2.0
"""By how much of itself the credit grows for each fall of the log of triangles over wanted, and to how many
times itself at most. It is none where there are too many by more than a fifth: where fjords make some dear,
the mean energy would pay for more of them anywhere."""

QUENCH = 5
"""Cold sweeps of an annealing that is stopped early."""


@dataclass(frozen=True)
class Schedule:
    """How an annealing cools and how it is steered."""

    weights: Weights
    """What counts how much; that of sizes is raised while edges stray."""
    hot: float
    """First temperature, in units of the energy of a triangle."""
    cold: float
    """Last temperature."""
    moves: int
    """Moves a triangle and sweep."""
    steered: int
    """Stages after which the count is no longer steered."""
    gain: float
    """Share of the log of triangles over wanted by which a stage shifts the log of the wanted edge."""
    most_shift: float
    """Largest shift of it."""
    most_size_weight: float
    """The most that the weight of sizes is raised to."""
    first_shift: float = 0.0
    """The shift to begin with."""
    credit: float = 0.0
    """Share of the mean energy of a triangle, that of vertices included, that each is credited with.

    Every triangle costs something, so without credit few large ones cost less than those that are wanted. The
    mean is taken anew before every sweep, as warm as the mesh is then, and `pull` steers by it."""


@dataclass(frozen=True, eq=False)
class Cooled:
    """What an annealing in stages left."""

    mesh: PlacedMesh
    """The mesh."""
    offset: float
    """What is added to the log of the wanted edge."""
    size_weight: float
    """Weight of sizes."""


def cooled(
    domain: Domain,
    mesh: PlacedMesh,
    log_size: Floats,
    schedule: Schedule,
    *,
    n_sweeps: int,
    n_wanted: float,
    rms_wanted: float,
    seed: int,
    progress: Callable[[str, float], None],
    is_stopped: Callable[[], bool] = lambda: False,
) -> Cooled:
    """Return a mesh annealed in stages, n_sweeps in all.

    log_size is given at the domain's points, in its own unit. n_wanted triangles are steered to, and
    rms_wanted of log(edge / wanted edge). progress hears of the number of irregular vertices and the share of
    the work done. is_stopped is asked before every sweep; from a True on the mesh there is gets QUENCH cold
    sweeps, no more.
    """
    from .kernel.exchange import load, unload
    from .kernel.schedule import cool, falling, give_credit, n_triangles
    from .kernel.sweeps import relax_all

    first_weight = min(schedule.weights.size, schedule.most_size_weight)
    offset, weight = schedule.first_shift, first_weight
    n_stages = min(STAGES, n_sweeps)
    for stage, part in enumerate(np.array_split(falling(schedule.hot, schedule.cold, n_sweeps), n_stages)):
        state = load(
            domain, in_order(mesh), log_size,
            seed=seed + stage, weights=replace(schedule.weights, size=weight), offset=offset,
        )  # fmt: skip
        n_moves = schedule.moves * len(mesh.triangles)
        for temperature in part:
            if schedule.credit:
                give_credit(state, schedule.credit * pull(n_triangles(state), n_wanted))
            cool(state, [temperature], n_moves, is_stopped=is_stopped)
        if is_stopped():
            cool(state, [schedule.cold] * QUENCH, n_moves)
        relax_all(state, 2)
        mesh = unload(state)
        if stage < schedule.steered:
            shift = offset + schedule.gain * np.log(len(mesh.triangles) / n_wanted)
            offset = float(np.clip(shift, -schedule.most_shift, schedule.most_shift))
            if stage >= WATCHED:
                stray = size_rms(domain, mesh, log_size) / rms_wanted
                weight *= float(np.clip(stray, 0.7, 1.5))
                weight = float(np.clip(weight, first_weight, schedule.most_size_weight))
        progress(f"{np.count_nonzero(mesh.is_irregular)} irregular vertices", (stage + 1) / n_stages)
        if is_stopped():
            break
    return Cooled(mesh, offset, weight)


def pull(n: int, n_wanted: float) -> float:
    """Return how many times its credit each of n triangles gets where n_wanted are wanted.

    >>> pull(100, 100), pull(130, 100), pull(60, 100)
    (1.0, 0.0, 2.0)
    """
    return float(np.clip(1.0 + PULL * np.log(n_wanted / n), 0.0, MOST_CREDIT))


def size_rms(domain: Domain, mesh: PlacedMesh, log_size: Floats) -> float:
    """Return the rms of log(edge / wanted edge) over the edges of a mesh."""
    from .kernel.walk import locate

    triangle, shares = locate(domain.points, domain.triangles, mesh.points, mesh.hints)
    own = (shares * log_size[domain.triangles[triangle, :3]]).sum(axis=1)
    ends = mesh.topology.edges
    length = np.linalg.norm(mesh.points[ends[:, 1]] - mesh.points[ends[:, 0]], axis=1)
    return size_misfit(length, ends, own)
