"""Figures of q_min over the length of a transition, one line a pattern."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..arrays import Floats

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS = ("#1b1b1b", "#1f4fbf", "#e07b39", "#c8102e", "#2e8b57", "#8a4fbf")
"""Of patterns, in order."""


@dataclass(frozen=True, eq=False)
class Curve:
    """The quality of a pattern over its length."""

    pattern: str
    q_min: Floats
    """At each length, (n,)."""
    stretched: Floats | None = None
    """Of the pattern of length 1, stretched, (n,): drawn with dashes."""


def curve_sheet(lengths: Floats, curves: Sequence[Curve], *, longest: float, height: float) -> Figure:
    """Return a figure of curves over lengths up to the longest, in heights; its height is in inches."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.0, height), dpi=150, layout="constrained")
    axes = figure.add_subplot()
    for curve, colour in zip(curves, COLOURS, strict=False):
        axes.plot(lengths, curve.q_min, color=colour, label=curve.pattern, linewidth=1.4)
        if curve.stretched is not None:
            axes.plot(lengths, curve.stretched, color=colour, linewidth=0.9, linestyle=(0, (4, 2)))
    axes.set(xlabel="length [heights]", ylabel="q_min", xlim=(0, longest), ylim=(0, 1))
    axes.grid(alpha=0.3)
    axes.legend(ncols=2, fontsize=8)
    return figure
