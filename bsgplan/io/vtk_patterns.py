"""The chosen patterns of a plan as blocks, subdivided: a gallery of regions in one file.

Every pattern stands in the shape of its own region, in rows without overlap, in the length unit of the plan.
Cell arrays: `region`, `block` (unique over the file), `level` (index of the layer, fine end 0), `quality`
(mean ratio of the block in the region's own shape, as the plan tells it; where fronts
grow and shrink again the flat picture is a little distorted). Uniform zones have no pattern and are
not shown; where all are uniform the file has no cells.
"""

from __future__ import annotations

import logging
import os
from dataclasses import dataclass, replace
from math import isqrt

import numpy as np

from ..arrays import Floats, Ints
from ..patterns import realise, subdivide
from ..patterns.frustum import pattern_qualities
from ..planning import Candidate, Plan
from ..planning.candidate import region_shape
from ..regions import Region
from .projection import Projection
from .vtk_cells import check_suffix, write_cells

log = logging.getLogger("bsgplan")

GAP = 0.15
"""Free space between two patterns, in mean extents of a pattern."""


@dataclass(frozen=True, eq=False)
class Picture:
    """One pattern, subdivided, with its lower left corner at the origin."""

    region: int
    """Region it stands for."""
    points: Floats
    """Corners of the triangles, (n, 3), length."""
    triangles: Ints
    """Corner indices, (n_triangles, 3)."""
    block: Ints
    """Block of each triangle, (n_triangles,), from 0."""
    level: Ints
    """Layer of each triangle, (n_triangles,), fine end 0."""
    quality: Floats
    """Mean ratio of the block of each triangle, (n_triangles,)."""

    @property
    def extent(self) -> Floats:
        """Width and height, (2,), length."""
        return np.ptp(self.points[:, :2], axis=0)


NONE = np.empty(0, dtype=np.int64)
NOTHING = Picture(-1, np.empty((0, 3)), np.empty((0, 3), dtype=np.int64), NONE, NONE, np.empty(0))
"""The picture of a plan without patterns."""


def write_patterns(path: str | os.PathLike[str], plan: Plan, projection: Projection | None = None) -> None:
    """Write the chosen pattern of every transition region, each block split into s x s triangles.

    With a projection lengths are true metres. Raises InvalidOption for a suffix other than .vtu and
    .vtk, OutputError where the file cannot be written; warns where no region has a pattern.
    """
    check_suffix(path)
    pictures = gallery(plan, projection=projection)
    if not pictures:
        log.warning("%s: no region has a pattern, all are uniform zones; the file has no cells", path)
        pictures = [NOTHING]
    n_points = np.cumsum([0, *(len(p.points) for p in pictures)])
    n_blocks = np.cumsum([0, *(p.block.max(initial=-1) + 1 for p in pictures)])
    points = np.concatenate([p.points for p in pictures])
    triangles = np.concatenate([p.triangles + n for p, n in zip(pictures, n_points, strict=False)])
    write_cells(
        path,
        points,
        (("triangle", triangles),),
        point_data={},
        cell_data={
            "region": [np.concatenate([np.full(len(p.block), p.region) for p in pictures])],
            "block": [np.concatenate([p.block + n for p, n in zip(pictures, n_blocks, strict=False)])],
            "level": [np.concatenate([p.level for p in pictures])],
            "quality": [np.concatenate([p.quality for p in pictures])],
        },
    )


def gallery(plan: Plan, *, projection: Projection | None = None) -> list[Picture]:
    """Return the pictures of all chosen patterns, in rows from the top, region 0 at the upper left."""
    pictures = [
        _picture(plan, p.region, p.chosen, projection) for p in plan.region_plans if p.chosen is not None
    ]
    if not pictures:
        return []
    gap = GAP * float(np.mean([p.extent for p in pictures]))
    widest = max(p.extent[0] for p in pictures)
    area = sum(float((p.extent + gap).prod()) for p in pictures)
    row_width = max(1.5 * np.sqrt(area), widest)
    placed, x, y, row_height = [], 0.0, 0.0, 0.0
    for picture in pictures:
        width, height = picture.extent
        if x > 0 and x + width > row_width:
            x, y, row_height = 0.0, y - row_height - gap, 0.0
        shift = np.array([x, y - height, 0.0])
        placed.append(replace(picture, points=picture.points + shift))
        x, row_height = x + width + gap, max(row_height, height)
    return placed


def _picture(plan: Plan, region: Region, chosen: Candidate, projection: Projection | None) -> Picture:
    side = isqrt(plan.tris_per_block)
    shape = region_shape(region.profile, float(side), is_closed=region.is_closed)
    positions = chosen.spacing.positions
    realised = realise(chosen.pattern, shape, positions)
    points, triangles, block = subdivide(realised.points, realised.triangles, side)
    points = np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))])
    corners = points[triangles]
    if np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2].sum() < 0:
        triangles = triangles[:, ::-1]  # rings in space are seen from outside: here from above
    if projection is not None:
        centroids = plan.regions.size.mesh.centroids[region.triangles]
        points = points / projection.scale(centroids).mean()
    layer = realised.front[realised.triangles].min(axis=1)
    quality = pattern_qualities(chosen.pattern, shape, positions)
    return Picture(region.id, points - points.min(axis=0), triangles, block, layer[block], quality[block])
