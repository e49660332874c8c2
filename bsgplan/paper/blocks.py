"""Table 2 and Figure 10: the paper's two patterns of blocks beside a better one; and every pattern named."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..mesh import Mesh
from ..patterns import (
    Pattern,
    Shape,
    best_length,
    best_spacing,
    bounds,
    move_vertices,
    paper_spacing,
    realise,
)
from ..patterns import vertex_irregularity_of_fronts as of_fronts
from .item import Number, Section, items_of
from .printed import printed
from .sketch import pattern_sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PATTERNS = ("7:5:3:1", "7:4:1", "7:4:2:1")
"""The paper's two, and the best that a search finds with as little positive irregularity as the second."""
TRIS_PER_BLOCK = 16
LENGTH = 0.7
"""About the length of the paper's region, in heights."""
SHORT = {
    "40:39:..:10": tuple(range(40, 9, -1)),
    "128:64:..:1": tuple(2**k for k in range(7, -1, -1)),
}
"""Patterns that are printed shortened."""


def table_2() -> Section:
    """Return blocks, triangles, bounds, irregularity and quality of the patterns for a transition of 7:1."""
    ours: dict[tuple[str, str], Number] = {}
    for text in PATTERNS:
        pattern = Pattern.parse(text)
        limits = bounds(pattern)
        shape = Shape.rectangle(LENGTH)
        fronts = of_fronts(realise(pattern, shape, best_spacing(pattern, shape).positions))
        ours["blocks", text] = pattern.n_blocks
        ours["triangles, 16 a block", text] = pattern.n_blocks * TRIS_PER_BLOCK
        ours["q under: positive, spread", text] = limits.positive_spread
        ours["q under: positive, concentrated", text] = limits.positive_concentrated
        ours["q under: both signs, spread", text] = limits.q_bound
        ours["iota+", text] = pattern.irregularity.positive
        ours["iota+, counted at vertices", text] = sum(front.positive for front in fronts)
    text = (
        "The paper's bounds count positive irregularity, once spread over the front and once on one vertex; "
        "both are shown, and with both signs, spread, the bound that no transition exceeds. iota+ sums over "
        "fronts (Eq. 20); a front may carry both signs, so vertices can have more. 7:4:2:1 is not in the "
        "paper. The column of the unstructured mesh is at Figure 9, what quality is reached at Figure 10."
    )
    return Section("table_2", "Table 2: blocks of a transition", text, items_of("table_2", ours))


def figure_10() -> Section:
    """Return the quality that those patterns reach: fronts straight, and vertices moved."""
    ours: dict[tuple[str, str], Number] = {}
    for text in PATTERNS:
        pattern = Pattern.parse(text)
        best = best_length(pattern)
        ours[text, "q_min at best length"] = best.q_min
        ours[text, "q_min at length 0.7"] = best_spacing(pattern, Shape.rectangle(LENGTH)).q_min
        ours[text, "vertices moved, length free"] = _moved(pattern, best.length)
    text = (
        "Both of the paper's patterns end in a 3:1 or 4:1 strip, which it advises against: one half is all "
        "that they reach with straight fronts. 7:4:2:1 (`bsgplan patterns 7:1`) has the iota+ of 7:4:1 in "
        "sum."
    )
    return Section("figure_10", "Figure 10: from 7 blocks to 1", text, items_of("figure_10", ours), _draw)


def patterns() -> Section:
    """Return blocks, irregularity and best quality of every pattern that the paper names, and some more."""
    ours: dict[tuple[str, str], Number] = {}
    for row, column in printed("patterns"):
        pattern = Pattern(SHORT[row]) if row in SHORT else Pattern.parse(row)
        ours[row, column] = _value(pattern, column)
    text = (
        "Blocks by Eq. 15, irregularity per front by Eq. 16, largest q_min over all lengths, fronts straight."
    )
    return Section("patterns", "Patterns", text, items_of("patterns", ours))


def _value(pattern: Pattern, column: str) -> Number:
    if column == "blocks":
        return pattern.n_blocks
    if column == "best q_min":
        return best_length(pattern).q_min
    if column == "iota+":
        return pattern.irregularity.positive
    if column == "iota-":
        return pattern.irregularity.negative
    shape = Shape.rectangle(1.0)
    fronts = of_fronts(realise(pattern, shape, paper_spacing(pattern, shape).positions))
    sums = [front.total for front in fronts]
    if sums != list(pattern.front_irregularity):
        return "the triangulation is not Eq. 16"
    if len(sums) > 10 and not any(sums[1:-1]):
        return f"{sums[0]:+d}, 0 x {len(sums) - 2}, {sums[-1]:+d}"
    return ", ".join(f"{i:+d}" if i else "0" for i in sums)


def _moved(pattern: Pattern, length: float) -> float:
    shape = Shape.rectangle(length)
    realised = realise(pattern, shape, best_spacing(pattern, shape).positions)
    moved = move_vertices(realised, slides=True, stretches=True)
    return float(np.min(Mesh(moved.points, moved.triangles).qualities))


def _draw() -> Figure:
    shape = Shape.rectangle(LENGTH)
    return pattern_sheet(
        PATTERNS,
        lambda p: best_spacing(p, shape).positions,
        title=lambda p: f"{p} ({p.n_blocks} blocks)",
        columns=3,
        height=2.8,
        has_quality=True,
    )
