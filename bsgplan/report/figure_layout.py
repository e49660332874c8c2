"""Where the panels of a figure stand, in inches from its upper left corner."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats

LEFT, RIGHT, TOP, BOTTOM = 0.75, 0.85, 0.35, 0.5
"""Room around a panel for its axes, colour bar and heading, inches."""

HEAD = 0.35
"""Room for the title of the figure, inches."""

AREA = 60.0
"""Area of the map of regions, square inches: seven-point labels of 30 regions find room."""

WIDE = 2.0
"""A domain so many times wider than high has its panels below each other."""


@dataclass(frozen=True)
class Slot:
    """The frame of one panel, inches, y downwards."""

    x: float
    y: float
    width: float
    height: float


def arrangement(box: Floats, stretch: float, *, has_zoom: bool) -> list[Slot]:
    """Return the slots of regions, sizes and charge, and of their zooms after them.

    box is (2, 2) in plot units, stretch the drawn height of a unit over its drawn width. Regions stand large
    beside the two others; below each other in a wide domain; in a row above the zooms where there are some.
    """
    extent = np.ptp(box, axis=0)
    aspect = float(np.clip(extent[0] / (extent[1] * stretch), 0.25, 8.0))
    if has_zoom:
        edge = 5.0
        return [
            Slot(
                LEFT + k % 3 * (edge + LEFT + RIGHT), HEAD + TOP + k // 3 * (edge + TOP + BOTTOM), edge, edge
            )
            for k in range(6)
        ]
    if aspect > WIDE:
        width, height = 11.0, 11.0 / aspect
        return [Slot(LEFT, HEAD + TOP + k * (height + TOP + BOTTOM), width, height) for k in range(3)]
    width, height = float(np.sqrt(AREA * aspect)), float(np.sqrt(AREA / aspect))
    small = (height - TOP - BOTTOM) / 2
    x = LEFT + width + 0.2 + LEFT
    second = HEAD + TOP + small + TOP + BOTTOM
    return [
        Slot(LEFT, HEAD + TOP, width, height),
        Slot(x, HEAD + TOP, small * aspect, small),
        Slot(x, second, small * aspect, small),
    ]
