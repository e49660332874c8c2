"""What irregularity alone allows: upper bounds on quality from valences, Table 1 of the paper and beyond.

A vertex of valence v is best surrounded by v equal isosceles triangles of apex angle 2 pi / v
([Zint & Grosso], Table 1; its q of valence 8 is a slip: 0.947 rounds to 0.95).
A pattern gives the sum of irregularity of each front; spread over the front's vertices it gives valences.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, asin, atan2, ceil, floor, pi, sqrt

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Floats
from ..errors import InvalidOption
from .pattern import Pattern

REGULAR = 6
"""Valence of a regular interior vertex."""
FEWEST = 3
"""Smallest valence of an interior vertex."""
VALENCE_TOLERANCE = 1e-9
"""A real valence this close to an integer is that integer: far above rounding, far below a step."""


@dataclass(frozen=True)
class Bounds:
    """Upper bounds on the quality of a pattern in a region of straight, parallel fronts and walls.

    No triangulation of the pattern exceeds them there. A region whose walls converge takes up irregularity
    in its corners and may exceed them: 4:3:2:1 on a trapezoid with walls at 60 degrees is equilateral.
    """

    q_bound: float
    """Mean ratio, both signs of irregularity, each spread over the vertices of its front."""
    positive_spread: float
    """Mean ratio, positive irregularity only, spread: how the paper's Table 2 counts 7:5:3:1."""
    positive_concentrated: float
    """Mean ratio, positive irregularity only, on one vertex a front: how Table 2 counts 7:4:1."""
    angle_bound: float
    """Smallest angle, both signs, spread, radians."""
    edge_ratio_bound: float
    """Longest over shortest edge, both signs, spread; no triangulation goes below it."""


def bounds(pattern: Pattern) -> Bounds:
    """Return the bounds that a pattern's irregularity puts on its quality.

    >>> [round(bounds(Pattern.parse(p)).q_bound, 2) for p in ("7:5:3:1", "7:4:1")]
    [0.97, 0.95]
    """
    fronts = pattern.front_irregularity
    vertices = [count + (not pattern.is_closed) for count in pattern.counts]
    spread = [REGULAR + _away(i, n) for i, n in zip(fronts, vertices, strict=True)]
    positive = [valence for valence in spread if valence >= REGULAR]
    concentrated = [REGULAR + max(i, 0) for i in fronts]
    return Bounds(
        q_bound=float(fan_quality(spread).min()),
        positive_spread=float(fan_quality(positive or [REGULAR]).min()),
        positive_concentrated=float(fan_quality(concentrated).min()),
        angle_bound=float(fan_angle(spread).min()),
        edge_ratio_bound=float(fan_edge_ratio(spread).max()),
    )


def fan_quality(valence: ArrayLike) -> Floats:
    """Return the best smallest mean ratio around a vertex of each valence.

    q = sqrt(3) sin(a) / (2 - cos(a)), a = 2 pi / valence, [Zint & Grosso], Table 1.

    >>> fan_quality([5, 6, 7, 8]).round(2).tolist()
    [0.97, 1.0, 0.98, 0.95]
    """
    a = _apex_angle(valence)
    return np.asarray(np.sqrt(3) * np.sin(a) / (2 - np.cos(a)))


def fan_angle(valence: ArrayLike) -> Floats:
    """Return the best smallest angle around a vertex of each valence, radians, Table 1.

    >>> np.degrees(fan_angle([5, 9])).round().tolist()
    [54.0, 40.0]
    """
    a = _apex_angle(valence)
    return np.asarray(np.minimum(a, (np.pi - a) / 2))


def fan_edge_ratio(valence: ArrayLike) -> Floats:
    """Return the best longest over shortest edge around a vertex of each valence, Table 1.

    >>> fan_edge_ratio([4, 7]).round(2).tolist()
    [1.41, 1.15]
    """
    base = 2 * np.sin(_apex_angle(valence) / 2)
    return np.asarray(np.maximum(base, 1 / base))


def valences_of_quality(q: float) -> tuple[int, int]:
    """Return the smallest and the largest valence whose best mean ratio is at least q: Table 1 inverted.

    sqrt(3) sin(a) + q cos(a) >= 2 q holds for apex angles a in asin(2 q / r) - p to pi - asin(2 q / r) - p,
    r = sqrt(3 + q^2), p = atan2(q, sqrt(3)).

    >>> valences_of_quality(0.9), valences_of_quality(1.0)
    ((5, 9), (6, 6))
    """
    _check_share(q, "mean ratio")
    reach, shift = asin(min(1.0, 2 * q / sqrt(3 + q * q))), atan2(q, sqrt(3))
    return _integers_between(2 * pi / (pi - reach - shift), 2 * pi / (reach - shift))


def valences_of_angle(angle: float) -> tuple[int, int]:
    """Return the smallest and the largest valence whose best smallest angle, radians, is at least this.

    >>> valences_of_angle(np.radians(45))
    (4, 8)
    """
    _check_share(angle / (pi / 3), "smallest angle over 60 degrees")
    return _integers_between(2 * pi / (pi - 2 * angle), 2 * pi / angle)


def valences_of_edge_ratio(ratio: float) -> tuple[int, int]:
    """Return the smallest and the largest valence whose best edge ratio is at most this.

    >>> valences_of_edge_ratio(1.2)
    (5, 7)
    """
    if not ratio >= 1:
        raise InvalidOption(
            f"edge ratio {ratio} is below 1; the longest edge is never shorter than the shortest"
        )
    widest = 2 * asin(ratio / 2) if ratio < 2 else pi  # base over leg
    return _integers_between(2 * pi / widest, 2 * pi / acos(1 - 0.5 / ratio**2))


def _away(irregularity: int, n_vertices: int) -> int:
    """Irregularity of the worst vertex when a front spreads it evenly."""
    return int(np.sign(irregularity)) * -(-abs(irregularity) // n_vertices)


def _apex_angle(valence: ArrayLike) -> Floats:
    v = np.asarray(valence, dtype=np.float64)
    if v.size and not v.min() >= FEWEST:
        raise InvalidOption(
            f"valence {v.min():g} is below {FEWEST}; an interior vertex has at least {FEWEST} edges"
        )
    return np.asarray(2 * np.pi / v)


def _integers_between(low: float, high: float) -> tuple[int, int]:
    return max(FEWEST, ceil(low - VALENCE_TOLERANCE * low)), floor(high + VALENCE_TOLERANCE * high)


def _check_share(value: float, name: str) -> None:
    if not 0 < value <= 1 + VALENCE_TOLERANCE:
        raise InvalidOption(f"{name} {value} is not above 0 and at most 1; choose one in between")
