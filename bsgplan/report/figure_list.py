"""The list under the figure of a plan: what each numbered region becomes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..planning import Plan
from .figure_panels import COLOURS, GREYS, pattern_text
from .figure_scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_LISTED = 36
"""Regions told one by one; where there are more, the smallest are told together."""

FONT = 7.0
"""Height of letters, points."""

LINE = 0.15
"""Height of a line, inches."""

COLUMN = 4.1
"""Width of a column, inches."""

PATTERN = 34
"""Letters for a pattern."""


def listed_regions(plan: Plan) -> list[int]:
    """Return the regions told one by one, by number: all, or the largest."""
    n = len(plan.region_plans)
    if n <= MOST_LISTED:
        return list(range(n))
    order = sorted(range(n), key=lambda k: (-plan.regions[k].n_triangles, k))
    return sorted(order[: MOST_LISTED - 1])


def list_height(plan: Plan, width: float) -> float:
    """Return the height of the list under a figure of this width, inches."""
    return LINE * (_n_lines(plan, width) + 3) + 0.15


def draw_list(drawn: Figure, scene: Scene, listed: list[int], height: float) -> None:
    """Write the list at the foot of a figure, in columns, each region with its colour."""
    from matplotlib.patches import Rectangle

    plan, width = scene.plan, drawn.get_figwidth()
    axes = drawn.add_axes((0.0, 0.0, 1.0, height / drawn.get_figheight()))
    axes.set_xlim(0, width)
    axes.set_ylim(0, height)
    axes.axis("off")
    lines = [_line(scene, k) for k in listed] + _rest(plan, listed)
    n_lines, top = _n_lines(plan, width), height - 0.15
    fills = [*COLOURS, *GREYS]
    style: dict[str, Any] = {"fontsize": FONT, "family": "monospace", "va": "center"}
    for column in range(-(-len(lines) // n_lines)):
        x = 0.4 + column * COLUMN
        axes.text(x + 0.15, top, f"{'id':>4} {'pattern':<{PATTERN}} {'blocks':>6} {'q_min':>5}", **style)
        for row, text in enumerate(lines[column * n_lines : (column + 1) * n_lines]):
            y, place = top - (row + 1) * LINE, column * n_lines + row
            if place < len(listed):
                fill = fills[scene.colour[listed[place]]]
                axes.add_patch(Rectangle((x, y - 0.05), 0.12, 0.1, facecolor=fill, edgecolor="black", lw=0.4))
            axes.text(x + 0.15, y, text, color="#b00000" if "!" in text else "black", **style)
    if any(p.limited for p in plan.region_plans):
        note = "! the region cannot carry blocks of this size"
        axes.text(0.55, top - (n_lines + 1) * LINE, note, color="#b00000", **style)


def _n_lines(plan: Plan, width: float) -> int:
    n_columns = max(1, int((width - 0.4) / COLUMN))
    return max(1, int(np.ceil(min(len(plan.region_plans), MOST_LISTED) / n_columns)))


def _line(scene: Scene, k: int) -> str:
    region_plan = scene.plan.region_plans[k]
    quality = f"{region_plan.chosen.q_min:.2f}" if region_plan.chosen else "-"
    mark = "!" if region_plan.limited else " "
    return f"{k:>3}{mark} {pattern_text(scene, k, PATTERN):<{PATTERN}} {region_plan.n_blocks:>6} {quality:>5}"


def _rest(plan: Plan, listed: list[int]) -> list[str]:
    rest = [p for k, p in enumerate(plan.region_plans) if k not in set(listed)]
    if not rest:
        return []
    text = f"{len(rest)} smaller regions"
    return [f"{'':>4} {text:<{PATTERN}} {sum(p.n_blocks for p in rest):>6}"]
