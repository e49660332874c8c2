"""Good sequences of front counts where there are too many to try: dynamic programming with prices.

Many rewards are tried at once: a quality Q that every strip must be able to reach, a price of iota+ in
blocks, and a price of length in blocks a height. For each triple the sequence with the least

    blocks + price of iota+ * iota+ + price of length * sum lo(Q)    (price of length >= 0: short ones)
    blocks + price of iota+ * iota+ + price of length * sum hi(Q)    (price of length < 0: long ones)

follows from one programme over the pairs (count, last drop), strictly decreasing, for all triples together.
Where the largest widths fall short of the length, strips of equal fronts fill it up at an end, at no iota+.
Only sequences on the lower convex side of what can be had are found: the pruning.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from math import ceil

import numpy as np

from ..arrays import Floats, Ints
from .pattern import Counts
from .search_strips import Strips
from .straight import SLACK

QUALITIES = (0.0, 0.25, 0.4, 0.55, 0.65, 0.73, 0.79, 0.85, 0.9, 0.94, 0.98, 1.0)
"""Places of the tried Q between the least quality and the best that a strip has."""
TURN_PRICES = (0.0, 1.0, 3.0, 10.0, 30.0, 100.0, 400.0, 2000.0)
"""Blocks that one iota+ may cost."""
LENGTH_PRICES = (-0.8, -0.4, -0.2, -0.08, 0.0, 0.15, 0.5, 1.5, 4.0)
"""Prices of length, in units of the blocks of a square strip of the harmonic mean count."""
MOST_FILLED = 400
"""Strips of equal fronts added at an end, at most."""


def priced_sequences(strips: Strips, length: float | None, *, least_quality: float) -> list[Counts]:
    """Return distinct sequences, non-increasing, that are cheapest at some prices.

    >>> from .search_strips import strips_between
    >>> (28, 14, 7, 4) in priced_sequences(strips_between(28, 4), None, least_quality=0.3)
    True
    """
    found: dict[Counts, None] = {}
    for bargain in _bargains(strips, least_quality, is_free=length is None):
        found[bargain.counts] = None
        if length is not None:
            found.update(dict.fromkeys(_filled(bargain, length)))
    return list(found)


@dataclass(frozen=True)
class _Bargain:
    """A sequence that is cheapest at some prices, and the widths with its quality, in heights."""

    counts: Counts
    shortest: float
    """Sum of the smallest widths."""
    longest: float
    """Sum of the largest widths."""
    ends: tuple[tuple[float, float], ...]
    """Smallest and largest width of a strip of equal fronts at the coarse and at the fine end."""


@lru_cache(maxsize=1024)
def _bargains(strips: Strips, least_quality: float, *, is_free: bool) -> tuple[_Bargain, ...]:
    """Return the sequences that are cheapest at some prices, once for each quality tried.

    Prices of length do not depend on the length: many transitions between the same counts share this.
    """
    top = float(strips.caps.max())
    levels = [least_quality + (top - least_quality) * share for share in QUALITIES]
    levels = [min(q, top * (1 - SLACK)) for q in levels]
    unit = 4 * strips.fine * strips.coarse  # blocks a height of strips of 2 n blocks and 1 / (2 n) heights
    prices = (0.0,) if is_free else tuple(unit * p for p in LENGTH_PRICES)
    triples = np.array([*product(range(len(levels)), TURN_PRICES, prices)])
    low, high = (np.stack(part) for part in zip(*map(strips.intervals, levels), strict=True))
    paths = zip(_cheapest(strips, low, high, triples), triples[:, 0].astype(int).tolist(), strict=True)
    cheapest = dict.fromkeys((path, level) for path, level in paths if path is not None)
    return tuple(_bargain(path, low[level], high[level]) for path, level in cheapest)


def _bargain(path: Counts, low: Floats, high: Floats) -> _Bargain:
    first, second = np.array(path[:-1]), np.array(path[1:])
    ends = tuple((float(low[end, end]), float(high[end, end])) for end in (path[-1], path[0]))
    return _Bargain(path, float(low[first, second].sum()), float(high[first, second].sum()), ends)


def _cheapest(strips: Strips, low: Floats, high: Floats, triples: Floats) -> list[Counts | None]:
    """Return the sequence of least cost for each triple, None where no strips lead to the end."""
    fine, coarse = strips.fine, strips.coarse
    level, turn, price = triples[:, 0].astype(int), triples[:, 1], triples[:, 2]
    n, n_drops = len(triples), fine - coarse + 1
    drops = np.arange(n_drops)
    cost = np.full((fine + 1, n, n_drops), np.inf)  # least cost down to a count with a last drop
    cost[fine, :, 0] = 0.0
    rate = turn[:, None] * drops
    for count in range(fine, coarse, -1):
        here = cost[count]
        kept = np.minimum.accumulate(here[:, ::-1], axis=1)[:, ::-1]  # from drops no smaller
        risen = np.minimum.accumulate(here - rate, axis=1) + rate  # from smaller ones
        reach = slice(1, count - coarse + 1)
        below = count - drops[reach]
        wide = np.where(price[:, None] < 0, high[level, count][:, below], low[level, count][:, below])
        is_open = np.isfinite(wide)
        strip = np.where(is_open, count + below + price[:, None] * np.where(is_open, wide, 0.0), np.inf)
        total = np.minimum(kept, risen)[:, reach] + strip
        cost[below, :, drops[reach]] = total.T
    return _walk(cost, fine, coarse, rate)


def _walk(cost: Floats, fine: int, coarse: int, rate: Floats) -> list[Counts | None]:
    """Follow the least cost back from the coarse end, all triples together."""
    n = len(rate)
    every = np.arange(n)
    count = np.full(n, coarse)
    drop = cost[coarse].argmin(axis=1)
    is_found = np.isfinite(cost[coarse].min(axis=1))
    steps: list[Ints] = [count]
    while (count[is_found] < fine).any():
        is_under = is_found & (count < fine)
        count = np.where(is_under, count + drop, count)
        steps.append(count)
        rise = np.maximum(rate[every, drop][:, None] - rate, 0.0)
        before = (cost[count, every] + rise).argmin(axis=1)
        drop = np.where(is_under, before, drop)
    walked = np.stack(steps, axis=1)
    return [tuple(dict.fromkeys(walked[k, ::-1].tolist())) if is_found[k] else None for k in range(n)]


def _filled(bargain: _Bargain, length: float) -> list[Counts]:
    """Return the sequence filled up at either end where its largest widths are too short."""
    found, path = [], bargain.counts
    for end, (narrow, wide) in zip((path[-1], path[0]), bargain.ends, strict=True):
        if bargain.longest < length and wide > 0:
            r = ceil((length - bargain.longest) / wide * (1 - SLACK))
            if r <= MOST_FILLED and bargain.shortest + r * narrow <= length * (1 + SLACK):
                more = (end,) * r
                found.append(path + more if end == path[-1] else more + path)
    return found
