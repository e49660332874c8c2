"""Random numbers of a state: splitmix64, so that a seed gives the same layout on every machine."""

from __future__ import annotations

import numpy as np

from ...compiled import inner
from .state import State


@inner
def uniform(state: State) -> float:
    """Return a number in [0, 1)."""
    seed = state.seed
    seed[0] = seed[0] + np.uint64(0x9E3779B97F4A7C15)
    z = seed[0]
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    z = z ^ (z >> np.uint64(31))
    return float(z >> np.uint64(11)) * (1.0 / 9007199254740992.0)


@inner
def below(state: State, n: int) -> int:
    """Return a whole number in 0 .. n - 1."""
    return int(uniform(state) * n)
