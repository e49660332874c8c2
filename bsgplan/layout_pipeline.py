"""The whole flow to a grid of blocks: what `bsgplan layout` and a notebook call."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from math import isqrt

from .blocks.advice import advice
from .blocks.domain import domain_of
from .blocks.lay_out import EFFORT, SIZE_TOLERANCE, lay_out
from .io import MeshFile
from .laid_out import Features, LaidOut, find_features
from .layout_result import LayoutResult
from .pipeline import plan_blocks, size_of
from .planning import check_block_size
from .sizing import SizeField


def lay_out_mesh(
    mesh_file: MeshFile,
    *,
    tris_per_block: int = 16,
    size: str | None = None,
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

    size names a point or cell array; keep names boundaries, lines and points that blocks must follow. A block
    size that the boundary cannot carry is warned of before the work starts. is_stopped ends the annealing
    early where it gives True. Raises what its steps raise; see `lay_out`.
    """
    check_block_size(tris_per_block)
    progress("measuring sizes", 0.0)
    field = size_of(mesh_file, size)
    side = isqrt(tris_per_block)
    features = find_features(mesh_file, field, side=side, keep=keep)
    warn_if_pointless(field, features, side, gradient_limit)
    begin = time.process_time()
    grid = lay_out(
        field,
        tris_per_block=tris_per_block,
        effort=effort,
        size_tolerance=size_tolerance,
        gradient_limit=gradient_limit,
        seed=seed,
        interfaces=features.interfaces,
        kept=features.kept,
        is_straight=is_straight,
        progress=progress,
        is_stopped=is_stopped,
    )
    seconds = time.process_time() - begin
    progress("estimating", 1.0)
    planned = plan_blocks(mesh_file, tris_per_block=tris_per_block, size=size)
    return LayoutResult(LaidOut(grid, mesh_file), planned.plan, n_ranks, seconds, is_stopped())


def warn_if_pointless(field: SizeField, features: Features, side: int, gradient_limit: float | None) -> None:
    """Log a warning where the boundary cannot carry blocks of this size, before the time is spent."""
    domain = domain_of(field.mesh, interfaces=features.interfaces, kept=features.kept)
    told = advice(domain, field, side, gradient_limit=gradient_limit)
    if told is not None:
        logging.getLogger("bsgplan").warning("%s", told)
