"""What every use of the kernels does with a state: give it credit, cool it and polish it sweep by sweep."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from ...arrays import Floats
from .anneal import anneal
from .state import CREDIT, N_FREE_TRIANGLES, N_TRIANGLES, POWER, TEMPERATURE, State
from .sweeps import relax_all, renew

OUTLIER = 100.0
"""Times the median energy that counts of a triangle in the mean."""

POWERS = (1.0, 2.0, 4.0, 8.0)
"""Exponents of 1/q in the polish, one after the other: the higher, the more the worst triangle counts."""


def falling(hot: float, cold: float, n: int) -> Floats:
    """Return n temperatures from hot to cold, each the same share of the one before.

    >>> falling(0.4, 0.1, 3).round(3).tolist()
    [0.4, 0.2, 0.1]
    """
    return np.asarray(hot * (cold / hot) ** np.linspace(0.0, 1.0, n))


def give_credit(state: State, share: float) -> None:
    """Credit each triangle of a state with a share of their mean energy, vertices' included.

    Every triangle costs something, so that without credit few large ones cost less than as many as wanted. Of
    one that costs OUTLIER times the median, folded over others in a fjord, no more than that counts.
    """
    state.scalar[CREDIT] = 0.0
    total = renew(state)
    rows = state.counter[N_TRIANGLES]
    costs = state.energy[:rows][state.triangle[:rows, 0] >= 0]
    beyond = np.maximum(costs - OUTLIER * np.median(costs), 0.0).sum()
    state.scalar[CREDIT] = share * (total - beyond) / len(costs)
    renew(state)


def n_triangles(state: State) -> int:
    """Return the number of triangles."""
    return int(state.counter[N_TRIANGLES] - state.counter[N_FREE_TRIANGLES])


def cool(
    state: State,
    temperatures: Iterable[float],
    n_moves: int,
    *,
    is_stopped: Callable[[], bool] = lambda: False,
) -> None:
    """Make n_moves moves at each temperature, until is_stopped gives True."""
    for temperature in temperatures:
        if is_stopped():
            break
        state.scalar[TEMPERATURE] = temperature
        anneal(state, n_moves)


def polish(state: State, n_sweeps: int, powers: Iterable[float] = POWERS) -> None:
    """Relax every vertex n_sweeps times at each of the powers, the topology as it is."""
    for power in powers:
        state.scalar[POWER] = power
        renew(state)
        relax_all(state, n_sweeps)
