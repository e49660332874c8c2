"""From the input's own triangulation to a block layout: remesh down, anneal the topology, polish.

Deterministic: the same seed gives the same layout. The wanted size is shifted while the annealing runs until
the number of blocks is what the size field expects, and the weight of sizes raised while edges stray.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..arrays import Floats
from .domain import Domain
from .placed import PlacedMesh
from .target import n_blocks

HOT, COLD = 0.4, 0.03
"""First and last temperature, in units of the energy of a triangle."""

MOVES = 2
"""Moves a triangle and sweep."""

ROUNDS = 12
"""Rounds of remeshing before the annealing."""

STAGES = 10
"""The annealing halts so many times to relax everything, to renew energies and to steer."""

STEERED = 8
"""Stages after which the count is no longer steered."""

MOST_SHIFT = 0.1
"""Largest shift of the log of the wanted edge."""

SIZE_WEIGHT, MOST_SIZE_WEIGHT = 0.5, 3.0
"""Weight of sizes in the energy: default, and the most that a tolerance may raise it to."""

QUENCH = 5
"""Cold sweeps of an annealing that is stopped early."""

POWERS, POLISH = (1.0, 2.0, 4.0, 8.0), 15
"""Exponents of 1/q and sweeps at each in the polish."""


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
    log(edge / wanted) is asked to be at most log(size_tolerance). progress hears of the number of irregular
    vertices and the share of the work done. is_stopped is asked before every sweep; from a True on the mesh
    there is gets QUENCH cold sweeps and the polish, no more.
    """
    from .kernel.anneal import anneal
    from .kernel.coarsen import coarsen
    from .kernel.exchange import load, unload
    from .kernel.state import POWER, TEMPERATURE
    from .kernel.sweeps import relax_all, renew

    expected = n_blocks(domain, np.exp(log_size))
    state = load(domain, start, log_size, room=1.5, seed=seed)
    coarsen(state, ROUNDS)
    mesh = unload(state)
    n_sweeps, offset, weight = max(effort, 1), 0.0, SIZE_WEIGHT
    temperatures = HOT * (COLD / HOT) ** np.linspace(0.0, 1.0, n_sweeps)
    n_stages = min(STAGES, n_sweeps)
    for stage, part in enumerate(np.array_split(temperatures, n_stages)):
        state = load(domain, mesh, log_size, seed=seed + stage, size_weight=weight, offset=offset)
        for temperature in part:
            if is_stopped():
                break
            state.scalar[TEMPERATURE] = temperature
            anneal(state, MOVES * len(mesh.triangles))
        if is_stopped():
            state.scalar[TEMPERATURE] = COLD
            for _ in range(QUENCH):
                anneal(state, MOVES * len(mesh.triangles))
        relax_all(state, 2)
        mesh = unload(state)
        if stage < STEERED:
            shift = offset + 0.25 * np.log(len(mesh.triangles) / expected)
            offset = float(np.clip(shift, -MOST_SHIFT, MOST_SHIFT))
            if stage > 1:
                stray = size_rms(domain, mesh, log_size) / np.log(size_tolerance)
                weight = float(np.clip(weight * np.clip(stray, 0.7, 1.5), SIZE_WEIGHT, MOST_SIZE_WEIGHT))
        progress(f"{np.count_nonzero(mesh.is_irregular)} irregular vertices", (stage + 1) / n_stages)
        if is_stopped():
            break
    state = load(domain, mesh, log_size, seed=seed, size_weight=weight, offset=offset)
    for power in POWERS:
        state.scalar[POWER] = power
        renew(state)
        relax_all(state, POLISH)
    return unload(state)


def size_rms(domain: Domain, mesh: PlacedMesh, log_size: Floats) -> float:
    """Return the rms of log(edge / wanted edge) over the edges of a mesh."""
    from .kernel.walk import locate

    triangle, shares = locate(domain.points, domain.triangles, mesh.points, mesh.hints)
    density = np.exp(-(shares * log_size[domain.triangles[triangle, :3]]).sum(axis=1))
    ends = mesh.topology.edges
    length = np.linalg.norm(mesh.points[ends[:, 1]] - mesh.points[ends[:, 0]], axis=1)
    return float(np.sqrt((np.log(length * density[ends].mean(axis=1)) ** 2).mean()))
