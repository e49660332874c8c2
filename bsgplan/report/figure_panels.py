"""The panels of the figure of a plan, drawn into given axes: size field, regions with patterns, charge."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..arrays import Floats
from .figure_labels import anchors, place_labels
from .figure_scene import N_COLOURS, Scene

COLOURS = ("#8dd3c7", "#fdb462", "#bebada", "#b3de69", "#80b1d3", "#fccde5", "#ffed6f", "#e9a59b")
"""Fills of transition regions: pale, so that lines and letters stand out."""

GREYS = ("#ececec", "#dadada")
"""Fills of uniform zones."""

FONT = 7.0
"""Height of letters on the maps, points."""

MOST_VECTORS = 20_000
"""More line segments than this are stored as pixels."""

SEEN = 0.98
"""Share of the triangles whose charge density is inside the colour scale."""

Panel = Callable[[Any, Scene, Floats], Any]
"""Draws into axes a scene inside a box, and returns what the colour bar needs, or None."""


def draw_sizes(axes: Any, scene: Scene, box: Floats) -> Any:
    """Draw the size field, colours in log scale, with the block fronts as thin lines."""
    from matplotlib.colors import LogNorm

    low, high = float(scene.h.min()), float(scene.h.max())
    high = max(high, 1.05 * low)
    corners = scene.h[scene.view.mesh.triangles[scene.view.shown]]
    _paint(axes, scene, np.log(corners), "viridis", (float(np.log(low)), float(np.log(high))))
    draw_lines(axes, scene.fronts, box, color="white", linewidth=0.35, alpha=0.8)
    draw_lines(axes, scene.outline, box, color="black", linewidth=0.4)
    return _scale_of("viridis", LogNorm(low, high))


def draw_regions(axes: Any, scene: Scene, box: Floats) -> Any:
    """Draw the regions in colours that differ from their neighbours', with borders and block fronts."""
    from matplotlib.colors import ListedColormap

    fill = np.append(scene.colour, N_COLOURS + len(GREYS))  # label -1, outside, is white
    corners = np.repeat(fill[scene.plan.regions.label[scene.view.shown]], 3).reshape(-1, 3)
    colours = ListedColormap([*COLOURS, *GREYS, "white"])
    _paint(axes, scene, corners, colours, (-0.5, N_COLOURS + len(GREYS) + 0.5))
    draw_lines(axes, scene.fronts, box, color="#303030", linewidth=0.4)
    draw_lines(axes, scene.outline, box, color="black", linewidth=0.5)
    draw_lines(axes, scene.borders, box, color="black", linewidth=1.1)


def draw_charge(axes: Any, scene: Scene, box: Floats) -> Any:
    """Draw the irregularity budget: red where valence 7 is wanted, blue where valence 5; white is noise."""
    from matplotlib.colors import CenteredNorm

    weight = np.abs(scene.charge_density[scene.view.mesh.triangles].mean(axis=1))
    top = max(float(np.quantile(weight, SEEN)), 4 * scene.charge_noise)
    norm = CenteredNorm(0.0, top)
    colours = _white_middle("RdBu_r", scene.charge_noise / top)
    corners = scene.charge_density[scene.view.mesh.triangles[scene.view.shown]]
    _paint(axes, scene, corners, colours, (-top, top))
    draw_lines(axes, scene.outline, box, color="black", linewidth=0.5)
    draw_lines(axes, scene.borders, box, color="#606060", linewidth=0.4)
    return _scale_of(colours, norm)


def draw_labels(axes: Any, scene: Scene, box: Floats, inches: Floats, listed: list[int]) -> None:
    """Write the number of each listed region on it, with its pattern where there is room."""
    from matplotlib.patheffects import withStroke

    view, plan = scene.view, scene.plan
    per_unit = inches / (box[1] - box[0])
    spread = (box - box[0]) * per_unit
    border = np.concatenate([scene.borders, scene.outline]).reshape(-1, 2)
    border = (np.concatenate([border, _frame(box)]) - box[0]) * per_unit
    centres = view.place(view.mesh.centroids[view.shown])
    inside = ((centres > box[0]) & (centres < box[1])).all(axis=1)
    at, own = (centres[inside] - box[0]) * per_unit, plan.regions.label[view.shown][inside]
    spots, room = anchors(at, own, border, len(plan.region_plans))
    ids = [int(k) for k in np.argsort(-room, kind="stable") if k in set(listed)]
    long = [f"{k}{_mark(scene, k)}\n{pattern_text(scene, k, 16)}" for k in ids]
    short = [f"{k}{_mark(scene, k)}" for k in ids]
    for label in place_labels(long, short, spots[ids], room[ids], FONT / 72, spread):
        anchor, place = (tuple(np.array(p) / per_unit + box[0]) for p in (label.anchor, label.place))
        if np.hypot(*np.subtract(label.anchor, label.place)) > 0.01:
            axes.plot(*zip(anchor, place, strict=True), color="black", linewidth=0.5, zorder=4)
            axes.plot(*anchor, ".", color="black", markersize=2, zorder=4)
        axes.text(
            *place,
            label.text,
            fontsize=FONT,
            ha="center",
            va="center",
            color="#b00000" if "!" in label.text else "black",
            path_effects=[withStroke(linewidth=1.8, foreground="white")],
            zorder=5,
            clip_on=True,
            gid="region-label",
        )


def show_plain_numbers(axis: Any) -> None:
    """Write the ticks of a logarithmic axis as 0.02, 50 or 2000, at 1, 2 and 5 of each decade."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    low, high = axis.get_view_interval()
    steps = (1.0,) if high > 1000 * low else (1.0, 2.0, 5.0) if high > 5 * low else tuple(range(1, 10))
    axis.set_major_locator(LogLocator(subs=steps))
    axis.set_major_formatter(
        FuncFormatter(lambda value, _: f"{value:.3g}" if value < 1000 else f"{value:.0f}")
    )
    axis.set_minor_formatter(NullFormatter())


def pattern_text(scene: Scene, region: int, width: int) -> str:
    """Return the pattern of a region in at most so many letters, its middle left out where it is long."""
    chosen = scene.plan.region_plans[region].chosen
    if chosen is None:
        return "uniform"
    text, counts = str(chosen.pattern), chosen.pattern.counts
    if len(text) <= width:
        return text
    head, tail = [str(counts[0])], [str(counts[-1])]
    for k in range(1, len(counts)):
        for part, value in ((head, counts[k]), (tail, counts[-1 - k])):
            if len(":".join(head + tail)) + len(str(value)) + 4 > width:
                return f"{':'.join(head)}:..:{':'.join(reversed(tail))}"
            part.append(str(value))
    return text


def _frame(box: Floats) -> Floats:
    share = np.linspace(0, 1, 200)[:, None]
    (x, y), (u, v) = box
    corners = np.array([[x, y], [u, y], [u, v], [x, v]])
    sides = zip(corners, np.roll(corners, -1, axis=0), strict=True)
    return np.concatenate([a + share * (b - a) for a, b in sides])


def _mark(scene: Scene, region: int) -> str:
    return "!" if scene.plan.region_plans[region].limited else ""


def _paint(axes: Any, scene: Scene, corners: Floats, colours: Any, limits: tuple[float, float]) -> None:
    """Fill the triangles that are seen, one value a corner, (n, 3), as pixels."""
    from matplotlib.collections import TriMesh
    from matplotlib.tri import Triangulation

    placed = scene.view.placed[scene.view.mesh.triangles[scene.view.shown]].reshape(-1, 2)
    grid = Triangulation(placed[:, 0], placed[:, 1], np.arange(len(placed)).reshape(-1, 3))
    mesh = TriMesh(grid, array=corners.ravel(), cmap=colours, rasterized=True, clim=limits)
    axes.add_collection(mesh, autolim=False)


def draw_lines(axes: Any, segments: Floats, box: Floats, **style: Any) -> None:
    """Draw the line segments, (n, 2, 2), that touch a box; as pixels where they are many."""
    from matplotlib.collections import LineCollection

    near = ((segments.max(axis=1) >= box[0]) & (segments.min(axis=1) <= box[1])).all(axis=1)
    is_many = np.count_nonzero(near) > MOST_VECTORS
    lines = LineCollection(segments[near], rasterized=bool(is_many), capstyle="round", **style)
    axes.add_collection(lines, autolim=False)


def _scale_of(colours: Any, norm: Any) -> Any:
    from matplotlib.cm import ScalarMappable

    return ScalarMappable(norm, colours)


def _white_middle(name: str, share: float) -> Any:
    """Return a diverging colour map that is white within this share of its middle."""
    from matplotlib import colormaps
    from matplotlib.colors import ListedColormap

    value = np.linspace(-1, 1, 512)
    beyond = np.sign(value) * np.clip((np.abs(value) - share) / (1 - share), 0, 1)
    rgba = colormaps[name]((beyond + 1) / 2)
    rgba[np.abs(value) <= share] = 1.0
    return ListedColormap(rgba)
