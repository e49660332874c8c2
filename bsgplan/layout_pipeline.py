"""The whole flow to a grid of blocks: what `bsgplan layout` and a notebook call."""

from __future__ import annotations

import logging
import os
import time
from collections.abc import Callable, Sequence
from math import isqrt

import numpy as np

from .blocks.advice import advice
from .blocks.anneal import SIZE_TOLERANCE
from .blocks.domain import domain_of
from .blocks.lay_out import EFFORT, lay_out
from .io import MeshFile
from .laid_out import Features, find_features, lay_out_with
from .laid_out.specks import without_specks
from .layout_result import LayoutResult
from .mesh import Mesh
from .pipeline import check_triangles_only, plan_sizes
from .planning import check_block_size
from .sized import size_of
from .sizing import SizeField, size_field


def lay_out_mesh(
    mesh_file: MeshFile,
    *,
    tris_per_block: int = 16,
    size: str | None = None,
    size_file: str | os.PathLike[str] | None = None,
    keep: Sequence[str] = (),
    effort: int = EFFORT,
    size_tolerance: float = SIZE_TOLERANCE,
    gradient_limit: float | None = None,
    seed: int = 7,
    is_straight: bool = False,
    n_ranks: int | None = None,
    progress: Callable[[str, float], None] = lambda _, __: None,
    is_stopped: Callable[[], bool] = lambda: False,
) -> LayoutResult:
    """Return a mesh file with its block layout, the grid of it, and the estimate of both.

    size names a point or cell array, of size_file if that is given; keep names boundaries, lines and points
    that blocks must follow. A block size that the boundary cannot carry is warned of before the work starts.
    is_stopped ends the annealing early where it gives True. Raises what its steps raise; see `lay_out`.
    """
    check_block_size(tris_per_block)
    check_triangles_only(mesh_file)
    progress("measuring sizes", 0.0)
    whole, side = mesh_file, isqrt(tris_per_block)
    whole_field = size_of(whole, size, size_file)
    mesh_file, field = without_specks(whole, whole_field, side=side)
    features = find_features(mesh_file, field, side=side, keep=keep)
    warn_if_pointless(field, features, side, gradient_limit=gradient_limit)
    compile_kernels()
    begin = time.process_time()
    laid_out = lay_out_with(
        features,
        mesh_file,
        field,
        side=side,
        effort=effort,
        size_tolerance=size_tolerance,
        gradient_limit=gradient_limit,
        seed=seed,
        is_straight=is_straight,
        progress=progress,
        is_stopped=is_stopped,
    )
    seconds = time.process_time() - begin
    progress("estimating", 1.0)
    planned = plan_sizes(whole, whole_field, tris_per_block=tris_per_block)
    return LayoutResult(laid_out, planned.plan, n_ranks, seconds, is_stopped())


def compile_kernels() -> None:
    """Lay out a small square where no cache has the kernels: work and compiler are then timed apart."""
    from .blocks.kernel.anneal import anneal
    from .compiled import is_cached

    if is_cached(anneal):
        return
    i, j = (v.ravel() for v in np.meshgrid(np.arange(4), np.arange(4)))
    at = (5 * j + i)[:, None]
    triangles = (at[:, None] + np.array([[0, 1, 6], [0, 6, 5]])).reshape(-1, 3)
    points = np.column_stack([np.tile(np.arange(5), 5), np.repeat(np.arange(5), 5)]) / 4
    lay_out(size_field(Mesh(points, triangles)), tris_per_block=4, effort=1)


def warn_if_pointless(
    field: SizeField, features: Features, side: int, *, gradient_limit: float | None
) -> None:
    """Log a warning where the boundary cannot carry blocks of this size, before the time is spent."""
    domain = domain_of(field.mesh, interfaces=features.interfaces, kept=features.kept)
    told = advice(domain, field, side, gradient_limit=gradient_limit)
    if told is not None:
        logging.getLogger("bsgplan").warning("%s", told)
