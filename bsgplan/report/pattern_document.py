"""The document of one pattern: its counts, bounds and irregularity, and its quality over lengths.

Lengths are in heights (circumferences of rings): the fronts have length 1. Rings run around a cylinder, their
edges are chords.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Floats
from ..errors import InvalidOption
from ..mesh import Mesh
from ..patterns import (
    Pattern,
    Realised,
    Shape,
    best_length,
    best_spacing,
    bounds,
    move_vertices,
    realise,
    vertex_irregularity_of_fronts,
)

PATTERN_SCHEMA = "bsgplan.pattern/1"

MOST_TRIANGLES = 2_000_000
"""Triangles of a pattern after refinement, at most: what a figure or a file can show."""
MOST_MOVED = 2000
"""Blocks of a pattern whose vertices are moved, at most: a few seconds."""


def pattern_document(pattern: Pattern, *, length: float | None = None, refine: int = 2) -> dict[str, Any]:
    """Return the document `bsgplan.pattern/1`; what stands for a number that does not apply is None.

    Raises InvalidOption as `check_pattern`.
    """
    check_pattern(pattern, length, refine)
    best, limits, total = best_length(pattern), bounds(pattern), pattern.irregularity
    shape = straight_shape(pattern, best.length)
    realised = realise(pattern, shape, best_spacing(pattern, shape).positions)
    counted = vertex_irregularity_of_fronts(realised)
    return {
        "schema": PATTERN_SCHEMA,
        "pattern": str(pattern),
        "counts": list(pattern.counts),
        "is_closed": pattern.is_closed,
        "n_blocks": pattern.n_blocks,
        "refine": refine,
        "tris_per_block": 4**refine,
        "n_triangles": pattern.n_blocks * 4**refine,
        "irregularity": {"positive": total.positive, "negative": total.negative},
        "irregularity_of_vertices": {
            "positive": sum(front.positive for front in counted),
            "negative": sum(front.negative for front in counted),
        },
        "fronts": [
            {"count": n, "irregularity": i, "positive": c.positive, "negative": c.negative}
            for n, i, c in zip(pattern.counts, pattern.front_irregularity, counted, strict=True)
        ],
        "bounds": {
            "q_bound": limits.q_bound,
            "positive_spread": limits.positive_spread,
            "positive_concentrated": limits.positive_concentrated,
            "angle": float(np.degrees(limits.angle_bound)),
            "edge_ratio": limits.edge_ratio_bound,
        },
        "best": {
            **_at_length(pattern, best.length),
            "shortest": best.shortest,
            "longest": best.longest,
        },
        "asked": None if length is None else _at_length(pattern, length),
    }


def straight_shape(pattern: Pattern, length: float) -> Shape:
    """Return the region of a straight pattern, fronts of length 1.

    >>> straight_shape(Pattern.parse("7:4:1"), 0.7).length
    0.7
    """
    return Shape(np.array([0.0, length]), np.ones(2), pattern.is_closed)


def check_pattern(pattern: Pattern, length: float | None, refine: int) -> None:
    """Raise InvalidOption for a length or a number of refinements out of range, or too many triangles."""
    if length is not None and not 0 < length < float("inf"):
        raise InvalidOption(f"length {length:g} is not above 0; give it in heights, for example 0.7")
    if not 0 <= refine <= 10:
        raise InvalidOption(f"{refine} refinements is not from 0 to 10; give for example 2")
    n_triangles = pattern.n_blocks * 4**refine
    if n_triangles > MOST_TRIANGLES:
        raise InvalidOption(f"pattern has {n_triangles} triangles, the most is {MOST_TRIANGLES}; refine less")


def moved_pattern(realised: Realised, *, slides: bool = True, stretches: bool = False) -> Realised | None:
    """Return a straight pattern with its vertices moved; None for rings and for very many blocks."""
    if realised.is_closed or len(realised.triangles) > MOST_MOVED:
        return None
    return move_vertices(realised, slides=slides, stretches=stretches)


def _at_length(pattern: Pattern, length: float) -> dict[str, Any]:
    shape = straight_shape(pattern, length)
    spacing = best_spacing(pattern, shape)
    realised = realise(pattern, shape, spacing.positions)
    mesh = Mesh(realised.points, realised.triangles)
    fixed, sliding = (moved_pattern(realised, slides=slides) for slides in (False, True))
    free = moved_pattern(realised, stretches=True)
    return {
        "length": length,
        "positions": spacing.positions.tolist(),
        "q_min": spacing.q_min,
        "q_mean": float(mesh.qualities.mean()),
        "moved_walls_fixed": _worst(fixed),
        "moved_walls_sliding": _worst(sliding),
        "moved_length_free": _worst(free),
        "free_length": None if free is None else float(np.ptp(free.points[:, 0])),
    }


def _worst(realised: Realised | None) -> float | None:
    if realised is None:
        return None
    qualities: Floats = Mesh(realised.points, realised.triangles).qualities
    return float(qualities.min())
