"""The whole flow in ten lines: what the command line and a notebook call.

>>> import bsgplan
>>> mesh_file = bsgplan.read("cases/square/mesh.msh")
>>> result = bsgplan.plan_blocks(mesh_file, tris_per_block=16)
>>> result.plan.n_blocks
127
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from math import isqrt

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from .arrays import Bools, sums_by
from .blocks.domain import domain_of
from .blocks.target import target_of
from .errors import InvalidMesh
from .io import MeshFile
from .io.part import part_of
from .memory import reused
from .mesh.thinned import Thinned
from .planning import Plan, check_block_size, estimate
from .planning.inverse import within
from .planning.totals import GRADIENT_LIMIT, least_blocks
from .regions import Regions, find_regions, measure_regions
from .regions.borders import AVERAGES
from .regions.labels import connected
from .regions.plateau import PLATEAU
from .regions.segmentation import PERSISTENCE
from .regions.selection import triangles_inside
from .result import PlannedMesh
from .sized import size_of, sizes_to_plan
from .sizing import SizeField


@reused()
def plan_blocks(
    mesh_file: MeshFile,
    *,
    tris_per_block: int | Sequence[int] = 16,
    n_blocks: int | None = None,
    size: str | None = None,
    size_file: str | os.PathLike[str] | None = None,
    region: BaseGeometry | None = None,
    objective: str = "balanced",
    persistence: float = PERSISTENCE,
    plateau: float = PLATEAU,
    gradient_limit: float = GRADIENT_LIMIT,
    every_triangle: bool = False,
    progress: Callable[[str], None] = lambda _: None,
) -> PlannedMesh:
    """Return a mesh file with its plans, one a block size.

    A large mesh is planned on a thinned one, see `sizes_to_plan`, unless every_triangle is asked for. With
    n_blocks there is one plan, at the smallest block size that needs no more blocks than that. size names a
    point or cell array, of size_file if that is given; region is a polygon in the coordinates of the file,
    cut out first: each of its connected pieces is one region.
    Raises what its steps raise; see `estimate`, `find_regions` and `within`. Raises InvalidMesh for quads.
    """
    check_triangles_only(mesh_file)
    for n in np.atleast_1d(tris_per_block):
        check_block_size(int(n))
    cut = mesh_file if region is None else cut_out(mesh_file, region)
    progress("measuring sizes")
    if every_triangle:
        field, thin = size_of(cut, size, size_file), None
    else:
        field, thin = sizes_to_plan(cut, size, size_file, tris_per_block=tris_per_block, n_blocks=n_blocks)
    return plan_sizes(
        cut,
        field,
        thin=thin,
        tris_per_block=tris_per_block,
        n_blocks=n_blocks,
        is_drawn=region is not None,
        objective=objective,
        persistence=persistence,
        plateau=plateau,
        gradient_limit=gradient_limit,
        progress=progress,
    )


def plan_sizes(
    mesh_file: MeshFile,
    field: SizeField,
    *,
    thin: Thinned | None = None,
    tris_per_block: int | Sequence[int] = 16,
    n_blocks: int | None = None,
    is_drawn: bool = False,
    objective: str = "balanced",
    persistence: float = PERSISTENCE,
    plateau: float = PLATEAU,
    gradient_limit: float = GRADIENT_LIMIT,
    progress: Callable[[str], None] = lambda _: None,
) -> PlannedMesh:
    """Return a mesh file with its plans where its size field is known; see `plan_blocks`.

    thin is the thinned mesh where the field is that of one; is_drawn says that the file is what a user drew:
    each connected piece is one region then.
    """
    averages = AVERAGES if thin is None else max(2, round(AVERAGES / thin.edge_ratio))

    def drawn(n: int) -> Regions:
        label = connected(field.mesh, np.zeros(field.mesh.n_triangles, dtype=np.int64))
        weight = sums_by(label, field.triangle_weights, int(label.max()) + 1)
        return measure_regions(field, label, np.asarray(weight < n), persistence=persistence)

    def plan_at(n: int) -> Plan:
        progress(f"planning with {n} triangles per block")
        limited = None if is_drawn else boundary_limited_blocks(field, n)  # hungry: while little is held
        if is_drawn:
            regions = drawn(n)
        else:
            regions = find_regions(
                field, tris_per_block=n, persistence=persistence, plateau=plateau, averages=averages
            )
        return estimate(
            regions,
            tris_per_block=n,
            objective=objective,
            gradient_limit=gradient_limit,
            boundary_limited=limited,
        )

    if n_blocks is not None:

        def least_at(n: int) -> int:
            return least_blocks(field, n, gradient_limit)

        plans = [within(plan_at, least_at, field.expected_triangles, n_blocks)]
    else:
        plans = [plan_at(int(n)) for n in np.atleast_1d(tris_per_block)]
    planned_on = field.mesh.n_triangles
    return PlannedMesh(mesh_file, tuple(p if thin is None else p.carried(thin) for p in plans), planned_on)


def check_triangles_only(mesh_file: MeshFile) -> None:
    """Raise InvalidMesh for a mesh with quads, which a plan would leave out."""
    if len(mesh_file.quads):
        raise InvalidMesh(
            f"{mesh_file.path}: {len(mesh_file.quads)} quads beside {mesh_file.mesh.n_triangles} triangles; "
            "only triangles are planned, split the quads with --split-quads"
        )


def boundary_limited_blocks(size: SizeField, tris_per_block: int) -> float | None:
    """Return the blocks of a layout, whose edges the boundary limits; None where none can be laid out."""
    try:
        domain = domain_of(size.mesh)
    except InvalidMesh:  # a surface in space, a folded mesh
        return None
    return target_of(domain, size, isqrt(tris_per_block)).blocks["boundary"]


def cut_out(mesh_file: MeshFile, region: BaseGeometry) -> MeshFile:
    """Return the triangles of a mesh file whose centroid lies in a polygon, with their data.

    The polygon is in the coordinates of the file, degrees where the mesh was projected from degrees.
    """
    return replace(part_of(mesh_file, triangles_in(mesh_file, region))[0], boundaries=())


def triangles_in(mesh_file: MeshFile, region: BaseGeometry) -> Bools:
    """Return the triangles of a mesh file whose centroid lies in a polygon, (n_triangles,).

    The polygon is in the coordinates of the file, degrees where the mesh was projected from degrees.
    """
    if mesh_file.projection is not None:
        x0, y0, x1, y1 = region.bounds
        fine = shapely.segmentize(region, max(x1 - x0, y1 - y0) / 50)  # straight in degrees, not in the plane
        region = shapely.transform(fine, mesh_file.projection.to_plane)
    return triangles_inside(mesh_file.mesh, region)
