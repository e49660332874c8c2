"""The figure of a plan: size field, regions with patterns and fronts, irregularity budget, and a list.

Produces a matplotlib Figure without a window (no pyplot); triangles are pixels, lines and letters vectors.
Where the finest quarter of the triangles fills under a tenth of the domain, each panel has a zoom below it.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import Floats
from ..atomic import replacing
from ..errors import InvalidOption
from ..planning import Plan
from ..words import counted
from .figure_layout import BOTTOM, RIGHT, arrangement
from .figure_list import draw_list, list_height, listed_regions
from .figure_panels import FONT, Panel, draw_charge, draw_labels, draw_regions, draw_sizes, show_plain_numbers
from .figure_scene import Scene, scene_of
from .figure_view import GlobeMap, View, domain_box, filled, with_margin, zoom_box

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SUFFIXES = (".png", ".svg", ".pdf")
"""Formats of `save_figure`."""

DOTS = 150
"""Pixels an inch."""


def figure(plan: Plan, *, projection: GlobeMap | None = None, name: str = "") -> Figure:
    """Return the figure of a plan; with a projection it is drawn in degrees and sizes are true metres.

    name is the mesh's, for the title. A surface in space is drawn on its two largest principal axes.
    """
    from matplotlib.figure import Figure

    scene = scene_of(plan, projection)
    whole, zoom = with_margin(domain_box(scene.view)), zoom_box(scene.view, plan.regions.size)
    slots = arrangement(whole, scene.view.stretch(whole), has_zoom=zoom is not None)
    width, above = max(s.x + s.width for s in slots) + RIGHT, max(s.y + s.height for s in slots) + BOTTOM
    foot = list_height(plan, width)
    height = above + foot
    drawn = Figure(figsize=(width, height), dpi=DOTS)
    drawn.suptitle(_title(plan, name), fontsize=11, y=1 - 0.15 / height, va="top")
    listed = listed_regions(plan)
    for place, slot in enumerate(slots):
        panel, title = PANELS[place % 3]
        shape = np.array([slot.width, slot.height])
        box = filled(whole if zoom is None or place < 3 else zoom, shape, scene.view)
        bottom = height - slot.y - slot.height
        axes = drawn.add_axes((slot.x / width, bottom / height, slot.width / width, slot.height / height))
        heading = f"({'abcdef'[place]}) " + (title(scene) if place < 3 else f"zoom of ({'abc'[place % 3]})")
        _draw(drawn, axes, scene, panel, box, heading)
        if panel is draw_regions:
            draw_labels(axes, scene, box, shape, listed)
    draw_list(drawn, scene, listed, foot)
    return drawn


def save_figure(drawn: Figure, path: str | os.PathLike[str]) -> None:
    """Write a figure as png, svg or pdf, by the suffix; it appears whole or not at all.

    Raises InvalidOption for another suffix, OutputError where it cannot be written.
    """
    check_figure_suffix(path)
    target = Path(path)
    with replacing(target) as temporary:
        drawn.savefig(temporary, dpi=DOTS, bbox_inches="tight", pad_inches=0.1)


def check_figure_suffix(path: str | os.PathLike[str]) -> None:
    """Raise InvalidOption unless the suffix is that of a figure format."""
    suffix = Path(path).suffix
    if suffix.lower() not in SUFFIXES:
        raise InvalidOption(
            f"{os.fspath(path)}: suffix {suffix!r} is no figure format; write {', '.join(SUFFIXES)}"
        )


def size_title(_: Scene) -> str:
    """Return the heading of the size field."""
    return "size field with block fronts"


def regions_title(scene: Scene) -> str:
    """Return the heading of the regions."""
    n = len(scene.plan.region_plans)
    return f"{n} region{'s' if n > 1 else ''}: number, pattern, block fronts"


def charge_title(scene: Scene) -> str:
    """Return the heading of the charge."""
    return f"irregularity budget: interior {scene.plan.drivers.charge:+.1f} iota"


PANELS: tuple[tuple[Panel, Callable[[Scene], str]], ...] = (
    (draw_regions, regions_title),
    (draw_sizes, size_title),
    (draw_charge, charge_title),
)
"""What stands in the three places of a figure, and its heading."""


def prepare(axes: Any, view: View, box: Floats, heading: str) -> None:
    """Give axes their limits, labels, small ticks and heading."""
    axes.set_xlim(*box[:, 0])
    axes.set_ylim(*box[:, 1])
    axes.tick_params(labelsize=FONT)
    axes.ticklabel_format(style="sci", scilimits=(-3, 4), useMathText=True)
    for axis in (axes.xaxis, axes.yaxis):
        axis.get_offset_text().set_fontsize(FONT)
        axis.get_major_locator().set_params(nbins=6)
    across, up = view.axis_labels
    axes.set_xlabel(across, fontsize=FONT, labelpad=1)
    axes.set_ylabel(up, fontsize=FONT, labelpad=1)
    axes.set_title(heading, fontsize=FONT + 1.5, pad=5, loc="left")


def _title(plan: Plan, name: str) -> str:
    mesh = plan.regions.size.mesh
    parts = [name] if name else []
    parts.append(counted(mesh.n_triangles, "triangle"))
    parts.append(f"{counted(plan.n_blocks, 'block')} of {counted(plan.tris_per_block, 'triangle')}")
    if plan.q_min is not None:
        parts.append(f"q_min {plan.q_min:.2f}")
    return "  -  ".join(parts)


def _draw(drawn: Figure, axes: Any, scene: Scene, panel: Panel, box: Floats, heading: str) -> None:
    prepare(axes, scene.view, box, heading)
    scale = panel(axes, scene, box)
    if scale is None:
        return
    frame = axes.get_position()
    bar = drawn.add_axes((frame.x1 + 0.01 * frame.width, frame.y0, 0.12 / drawn.get_figwidth(), frame.height))
    drawn.colorbar(scale, cax=bar)
    if panel is draw_sizes:
        show_plain_numbers(bar.yaxis)
    bar.tick_params(labelsize=FONT, which="both")
    if panel is draw_charge:
        label = f"charge per block [iota], white is noise, under {scene.charge_noise:.1g}"
    else:
        label = f"size h [{scene.view.size_unit}]"
    bar.set_ylabel(label, fontsize=FONT, labelpad=1)
