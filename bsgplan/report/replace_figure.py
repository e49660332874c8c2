"""The figure of a replacement: the mesh before and after, irregular vertices inside red (+) and blue (-)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..mesh import Mesh
from ..remesh import Replacement
from ..words import counted
from .figure import DOTS
from .figure_view import GlobeMap, domain_box, view_of, zoom_box

if TYPE_CHECKING:
    from matplotlib.figure import Figure

RED, BLUE = "#d01c1c", "#1c50d0"
"""Colours of vertices with too many and with too few edges."""

WIDTH = 6.5
"""Width of a panel, inches."""

FINE = 0.03
"""Under this edge in inches a panel shows no edges but a fill, and a detail stands below it."""

DETAIL_EDGES = 40
"""Edges across the detail."""


def replace_figure(replacement: Replacement, *, projection: GlobeMap | None = None, name: str = "") -> Figure:
    """Return the figure of a replacement; with a projection it is drawn in degrees.

    What is outside a drawn region is left out but for a margin; a detail follows where edges are too fine.
    """
    from matplotlib.figure import Figure

    old = view_of(replacement.size.mesh, projection)
    boxes = [_with_margin(_box(replacement, old.placed, domain_box(old)))]
    ends = old.placed[old.mesh.topology.edges]
    edge = np.median(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))
    if edge * WIDTH / np.ptp(boxes[0][:, 0]) < FINE:
        boxes.append(_detail(replacement, old.placed, projection))
    stretch = [old.stretch(box) for box in boxes]
    heights = [WIDTH * np.ptp(b[:, 1]) * s / np.ptp(b[:, 0]) for b, s in zip(boxes, stretch, strict=True)]
    total = 2 * WIDTH + 1.2, sum(heights) + 0.75 * len(boxes) + 0.4
    drawn = Figure(figsize=total, dpi=DOTS)
    drawn.suptitle(name, fontsize=11, y=1 - 0.1 / total[1], va="top")
    top = 0.4
    for row, (box, height) in enumerate(zip(boxes, heights, strict=True)):
        sides = (replacement.size.mesh, replacement.label), (replacement.mesh, replacement.new_label)
        for column, (mesh, label) in enumerate(sides):
            left = 0.55 + column * (WIDTH + 0.1)
            bottom = total[1] - top - 0.3 - height
            axes = drawn.add_axes((left / total[0], bottom / total[1], WIDTH / total[0], height / total[1]))
            view = view_of(mesh, projection)
            _draw(axes, mesh, view.placed, box, is_fine=len(boxes) == 2 and row == 0)
            axes.set_aspect(stretch[row])
            axes.set_xlim(*box[:, 0])
            axes.set_ylim(*box[:, 1])
            axes.tick_params(labelsize=7)
            if column:
                axes.set_yticklabels([])
            if row == 0 and len(boxes) == 2:
                axes.add_patch(_frame(boxes[1]))
            axes.set_title(
                _heading(mesh, label >= 0, view.placed, box, ("before", "after")[column]), fontsize=8
            )
        top += 0.75 + height
    return drawn


def _draw(axes: Any, mesh: Mesh, at: Floats, box: Floats, *, is_fine: bool) -> None:
    from matplotlib.collections import LineCollection, PolyCollection

    edges = mesh.topology.edges
    is_rim = mesh.topology.is_boundary_edge
    seen = ((at >= box[0]) & (at <= box[1])).all(axis=1)
    near = seen[edges].any(axis=1)
    if is_fine:
        corners = list(at[mesh.triangles])
        axes.add_collection(PolyCollection(corners, facecolors="#ecf2f7", edgecolors="none", rasterized=True))
    else:
        shown = near & ~is_rim
        many = np.count_nonzero(shown) > 20_000
        axes.add_collection(
            LineCollection(list(at[edges[shown]]), colors="#909090", linewidths=0.4, rasterized=many)
        )
    axes.add_collection(LineCollection(list(at[edges[near & is_rim]]), colors="black", linewidths=0.8))
    off = _off(mesh)
    for sign, colour in ((1, RED), (-1, BLUE)):
        here = seen & (np.sign(off) == sign)
        axes.plot(*at[here].T, "o", color=colour, markersize=1.6 if is_fine else 4.0, markeredgewidth=0)


def _heading(mesh: Mesh, inside: Bools, at: Floats, box: Floats, when: str) -> str:
    """Return what is seen of the part that was tried, in numbers."""
    seen = ((at >= box[0]) & (at <= box[1])).all(axis=1)
    shown = inside & seen[mesh.triangles].all(axis=1)
    corners = np.unique(mesh.triangles[shown])
    q = float(mesh.qualities[shown].min()) if shown.any() else float("nan")
    off = counted(int(_off(mesh)[corners].astype(bool).sum()), "irregular vertex", "irregular vertices")
    return f"{when}: {counted(int(shown.sum()), 'triangle')}, {off} inside, q_min {q:.2f}"


def _off(mesh: Mesh) -> Ints:
    return np.where(mesh.topology.is_boundary, 0, mesh.vertex_irregularity)


def _box(replacement: Replacement, at: Floats, whole: Floats) -> Floats:
    inside = replacement.label >= 0
    if inside.all():
        return whole
    corners = at[replacement.size.mesh.triangles[inside]].reshape(-1, 2)
    return np.array([corners.min(axis=0), corners.max(axis=0)])


def _with_margin(box: Floats) -> Floats:
    margin = 0.04 * np.ptp(box, axis=0).max()
    return np.array([box[0] - margin, box[1] + margin])


def _detail(replacement: Replacement, at: Floats, projection: GlobeMap | None) -> Floats:
    """Return a box about the finest part, some DETAIL_EDGES wide."""
    mesh = replacement.size.mesh
    zoom = zoom_box(view_of(mesh, projection), replacement.size)
    middle = at[mesh.triangles[np.argmin(replacement.size.triangle_h)]].mean(axis=0)
    if zoom is not None:
        middle = zoom.mean(axis=0)
    tree = np.argsort(np.linalg.norm(at - middle, axis=1))[: DETAIL_EDGES**2]
    low, high = np.quantile(at[tree], 0.02, axis=0), np.quantile(at[tree], 0.98, axis=0)
    reach = np.array([0.5, 0.3]) * (high - low).min()
    centre = (low + high) / 2
    return np.array([centre - reach, centre + reach])


def _frame(box: Floats) -> Any:
    from matplotlib.patches import Rectangle

    return Rectangle(tuple(box[0]), *np.ptp(box, axis=0), fill=False, edgecolor="black", linewidth=0.8)
