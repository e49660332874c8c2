"""From the input's own triangulation to a block layout: remesh down, anneal the topology, polish.

Deterministic: the same seed gives the same layout.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..arrays import Floats
from .domain import Domain
from .placed import PlacedMesh

HOT, COLD = 0.35, 0.03
"""First and last temperature, in units of the energy of one triangle of quality 1/2."""

ROUNDS = 12
"""Rounds of remeshing before the annealing."""

STAGES = 10
"""The annealing halts so many times to relax everything and to renew energies."""

POWERS, POLISH = (1.0, 2.0, 4.0, 8.0), 15
"""Exponents of 1/q and sweeps at each in the polish."""


def annealed(
    domain: Domain,
    start: PlacedMesh,
    log_size: Floats,
    *,
    effort: int,
    seed: int,
    progress: Callable[[str, float], None] = lambda _, __: None,
) -> PlacedMesh:
    """Return a layout of the domain with few irregular vertices whose edges follow exp(log_size).

    log_size is given at the domain's points, in its own unit. progress hears of the number of irregular
    vertices and the share of the work done.
    """
    from .kernel.anneal import anneal
    from .kernel.coarsen import coarsen
    from .kernel.exchange import load, unload
    from .kernel.state import POWER, TEMPERATURE
    from .kernel.sweeps import relax_all, renew

    state = load(domain, start, log_size, room=1.5, seed=seed)
    coarsen(state, ROUNDS)
    mesh = unload(state)
    n_sweeps = max(effort, 1)
    temperatures = HOT * (COLD / HOT) ** np.linspace(0.0, 1.0, n_sweeps)
    for stage, part in enumerate(np.array_split(temperatures, min(STAGES, n_sweeps))):
        state = load(domain, mesh, log_size, seed=seed + stage)
        for temperature in part:
            state.scalar[TEMPERATURE] = temperature
            anneal(state, len(mesh.triangles))
        relax_all(state, 2)
        mesh = unload(state)
        progress(f"{np.count_nonzero(mesh.is_irregular)} irregular vertices", (stage + 1) / STAGES)
    state = load(domain, mesh, log_size, seed=seed)
    for power in POWERS:
        state.scalar[POWER] = power
        renew(state)
        relax_all(state, POLISH)
    return unload(state)
