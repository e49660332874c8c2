"""The length of a transition, in heights: from layers of elements, and where a pattern is best."""

from __future__ import annotations

from dataclasses import dataclass
from math import log, sqrt

import numpy as np

from ..errors import InvalidOption
from .pattern import Pattern
from .width import best_width, width_interval


@dataclass(frozen=True)
class BestLength:
    """The lengths at which a straight pattern is best."""

    length: float
    """Every strip at its own best width, in heights: front length is 1."""
    shortest: float
    """Shortest length with the same q_min, in heights."""
    longest: float
    """Longest length with the same q_min, in heights."""
    q_min: float
    """Mean ratio of the worst strip at its best width."""


def best_length(pattern: Pattern) -> BestLength:
    """Return the lengths at which a straight pattern has its largest smallest mean ratio.

    >>> best = best_length(Pattern.parse("7:4:2:1"))
    >>> round(best.q_min, 3), best.shortest < best.length < best.longest
    (0.756, True)
    """
    closed = pattern.is_closed
    widths, qualities = np.array([best_width(m, n, is_closed=closed) for m, n in pattern.strips]).T
    q = float(qualities.min())
    within = q * (1 - 1e-12)  # the worst strip keeps its one width despite rounding
    lows, highs = np.array([width_interval(m, n, within, is_closed=closed) for m, n in pattern.strips]).T
    return BestLength(float(widths.sum()), float(lows.sum()), float(highs.sum()), q)


def length_of_layers(fine: float, coarse: float, layers: float) -> float:
    """Return the length of a transition, in heights, from its elements on both ends and its layers.

    Equilateral elements, front counts linear in the layer, as in [Zint & Grosso], Sec. 2.2: a layer of n
    elements is sqrt(3) / 2 / n heights wide; the integral is sqrt(3) / 2 * layers / log mean of both counts.

    >>> round(length_of_layers(28, 4, 9.5), 3)
    0.667
    """
    if not (fine > 0 and coarse > 0 and 0 < layers < float("inf")):
        raise InvalidOption(f"{layers:g} layers from {fine:g} to {coarse:g} elements; give numbers above 0")
    mean = fine if fine == coarse else (fine - coarse) / log(fine / coarse)
    return sqrt(3) / 2 * layers / mean
