"""The figure of a layout: blocks over the domain, irregular vertices red (+) and blue (-), and a detail.

The detail shows the grid of the blocks around the finest one. Fills are pixels, the rest vectors unless many.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import Floats, Ints
from ..blocks.layout import BlockGrid
from ..blocks.placed import PlacedMesh
from ..words import counted
from .figure import DOTS, prepare
from .figure_panels import FONT, draw_lines
from .figure_view import GlobeMap, View, domain_box, filled, view_of, with_margin, zoom_box

if TYPE_CHECKING:
    from matplotlib.figure import Figure

AREA, DETAIL = 50.0, 5.5
"""Area of the map of blocks, square inches; edge of the detail, inches."""

WIDE = 1.6
"""A domain so many times wider than high has its detail below it."""

DETAIL_EDGES = 7
"""Edges of its middle block across the detail."""

POOR = 0.5
"""Under this mean ratio the detail shows the worst triangle, otherwise the finest block."""

RED, BLUE = "#d01c1c", "#1c50d0"
"""Colours of vertices with too many and with too few edges."""

WATER = (0.925, 0.95, 0.97, 1.0)
"""Fill of the domain."""

LEFT, RIGHT, TOP, BOTTOM, HEAD = 0.75, 0.25, 0.35, 0.5, 0.4
"""Room around a panel and above all of them, inches."""


def layout_figure(grid: BlockGrid, *, projection: GlobeMap | None = None, name: str = "") -> Figure:
    """Return the figure of a layout and its grid; with a projection it is drawn in degrees."""
    from matplotlib.figure import Figure

    view = view_of(grid.layout.mesh, projection)
    block, why = _spot(grid)
    panels = [("blocks, irregular vertices", with_margin(domain_box(view_of(grid.mesh, projection))))]
    zoom = zoom_box(view_of(grid.layout.size.mesh, projection), grid.layout.size)
    if zoom is not None:
        panels.append(("zoom", zoom))
    panels.append((f"detail with the grid: {why}", _detail(grid, block, view)))
    shapes, places = _arrangement(panels[0][1], view, len(panels))
    width = max(x + s[0] for (x, _), s in zip(places, shapes, strict=True)) + RIGHT
    height = max(y + s[1] for (_, y), s in zip(places, shapes, strict=True)) + BOTTOM
    drawn = Figure(figsize=(width, height), dpi=DOTS)
    drawn.suptitle(_title(grid, name), fontsize=11, y=1 - 0.12 / height, va="top")
    boxes = [filled(box, shape, view) for (_, box), shape in zip(panels, shapes, strict=True)]
    for k, ((x, y), shape) in enumerate(zip(places, shapes, strict=True)):
        bottom = height - y - shape[1]
        axes = drawn.add_axes((x / width, bottom / height, shape[0] / width, shape[1] / height))
        prepare(axes, view, boxes[k], f"({'abc'[k]}) {panels[k][0]}")
        if k == len(panels) - 1:
            fine = view.place(grid.mesh.points[grid.placed.topology.edges])
            draw_lines(axes, fine, boxes[k], color="#b0b0b0", linewidth=0.35)
        else:
            _frame(axes, boxes[k + 1])
        _blocks(axes, grid, view, boxes[k], shape)
    return drawn


def _arrangement(whole: Floats, view: View, n_panels: int) -> tuple[list[Floats], list[tuple[float, float]]]:
    """Return width and height of every panel and where its upper left corner stands, inches."""
    extent = np.ptp(whole, axis=0) * [1.0, view.stretch(whole)]
    aspect = float(np.clip(extent[0] / extent[1], 0.25, 8.0))
    if aspect > WIDE:
        shapes = [np.array([11.0, 11.0 / aspect])] + [np.array([11.0, DETAIL])] * (n_panels - 1)
        tops = np.cumsum([HEAD + TOP] + [s[1] + BOTTOM + TOP for s in shapes[:-1]])
        return shapes, [(LEFT, float(y)) for y in tops]
    big = np.array([np.sqrt(AREA * aspect), np.sqrt(AREA / aspect)])
    shapes = [big] + [np.array([DETAIL, big[1]])] * (n_panels - 1)
    lefts = np.cumsum([LEFT] + [s[0] + RIGHT + LEFT for s in shapes[:-1]])
    return shapes, [(float(x), HEAD + TOP) for x in lefts]


def _title(grid: BlockGrid, name: str) -> str:
    layout = grid.layout
    off = _off(layout.placed)
    inside = ~layout.placed.topology.is_boundary
    parts = [name] if name else []
    parts += [
        f"{counted(layout.n_blocks, 'block')} of {counted(layout.side**2, 'triangle')}",
        f"{counted(int((off[inside] != 0).sum()), 'irregular vertex', 'irregular vertices')} inside, "
        f"{np.count_nonzero(off[~inside])} on the boundary",
        f"q_min {layout.mesh.qualities.min():.2f}, grid {grid.mesh.qualities.min():.2f}",
    ]
    return "  -  ".join(parts)


def _blocks(axes: Any, grid: BlockGrid, view: View, box: Floats, shape: Floats) -> None:
    """Draw the sides of blocks as the grid bends them, the boundary thick, and irregular vertices."""
    layout = grid.layout
    at = view.place(grid.mesh.points[: layout.mesh.n_points])  # smoothing moves the corners of blocks too
    seen = ((at >= box[0]) & (at <= box[1])).all(axis=1)
    edges = at[layout.mesh.topology.edges[seen[layout.mesh.topology.edges].any(axis=1)]]
    across = np.abs(edges[:, 0] - edges[:, 1])[:, 0] if len(edges) else np.ones(1)
    edge_inches = 1.5 * float(np.median(across)) * shape[0] / np.ptp(box[:, 0])
    thin = float(np.clip(4.0 * edge_inches, 0.2, 0.7))
    sides, rim = _block_sides(grid)
    _fill(axes, view.place(grid.mesh.points), grid.mesh.triangles)
    draw_lines(axes, view.place(grid.mesh.points[sides]), box, color="#505050", linewidth=thin)
    draw_lines(axes, view.place(grid.mesh.points[rim]), box, color="black", linewidth=max(2 * thin, 0.6))
    off = _off(layout.placed)
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

    mesh = TriMesh(
        Triangulation(points[:, 0], points[:, 1], triangles), facecolors=np.tile(WATER, (len(points), 1))
    )
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


def _spot(grid: BlockGrid) -> tuple[int, str]:
    """Return the block that the detail is about, and why: the worst one if poor, else the finest."""
    mesh = grid.layout.mesh
    quality = np.minimum.reduceat(grid.mesh.qualities, np.arange(0, grid.n_triangles, grid.layout.side**2))
    if quality.min() < POOR:
        return int(quality.argmin()), f"the worst triangle, q {quality.min():.2f}"
    return int(mesh.areas.argmin()), "the finest block"


def _detail(grid: BlockGrid, block: int, view: View) -> Floats:
    """Return a box around a block and the blocks next to it, (2, 2), plot coordinates."""
    mesh = grid.layout.mesh
    middle, corners = view.place(mesh.centroids[block]), view.place(mesh.points[mesh.triangles[block]])
    stretch = view.stretch(np.array([middle, middle]))
    sides = np.linalg.norm((corners - np.roll(corners, 1, axis=0)) * [1.0, stretch], axis=1)
    half = DETAIL_EDGES / 2 * sides.mean() * np.array([1.0, 1.0 / stretch])
    return np.array([middle - half, middle + half])


def _frame(axes: Any, box: Floats) -> None:
    (x, y), (u, v) = box
    axes.plot([x, u, u, x, x], [y, y, v, v, y], color="#008040", linewidth=0.8, zorder=3)
