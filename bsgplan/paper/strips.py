"""Figures 2 and 3: transitions of two fronts, their irregular vertices, and their quality over the length."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..patterns import (
    Pattern,
    Shape,
    best_width,
    realise,
    relative_irregularity,
    strip_quality,
    vertex_irregularity_of_fronts,
)
from .curves import Curve, curve_sheet
from .item import Number, Section, items_of
from .printed import printed
from .sketch import pattern_sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PATTERNS = ("2:1", "3:1", "3:2", "4:1", "4:2", "4:3")
"""The strips of Figure 2, as its text tells them: (a) 2:1, (b) f1 raised, (c) f2 raised, .. (f) 4:3."""
CURVES = ("1:1", "2:1", "3:1", "4:1", "3:2", "4:3")
"""The strips of Figure 3."""
LONGEST = 2.0
"""Length to which the curves of Figure 3 run, in heights."""


def figure_2() -> Section:
    """Return the strips with their relative irregularity, counted vertex by vertex."""
    ours: dict[tuple[str, str], Number] = {}
    for text in PATTERNS:
        pattern = Pattern.parse(text)
        realised = realise(pattern, Shape.rectangle(1.0), np.array([0.0, 1.0]))
        fronts = vertex_irregularity_of_fronts(realised)
        ours[text, "triangles"] = len(realised.triangles)
        ours[text, "iota+"] = sum(front.positive for front in fronts)
        ours[text, "iota-"] = sum(front.negative for front in fronts)
        if text == PATTERNS[0]:
            values = relative_irregularity(realised)
            ours[text, "top left"] = int(values[pattern.counts[0]])
            ours[text, "top right"] = int(values[-1])

    def draw() -> Figure:
        return pattern_sheet(PATTERNS, lambda _: _UNIT, columns=6, height=1.7)

    text = (
        "Eq. 10 and 11, f1 + f2 triangles and irregularity +-(f1 - f2), relative to the unit square; ours is "
        "counted on the triangulation. All that is negative lies on the front with more elements."
    )
    return Section("figure_2", "Figure 2: two fronts", text, items_of("figure_2", ours), draw)


def figure_3() -> Section:
    """Return the best quality of strips and the width they have it at."""
    ours: dict[tuple[str, str], Number] = {}
    for row in dict.fromkeys(row for row, _ in printed("figure_3")):
        first, second = Pattern.parse(row).counts
        ours[row, "at width"], ours[row, "best q"] = best_width(first, second)
    text = (
        "q_min of a strip over its length, height 1, in closed form. The paper prints curves; the numbers "
        "are their peaks. 3:1 and 4:1 never exceed one half, as the paper says."
    )
    return Section("figure_3", "Figure 3: two fronts, stretched", text, items_of("figure_3", ours), _curves)


def _curves() -> Figure:
    lengths = np.linspace(0.01, LONGEST, 400)
    curves = []
    for text in CURVES:
        first, second = Pattern.parse(text).counts
        curves.append(Curve(text, np.array([strip_quality(first, second, float(w)) for w in lengths])))
    return curve_sheet(lengths, curves, longest=LONGEST, height=3.6)


_UNIT = np.array([0.0, 1.0])
