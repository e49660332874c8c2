"""Figures 4 and 5: fronts between 4 and 1 elements, their irregularity, and their quality over the length."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..patterns import Pattern, Shape, best_length, best_spacing, paper_spacing, realise
from ..patterns import vertex_irregularity_of_fronts as of_fronts
from ..patterns.frustum import pattern_qualities
from .curves import Curve, curve_sheet
from .item import Number, Section, items_of
from .printed import printed
from .sketch import pattern_sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PATTERNS = ("4:3:2:1", "4:3:1", "4:2:1")
"""The patterns of Figure 4."""
LONGEST = 3.0
"""Length to which the curves of Figure 5 run, in heights."""


def figure_4() -> Section:
    """Return the patterns from 4 to 1 with their irregularity per front."""
    ours: dict[tuple[str, str], Number] = {}
    for text in ("4:1", *PATTERNS):
        pattern = Pattern.parse(text)
        shape = Shape.rectangle(1.0)
        realised = realise(pattern, shape, paper_spacing(pattern, shape).positions)
        sums = [front.total for front in of_fronts(realised)]
        ours[text, "triangles"] = len(realised.triangles)
        ours[text, "per front"] = ", ".join(f"{i:+d}" if i else "0" for i in sums)
        ours[text, "iota+"] = sum(i for i in sums if i > 0)
        ours[text, "iota-"] = sum(i for i in sums if i < 0)

    def draw() -> Figure:
        return pattern_sheet(
            PATTERNS,
            lambda p: paper_spacing(p, Shape.rectangle(1.0)).positions,
            columns=3,
            height=2.2,
            has_quality=True,
        )

    text = (
        "Layers as wide as the edges of their coarser front, length 1. Irregularity is relative to the unit "
        "square, summed over each front of the triangulation: it is what Eq. 16 gives."
    )
    return Section("figure_4", "Figure 4: from 4 elements to 1", text, items_of("figure_4", ours), draw)


def figure_5() -> Section:
    """Return q_min over the length with the fronts at their best positions."""
    ours: dict[tuple[str, str], Number] = {}
    for row, column in printed("figure_5"):
        pattern = Pattern.parse(row)
        if column == "best length":
            ours[row, column] = best_length(pattern).length
        else:
            ours[row, column] = best_spacing(pattern, Shape.rectangle(float(column))).q_min
    text = (
        "q_min over the length in heights. The paper prints curves of meshes that are stretched (dashed); "
        "the numbers, and the full lines, are with the fronts at their best positions. 4:2:1 for the short "
        "transition, 4:3:2:1 for the long one."
    )
    return Section("figure_5", "Figure 5: from 4 to 1, stretched", text, items_of("figure_5", ours), _curves)


def _curves() -> Figure:
    lengths = np.linspace(0.02, LONGEST, 150)
    curves = []
    for text in ("4:1", *PATTERNS):
        pattern = Pattern.parse(text)
        unit = paper_spacing(pattern, Shape.rectangle(1.0)).positions
        shapes = [Shape.rectangle(float(x)) for x in lengths]
        best = [best_spacing(pattern, shape).q_min for shape in shapes]
        stretched = [pattern_qualities(pattern, shape, unit * shape.length).min() for shape in shapes]
        curves.append(Curve(text, np.array(best), np.array(stretched)))
    return curve_sheet(lengths, curves, longest=LONGEST, height=3.8)
