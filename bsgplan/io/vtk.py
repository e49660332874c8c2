"""Plans for ParaView and PyVista: the mesh with its regions, sizes, charge and block fronts in one file.

Triangles come first, in the order of the mesh, then the block fronts as lines. Cell arrays: `region`, `kind`
(0 uniform, 1 transition, 2 front line, -1 outside the regions), `pattern` (region whose pattern it is, -1
where there is none), `level` (index of the front on lines, -1 on triangles), `quality` (mean ratio, 1 on
lines), `size`, `front_coordinate` (depth in block layers, 0 in uniform zones). Point arrays: `size`,
`charge` (in units of iota, adds up to the charge of the plan), `front_coordinate`.
"""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..planning import Plan
from ..regions.contours import front_coordinate, front_levels, front_lines, vertex_charges
from ..regions.region import TRANSITION
from .projection import Projection
from .vtk_cells import check_suffix, write_cells
from .vtk_patterns import write_patterns

__all__ = ["FrontLines", "plan_front_lines", "write_patterns", "write_plan"]

OUTSIDE, UNIFORM_ZONE, TRANSITION_ZONE, FRONT_LINE = -1, 0, 1, 2
"""Values of the cell array `kind`."""


@dataclass(frozen=True, eq=False)
class FrontLines:
    """The block fronts of a whole plan as line segments."""

    segments: Floats
    """Ends of each segment, (n, 2, 2 or 3), length."""
    region: Ints
    """Region of each segment, (n,)."""
    level: Ints
    """Index of its front in the pattern, fine end 0, (n,)."""
    log_h: Floats
    """Log size of that front, (n,)."""
    depth: Floats
    """Depth of that front in block layers, (n,)."""


def write_plan(path: str | os.PathLike[str], plan: Plan, projection: Projection | None = None) -> None:
    """Write the mesh of a plan with its regions and block fronts as .vtu, or .vtk by the suffix.

    With a projection points are in degrees and sizes are true ones. The file appears whole or not at all;
    raises InvalidOption for another suffix and OutputError where the file cannot be written.
    """
    check_suffix(path)
    regions, side = plan.regions, float(np.sqrt(plan.tris_per_block))
    size, mesh = regions.size, regions.size.mesh
    lines = plan_front_lines(plan)
    n_lines, n_points = len(lines.region), mesh.n_points
    ends = lines.segments.reshape(2 * n_lines, mesh.points.shape[1])
    points = np.concatenate([mesh.points, ends])
    scale = np.ones(len(points)) if projection is None else projection.scale(points)
    line_cells = n_points + np.arange(2 * n_lines).reshape(-1, 2)
    cells = (("triangle", mesh.triangles), ("line", line_cells))
    depth_at_points, depth_at_triangles = front_coordinate(regions, side)
    has_pattern = np.array([p.chosen is not None for p in plan.region_plans] + [False])
    kinds = np.array([TRANSITION_ZONE if r.kind == TRANSITION else UNIFORM_ZONE for r in regions] + [OUTSIDE])
    cell_data = {
        "region": [regions.label, lines.region],
        "kind": [kinds[regions.label], np.full(n_lines, FRONT_LINE)],
        "pattern": [np.where(has_pattern[regions.label], regions.label, -1), lines.region],
        "level": [np.full(mesh.n_triangles, -1), lines.level],
        "quality": [mesh.qualities, np.ones(n_lines)],
        "size": [
            size.triangle_h / scale[mesh.triangles].mean(axis=1),
            np.exp(lines.log_h) / scale[line_cells].mean(axis=1),
        ],
        "front_coordinate": [depth_at_triangles, lines.depth],
    }
    point_data = {
        "size": np.concatenate([size.h, np.repeat(np.exp(lines.log_h), 2)]) / scale,
        "charge": np.concatenate([vertex_charges(regions), np.zeros(2 * n_lines)]),
        "front_coordinate": np.concatenate([depth_at_points, np.repeat(lines.depth, 2)]),
    }
    if projection is not None:
        points = projection.to_unbroken_degrees(points)
    write_cells(path, points, cells, point_data=point_data, cell_data=cell_data)


def plan_front_lines(plan: Plan) -> FrontLines:
    """Return the fronts of the chosen patterns as contours: front k of n layers at depth k layers / n."""
    levels, depths, n_before = {}, [], 0
    first = np.zeros(len(plan.region_plans), dtype=np.int64)  # place of a region's fine end among all fronts
    for k, part in enumerate(plan.region_plans):
        if part.chosen is not None:
            profile, n_fronts = part.region.profile, part.chosen.pattern.n_fronts
            first[k] = n_before
            levels[k] = front_levels(profile, n_fronts)
            depths.append(np.linspace(0.0, profile.layers, n_fronts))
            n_before += n_fronts
    segments, region, level = front_lines(plan.regions, levels)
    front = first[region] + level
    log_h, depth = (np.concatenate([np.empty(0), *of])[front] for of in (levels.values(), depths))
    return FrontLines(segments, region, level, log_h, depth / float(np.sqrt(plan.tris_per_block)))
