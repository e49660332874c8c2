"""The figure of a layout: every irregular vertex in its colour, the boundary, a detail where it matters."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from layouts_by_hand import hexagon

from bsgplan.blocks.layout import BlockGrid
from bsgplan.report.figure import save_figure
from bsgplan.report.layout_figure import layout_figure


def with_goals(goals: list[float]) -> BlockGrid:
    grid = hexagon(0.25, 4, snap=True)
    placed = replace(grid.layout.placed, goals=np.array(goals))
    return replace(grid, layout=replace(grid.layout, placed=placed))


def markers(axes, sign: str) -> np.ndarray:
    (line,) = (line for line in axes.lines if line.get_gid() == f"irregular {sign}")
    return np.column_stack(line.get_data())


def test_every_irregular_vertex_is_drawn_in_its_colour():
    grid = with_goals([5.0, 3.0, 3.0, 4.0, 4.0, 4.0, 3.0])  # six edges in the middle, three on the rim
    axes = layout_figure(grid, name="hexagon").axes[0]
    points = grid.layout.mesh.points
    assert np.allclose(markers(axes, "+"), points[[0]])
    assert np.allclose(markers(axes, "-"), points[[3, 4, 5]])
    told = [text.get_text() for text in axes.get_legend().get_texts()]
    assert told == ["1 with too many edges", "3 with too few edges"]


def test_markers_sit_where_the_grid_has_the_corners_of_blocks():
    grid = with_goals([5.0] + 6 * [4.0])
    points = grid.placed.points.copy()
    points[0] += 0.01
    moved = replace(grid, placed=replace(grid.placed, points=points))
    assert np.allclose(markers(layout_figure(moved).axes[0], "+"), moved.mesh.points[[0]])


def test_the_title_tells_blocks_irregular_vertices_and_quality():
    title = layout_figure(with_goals([5.0] + 6 * [4.0]), name="hexagon").get_suptitle()
    assert title.startswith("hexagon  -  6 blocks of 16 triangles  -  1 irregular vertex inside, 6 on")
    assert "q_min 1.00" in title


def test_the_boundary_is_that_of_the_grid_not_of_the_straight_blocks():
    grid = hexagon(0.25, 8, snap=True)
    lines = [np.concatenate(c.get_segments()) for c in layout_figure(grid).axes[0].collections[1:]]
    rim = min(lines, key=lambda points: abs(np.linalg.norm(points, axis=1) - 1).max())
    assert len(rim) == 2 * 6 * 8
    assert np.linalg.norm(rim, axis=1).min() > np.cos(np.pi / 48) - 1e-9


def test_the_detail_shows_the_worst_triangle_where_that_is_poor():
    grid = hexagon(0.25, 4, snap=True)
    assert "the finest block" in layout_figure(grid).axes[-1].get_title(loc="left")
    points = grid.placed.points.copy()
    middle = int(np.argmin(np.linalg.norm(points - points[grid.placed.triangles[7]].mean(axis=0), axis=1)))
    corners = grid.placed.triangles[(grid.placed.triangles == middle).any(axis=1)][0]
    other = int(corners[corners != middle][0])
    points[middle] += 0.8 * (points[other] - points[middle])
    poor = layout_figure(replace(grid, placed=replace(grid.placed, points=points)))
    assert "the worst triangle, q 0." in poor.axes[-1].get_title(loc="left")


@pytest.mark.parametrize("suffix", [".png", ".svg", ".pdf"])
def test_the_figure_is_written_in_every_format(tmp_path, suffix):
    path = tmp_path / f"layout{suffix}"
    save_figure(layout_figure(hexagon(0.25, 4, snap=False)), path)
    assert path.stat().st_size > 5_000
