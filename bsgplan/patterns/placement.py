"""Front positions where fronts differ in length: rounds of dynamic programming over a few offsets a front.

Each round tries nine positions for each inner front, within windows that keep the order of fronts, and finds
the choice that is best of all combinations: first the largest smallest quality, then, among those, the
largest sum over strips. Windows shrink from round to round. Deterministic; never worse than the start.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints
from .alike import Alike
from .frustum import gap_measures, gap_ratios

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

MOST_AT_ONCE = 16384
"""Trials measured at once: their arrays fit the cache of a processor core."""


def place(patterns: Alike, positions: Floats) -> Floats:
    """Return front positions with a larger smallest mean ratio, or the given ones, (n, n_fronts), length."""
    if patterns.n_layers == 1:
        return positions
    positions = positions.copy()
    window, reached = np.full(len(patterns), WIDEST), np.full(len(patterns), -np.inf)
    rows = np.arange(len(patterns))
    for _ in range(ROUNDS):
        widths = np.diff(positions[rows])
        reach = np.zeros(positions[rows].shape)
        reach[:, 1:-1] = window[rows, None] * np.minimum(widths[:, :-1], widths[:, 1:])
        trials = positions[rows][:, :, None] + reach[:, :, None] * OFFSETS
        q, chosen = _best_path(*_trial_qualities(patterns, rows, trials))
        positions[rows] = np.take_along_axis(trials, chosen[:, :, None], axis=2)[:, :, 0]
        is_gain = q - reached[rows] > GAIN * np.abs(q)
        window[rows] = np.where(is_gain, window[rows], window[rows] / 2)
        reached[rows] = q
        rows = rows[window[rows] >= NARROWEST]
        if not len(rows):
            break
    positions[:, 0], positions[:, -1] = 0.0, patterns.lengths
    return positions


def _trial_qualities(patterns: Alike, rows: Ints, trials: Floats) -> tuple[Floats, Floats]:
    """Return the smallest mean ratio of each strip of these patterns for each pair of trials.

    The first and the last strip have one front that stays, (n, 2, n_trials); those between have pairs,
    (n, n_layers - 2, n_trials, n_trials).
    """
    lengths = patterns.front_lengths(trials, rows)
    last = patterns.n_layers - 1
    ends, inner = np.array([0, last]), np.arange(1, last)
    at_ends = (lengths[:, ends], lengths[:, ends + 1], trials[:, ends + 1] - trials[:, ends])
    between = (
        lengths[:, 1:last, :, None],
        lengths[:, 2 : last + 1, None, :],
        trials[:, 2 : last + 1, None, :] - trials[:, 1:last, :, None],
    )
    return _smallest_ratios(patterns, rows, ends, *at_ends), _smallest_ratios(patterns, rows, inner, *between)


def _smallest_ratios(
    patterns: Alike, rows: Ints, layers: Ints, first: Floats, second: Floats, width: Floats
) -> Floats:
    """Return the smallest mean ratio in each of these layers of these patterns, shaped as width is."""
    if not width.size:
        return width
    row, layer, side = patterns.critical
    number = np.full((len(patterns), patterns.n_layers), -1)  # of the strip among those asked for
    number[rows[:, None], layers] = np.arange(len(rows) * len(layers)).reshape(len(rows), -1)
    strip = number[row, layer]
    asked = np.flatnonzero(strip >= 0)
    strip, side = strip[asked], side[asked]
    shares, turns = patterns.shares[asked, None], patterns.turns[asked, None]
    measures = gap_measures(first, second, width, is_closed=patterns.is_closed)
    measures = measures.reshape(3, 2, len(rows) * len(layers), -1)
    at_once = max(1, MOST_AT_ONCE // measures.shape[3])
    ratios = np.concatenate(
        [
            gap_ratios(shares[k], turns[k], *measures[:, side[k], strip[k]], is_closed=patterns.is_closed)
            for k in (slice(start, start + at_once) for start in range(0, len(asked), at_once))
        ]
    )
    return np.asarray(np.minimum.reduceat(ratios, np.flatnonzero(np.diff(strip, prepend=-1)))).reshape(
        width.shape
    )


def _best_path(ends: Floats, inner: Floats) -> tuple[Floats, Ints]:
    """Return the largest minimum, (n,), and the trials, (n, n_fronts), of the path of largest sum with it."""
    bottleneck = ends[:, 0]
    for k in range(inner.shape[1]):
        bottleneck = np.minimum(bottleneck[:, :, None], inner[:, k]).max(axis=1)
    best = np.minimum(bottleneck, ends[:, 1]).max(axis=1)
    ends = np.where(ends >= best[:, None, None], ends, -np.inf)
    inner = np.where(inner >= best[:, None, None, None], inner, -np.inf)
    total, came_from = ends[:, 0], []
    for k in range(inner.shape[1]):
        sums = total[:, :, None] + inner[:, k]
        came_from.append(sums.argmax(axis=1))
        total = sums.max(axis=1)
    here = (total + ends[:, 1]).argmax(axis=1)
    path, every = [np.zeros_like(here), here], np.arange(len(here))
    for before in reversed(came_from):
        here = before[every, here]
        path.append(here)
    return best, np.stack([*path, np.zeros_like(here)][::-1], axis=1)
