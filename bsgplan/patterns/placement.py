"""Front positions where fronts differ in length: rounds of dynamic programming over a few offsets a front.

Each round tries nine positions for each front, within windows that keep the order of fronts, and finds the
choice that is best of all combinations: first the largest smallest quality, then, among those, the
largest sum over strips. Windows shrink from round to round. Deterministic; never worse than the start.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats
from .frustum import critical_triangles, mean_ratios
from .pattern import Pattern
from .shape import Shape

OFFSETS = np.linspace(-1, 1, 9)
"""Trial positions of a front, in windows; an odd number, so that one of them is to stay."""
WIDEST = 0.45
"""Half window of the first round as a share of the narrower neighbour strip; under half keeps the order."""
NARROWEST = 0.005
"""Half window below which rounds end: offsets of under a hundredth of a strip change no plan."""
GAIN = 0.005
"""A round that gains less than this share of q_min halves the window."""
ROUNDS = 24
"""Rounds at most, where gains are small but steady."""


def place(pattern: Pattern, shape: Shape, positions: Floats) -> Floats:
    """Return front positions with a larger smallest mean ratio, or the given ones, (n_fronts,), length."""
    window, reached = WIDEST, -np.inf
    for _ in range(ROUNDS):
        widths = np.diff(positions)
        reach = np.zeros(len(positions))
        reach[1:-1] = window * np.minimum(widths[:-1], widths[1:])
        trials = positions[:, None] + reach[:, None] * OFFSETS
        q, chosen = _best_path(_trial_qualities(pattern, shape, trials))
        positions = trials[np.arange(len(trials)), chosen]
        window, reached = (window if q - reached > GAIN * abs(q) else window / 2), q
        if window < NARROWEST:
            break
    positions[0], positions[-1] = 0.0, shape.length
    return positions


def _trial_qualities(pattern: Pattern, shape: Shape, trials: Floats) -> Floats:
    """Smallest mean ratio of each strip for each pair of trials, (n_layers, n_trials, n_trials)."""
    table, strip = critical_triangles(pattern)
    lengths = shape.front_lengths(trials)
    first, second = lengths[:-1, :, None][strip], lengths[1:, None, :][strip]
    width = (trials[1:, None, :] - trials[:-1, :, None])[strip]
    qualities = mean_ratios(table[:, :, None, None], first, second, width, is_closed=pattern.is_closed)
    starts = np.flatnonzero(np.diff(strip, prepend=-1))
    return np.minimum.reduceat(qualities, starts, axis=0)


def _best_path(qualities: Floats) -> tuple[float, list[int]]:
    """Largest minimum, and the trial of each front, (n_fronts,), on the path of largest sum that has it."""
    bottleneck = np.full(qualities.shape[1], np.inf)
    for strip in qualities:
        bottleneck = np.minimum(bottleneck[:, None], strip).max(axis=0)
    allowed: Bools = qualities >= bottleneck.max()
    gains = np.where(allowed, qualities, -np.inf)
    total, came_from = np.zeros(qualities.shape[1]), []
    for gain in gains:
        sums = total[:, None] + gain
        came_from.append(sums.argmax(axis=0))
        total = sums.max(axis=0)
    path = [int(total.argmax())]
    for before in reversed(came_from):
        path.append(int(before[path[-1]]))
    return float(bottleneck.max()), path[::-1]
