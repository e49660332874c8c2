"""Table 1: what a valence allows, and the estimates of Section 4."""

from __future__ import annotations

import numpy as np

from ..patterns import Pattern, fan_angle, fan_edge_ratio, fan_quality
from .item import Number, Section, items_of
from .printed import printed

TRIANGLES = 18578
"""Triangles of the paper's mesh."""


def table_1() -> Section:
    """Return the bounds on quality by valence."""
    ours: dict[tuple[str, str], Number] = {}
    for row in dict.fromkeys(row for row, _ in printed("table_1")):
        ours[row, "q"] = float(fan_quality(int(row)))
        ours[row, "angle"] = float(np.degrees(fan_angle(int(row))))
        ours[row, "edge ratio"] = float(fan_edge_ratio(int(row)))
    text = (
        "The best smallest mean ratio, smallest angle (degrees) and ratio of longest to shortest edge around "
        "a vertex, by its valence: equal isosceles triangles."
    )
    return Section("table_1", "Table 1: bounds by valence", text, items_of("table_1", ours))


def equation_24() -> Section:
    """Return the blocks of a mesh of 18578 triangles, and with a fourth of it refined."""
    refined = TRIANGLES * (1 - 0.25) + TRIANGLES * 0.25 * 4
    ours: dict[tuple[str, str], Number] = {
        ("18578 triangles, 16 a block", "paper"): TRIANGLES / 16,
        ("a fourth of them refined once", "paper"): refined,
        ("blocks then, 64 a block", "paper"): refined / 64,
    }
    text = "Blocks of a whole mesh from its triangles, Section 4. `bsgplan estimate` does better: by region."
    return Section("equation_24", "Eq. 24 and the last estimate", text, items_of("equation_24", ours))


def words() -> Section:
    """Return the statements of the paper that are the other way round, tried where they can be."""
    fronts = range(1, 10)
    triples = [(a, b, c) for a in fronts for b in fronts for c in fronts]
    is_more = all((_middle(a, b, c) >= 0) == (a + c >= 2 * b) for a, b, c in triples)
    is_less = all((_middle(a, b, c) >= 0) == (a + c <= 2 * b) for a, b, c in triples)
    by_counts, by_size = Pattern(tuple(range(40, 9, -1))), Pattern(tuple(2**k for k in range(7, -1, -1)))
    is_counts = not any(by_counts.front_irregularity[1:-1]) and any(by_size.front_irregularity[1:-1])
    ours: dict[tuple[str, str], Number] = {
        ("irregularity >= 0, if", "paper"): {
            (True, False): "f(k-1) + f(k+1) >= 2 f(k)",
            (False, True): "f(k-1) + f(k+1) <= 2 f(k)",
        }.get((is_more, is_less), "neither"),
        ("none inside, if linear", "paper"): "counts" if is_counts else "size",
    }
    text = "What the paper says in words or conditions and its own equations contradict."
    return Section("words", "Statements", text, items_of("words", ours))


def _middle(first: int, second: int, third: int) -> int:
    return Pattern((first, second, third)).front_irregularity[1]
