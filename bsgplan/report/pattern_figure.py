"""The figure of a pattern: its blocks at the best front positions, and with their vertices moved.

Fronts run from bottom to top, the first on the left; rings are unrolled. Irregular vertices are red with
their surplus, blue with what they lack, as in the figures of [Zint & Grosso]; fills tell the mean ratio.
Produces a matplotlib Figure without a window (no pyplot).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import Floats, Ints
from ..mesh import Mesh
from ..patterns import Pattern, Realised, best_length, best_spacing, realise, relative_irregularity, subdivide
from ..patterns.frustum import pattern_qualities
from ..patterns.strip import ring_turn
from ..words import counted
from .pattern_document import moved_pattern, straight_shape

if TYPE_CHECKING:
    from matplotlib.figure import Figure

RED, BLUE = "#c8102e", "#1f4fbf"
"""Irregular vertices of positive and of negative irregularity."""
HEIGHT = 4.2
"""Height of a panel, inches."""
WIDEST = 12.0
"""Width of a panel, inches, beyond which it is drawn lower."""
NUMBERED = 60
"""Irregular vertices that still carry their numbers."""
WORST, BEST = 0.3, 1.0
"""Ends of the colour scale of the mean ratio."""


def pattern_figure(pattern: Pattern, *, length: float | None = None, refine: int = 0) -> Figure:
    """Return the figure of a pattern over a length, in heights, None for its best one.

    Each block is drawn with its children after so many refinements.
    """
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

    length = best_length(pattern).length if length is None else length
    shape = straight_shape(pattern, length)
    spacing = best_spacing(pattern, shape)
    realised = realise(pattern, shape, spacing.positions)
    moved = moved_pattern(realised)
    qualities = pattern_qualities(pattern, shape, spacing.positions)
    irregular = relative_irregularity(realised)
    flat, owner = _unrolled(pattern, realised, spacing.positions) if pattern.is_closed else (realised, None)
    panels = [("fronts at their best positions", flat, qualities)]
    if moved is not None:
        q = Mesh(moved.points, moved.triangles).qualities
        panels.append(("vertices moved, on walls along them", moved, q))
    high = HEIGHT if length <= WIDEST / HEIGHT else max(WIDEST / length, 0.8)
    wide = max(1.6, high * length)
    total = len(panels) * (wide + 0.35) + 1.25, high + 1.15
    drawn = Figure(figsize=total, dpi=150)
    shown = irregular if owner is None else np.where(owner >= 0, irregular[owner], 0)
    drawn.suptitle(_title(pattern, length), fontsize=10, y=1 - 0.12 / total[1], va="top")
    for k, (heading, blocks, q) in enumerate(panels):
        left = 0.3 + k * (wide + 0.35)
        axes = drawn.add_axes((left / total[0], 0.25 / total[1], wide / total[0], high / total[1]))
        _draw(axes, blocks, q, shown, refine, high / max(pattern.counts))
        axes.set_title(f"{heading}\nq_min {q.min():.3f}, mean {q.mean():.3f}", fontsize=8)
    bar = drawn.add_axes(((total[0] - 0.75) / total[0], 0.25 / total[1], 0.12 / total[0], high / total[1]))
    drawn.colorbar(ScalarMappable(Normalize(WORST, BEST), _colours()), cax=bar)
    bar.tick_params(labelsize=7)
    bar.set_ylabel("mean ratio", fontsize=7, labelpad=2)
    return drawn


def _draw(
    axes: Any, realised: Realised, qualities: Floats, irregular: Ints, refine: int, edge: float
) -> None:
    """Draw blocks, children, fronts and irregular vertices; edge is the finest one in inches."""
    from matplotlib.collections import LineCollection, PolyCollection

    points = realised.points
    corners: Any = points[realised.triangles]
    thin = float(np.clip(6 * edge, 0.25, 0.9))
    colours = _colours()((qualities - WORST) / (BEST - WORST))
    axes.add_collection(PolyCollection(corners, facecolors=colours, edgecolors="none"))
    if refine > 0 and edge * 72 / 2**refine > 1.5:  # smaller children would be a grey
        fine, children, _ = subdivide(points, realised.triangles, 2**refine)
        smaller: Any = fine[children]
        axes.add_collection(PolyCollection(smaller, facecolors="none", edgecolors="#8a8a8a", linewidths=0.25))
    axes.add_collection(PolyCollection(corners, facecolors="none", edgecolors="#303030", linewidths=thin))
    ends = np.flatnonzero(np.diff(realised.front)) + 1
    axes.add_collection(
        LineCollection(np.split(points, ends), colors="black", linewidths=2.4 * thin, zorder=3, clip_on=False)
    )
    _mark(axes, points, irregular, float(np.clip(72 * edge * 0.32, 4.0, 11.0)))
    axes.set_xlim(points[:, 0].min(), points[:, 0].max())
    axes.set_ylim(points[:, 1].min(), points[:, 1].max())
    axes.set_aspect("equal")
    axes.axis("off")


def _mark(axes: Any, points: Floats, irregular: Ints, size: float) -> None:
    """Draw irregular vertices as discs of this many points, with their numbers where there is room."""
    is_numbered = size >= 6 and np.count_nonzero(irregular) <= NUMBERED
    for sign, colour in ((1, RED), (-1, BLUE)):
        at = np.flatnonzero(sign * irregular > 0)
        style: dict[str, Any] = {"markeredgewidth": 0, "clip_on": False, "zorder": 4}
        axes.plot(*points[at].T, "o", color=colour, markersize=size, **style)
        if not is_numbered:
            style |= {"markeredgewidth": 0.12 * size, "zorder": 5}
            axes.plot(*points[at].T, "+" if sign > 0 else "_", color="white", markersize=0.6 * size, **style)
            continue
        for p in at:
            text = f"{irregular[p]:+d}".replace("-", "\N{MINUS SIGN}")
            middle = {"ha": "center", "va": "center_baseline"}
            axes.text(*points[p], text, fontsize=0.6 * size, color="white", zorder=5, **middle)


def _unrolled(pattern: Pattern, realised: Realised, positions: Floats) -> tuple[Realised, Ints]:
    """Return rings as straight fronts cut open, and the vertex that each new one was, -1 for copies."""
    counts = np.array(pattern.counts)
    turns = np.cumsum([0.0, *(float(ring_turn(m, n)) for m, n in pattern.strips)])
    first = np.concatenate([[0], np.cumsum(counts)])
    front = realised.front[realised.triangles]
    local = realised.triangles - first[front]
    y = local / counts[front] + turns[front]
    local = local + np.where(y.max(axis=1, keepdims=True) - y > 0.5, counts[front], 0)
    start = np.concatenate([[0], np.cumsum(2 * counts)])
    used, triangles = np.unique(start[front] + local, return_inverse=True)
    of = np.searchsorted(start, used, side="right") - 1
    own = used - start[of]
    points = np.column_stack([positions[of], own / counts[of] + turns[of]])
    flat = Realised(points, triangles.reshape(-1, 3), of, is_closed=True)
    was = first[of] + own % counts[of]
    is_first = np.zeros(len(was), dtype=bool)
    is_first[np.unique(was, return_index=True)[1]] = True
    return flat, np.where(is_first, was, -1)


def _title(pattern: Pattern, length: float) -> str:
    words, total = str(pattern), pattern.irregularity
    if len(words) > 30:
        words = f"{words[:22]}..{words[-6:]}"
    told = (
        f"{words}: {counted(pattern.n_blocks, 'block')}, iota+ {total.positive}, "
        f"iota\N{MINUS SIGN} {total.negative}, length {length:.3g}"
    )
    return told.replace(" -", " \N{MINUS SIGN}")


def _colours() -> Any:
    """Return the colour map of the mean ratio: yellow where poor, white where good."""
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("mean ratio", ["#e07b39", "#f6d58a", "#fbfaf3", "#d6ecd9"])
