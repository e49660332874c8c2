"""The figure of a layout: blocks over the domain, irregular vertices red (+) and blue (-), and a detail.

The detail shows the grid of the blocks around the finest one. Fills are pixels, the rest vectors unless many.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import Floats, Ints
from ..blocks.layout import BlockGrid
from ..blocks.placed import PlacedMesh
from .figure import DOTS, prepare
from .figure_panels import FONT, draw_lines
from .figure_view import GlobeMap, View, domain_box, filled, view_of, with_margin

if TYPE_CHECKING:
    from matplotlib.figure import Figure

AREA, DETAIL = 50.0, 5.5
"""Area of the map of blocks, square inches; edge of the detail, inches."""

WIDE = 1.6
"""A domain so many times wider than high has its detail below it."""

SHOWN_BLOCKS = 60
"""Blocks of the detail."""

RED, BLUE = "#d01c1c", "#1c50d0"
"""Colours of vertices with too many and with too few edges."""

WATER = (0.925, 0.95, 0.97, 1.0)
"""Fill of the domain."""

LEFT, RIGHT, TOP, BOTTOM, HEAD = 0.75, 0.25, 0.35, 0.5, 0.4
"""Room around a panel and above all of them, inches."""


def layout_figure(grid: BlockGrid, *, projection: GlobeMap | None = None, name: str = "") -> Figure:
    """Return the figure of a layout and its grid; with a projection it is drawn in degrees."""
    from matplotlib.figure import Figure

    layout = grid.layout
    view = view_of(layout.mesh, projection)
    whole = with_margin(domain_box(view))
    extent = np.ptp(whole, axis=0) * [1.0, view.stretch(whole)]
    aspect = float(np.clip(extent[0] / extent[1], 0.25, 8.0))
    big = np.array([np.sqrt(AREA * aspect), np.sqrt(AREA / aspect)])
    if aspect > WIDE:
        big = np.array([11.0, 11.0 / aspect])
        places = [(LEFT, HEAD + TOP), (LEFT, HEAD + TOP + big[1] + BOTTOM + TOP)]
        small = np.array([11.0, DETAIL])
    else:
        small = np.array([DETAIL, big[1]])
        places = [(LEFT, HEAD + TOP), (LEFT + big[0] + RIGHT + LEFT, HEAD + TOP)]
    shapes = (big, small)
    width = max(x + s[0] for (x, _), s in zip(places, shapes, strict=True)) + RIGHT
    height = max(y + s[1] for (_, y), s in zip(places, shapes, strict=True)) + BOTTOM
    drawn = Figure(figsize=(width, height), dpi=DOTS)
    drawn.suptitle(_title(grid, name), fontsize=11, y=1 - 0.12 / height, va="top")
    boxes = filled(whole, big, view), filled(_detail(grid, view), small, view)
    headings = ("(a) blocks, irregular vertices", "(b) detail with the grid")
    for k, ((x, y), shape) in enumerate(zip(places, shapes, strict=True)):
        bottom = height - y - shape[1]
        axes = drawn.add_axes((x / width, bottom / height, shape[0] / width, shape[1] / height))
        prepare(axes, view, boxes[k], headings[k])
        if k == 1:
            inner = _segments(view, grid.placed, grid.mesh.points)
            draw_lines(axes, inner, boxes[k], color="#b0b0b0", linewidth=0.35)
        _blocks(axes, grid, view, boxes[k], shape)
        if k == 0:
            _frame(axes, boxes[1])
    return drawn


def _title(grid: BlockGrid, name: str) -> str:
    layout = grid.layout
    off = _off(layout.placed)
    inside = ~layout.placed.topology.is_boundary
    parts = [name] if name else []
    parts += [
        f"{layout.n_blocks} blocks of {layout.side**2} triangles",
        f"{np.count_nonzero(off[inside])} irregular vertices inside, {np.count_nonzero(off[~inside])} "
        "on the boundary",
        f"q_min {layout.mesh.qualities.min():.2f}, grid {grid.mesh.qualities.min():.2f}",
    ]
    return "  -  ".join(parts)


def _blocks(axes: Any, grid: BlockGrid, view: View, box: Floats, shape: Floats) -> None:
    """Draw the sides of blocks as the grid bends them, the boundary thick, and irregular vertices."""
    layout = grid.layout
    edge_inches = np.median(layout.mesh.edge_lengths) * shape[0] / np.ptp(box[:, 0])
    if view.projection is not None:
        edge_inches /= 111_000.0 * np.cos(np.radians(box[:, 1].mean()))
    thin = float(np.clip(4.0 * edge_inches, 0.2, 0.7))
    sides, rim = _block_sides(grid)
    _fill(axes, view.place(grid.mesh.points), grid.mesh.triangles)
    draw_lines(axes, view.place(grid.mesh.points[sides]), box, color="#505050", linewidth=thin)
    draw_lines(axes, view.place(grid.mesh.points[rim]), box, color="black", linewidth=max(2 * thin, 0.6))
    off, at = _off(layout.placed), view.placed
    seen = ((at >= box[0]) & (at <= box[1])).all(axis=1)
    size = float(np.clip(30 * edge_inches, 2.5, 7.0))
    for sign, colour, label in ((1, RED, "+"), (-1, BLUE, "-")):
        here = seen & (np.sign(off) == sign)
        axes.plot(
            *at[here].T,
            "o",
            color=colour,
            markersize=size,
            markeredgecolor="white",
            markeredgewidth=0.3,
            gid=f"irregular {label}",
            label=f"{np.count_nonzero(here)} with too {'many' if sign > 0 else 'few'} edges",
            zorder=4,
        )
    axes.legend(loc="best", fontsize=FONT, framealpha=0.9, borderpad=0.4)


def _fill(axes: Any, points: Floats, triangles: Ints) -> None:
    """Fill the domain with a pale colour, as pixels."""
    from matplotlib.collections import TriMesh
    from matplotlib.tri import Triangulation

    mesh = TriMesh(Triangulation(*points.T, triangles), facecolors=np.tile(WATER, (len(points), 1)))
    mesh.set_rasterized(True)
    mesh.set_zorder(0)
    axes.add_collection(mesh, autolim=False)


def _off(placed: PlacedMesh) -> Floats:
    """Return valence less goal of each irregular vertex, 0 at regular ones, (n_points,)."""
    return np.where(placed.is_irregular, placed.topology.valence - placed.goals, 0.0)


def _block_sides(grid: BlockGrid) -> tuple[Ints, Ints]:
    """Return the edges of the grid between two blocks and on the boundary, (n, 2) each."""
    topology = grid.placed.topology
    first, second = topology.edge_cells.T
    is_rim = topology.is_boundary_edge
    between = ~is_rim & (grid.block[first] != grid.block[second])
    return topology.edges[between], topology.edges[is_rim]


def _segments(view: View, placed: PlacedMesh, points: Floats) -> Floats:
    return view.place(points[placed.topology.edges])


def _detail(grid: BlockGrid, view: View) -> Floats:
    """Return a box around the finest block and the blocks next to it, (2, 2), plot coordinates."""
    mesh = grid.layout.mesh
    centres = view.place(mesh.centroids)
    finest = centres[np.argmin(mesh.areas)]
    away = (np.abs(centres - finest) * [1.0, view.stretch(np.array([finest, finest]))]).max(axis=1)
    reach = np.sort(away)[min(SHOWN_BLOCKS, len(away)) - 1]
    half = reach * np.array([1.0, 1.0 / view.stretch(np.array([finest, finest]))])
    return np.array([finest - half, finest + half])


def _frame(axes: Any, box: Floats) -> None:
    (x, y), (u, v) = box
    axes.plot([x, u, u, x, x], [y, y, v, v, y], color="#008040", linewidth=0.8, zorder=3)
