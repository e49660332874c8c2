"""The work on a job: one row a block size, with the plan and what was warned of, or with the error."""

from __future__ import annotations

import logging
import threading
import time
from dataclasses import replace
from math import log
from typing import Any

from ..errors import BsgplanError
from ..io import MeshFile, read, read_lonlat
from ..io.projection import warn_of_degrees
from ..mesh.thinned import Thinned
from ..pipeline import check_triangles_only, plan_sizes
from ..planning import Plan
from ..sized import sizes_to_plan
from ..sizing import SizeField
from .job import Job, Row, shortened


def plan_rows(job: Job) -> list[Row]:
    """Return one row for each block size of a job, with its plan or its error; raises nothing of its own."""
    with _Warnings() as warnings:
        try:
            mesh_file = _open(job)
            size, thin = sizes_to_plan(
                mesh_file, job.options.size, job.size_path, tris_per_block=job.block_sizes
            )
        except Exception as error:  # any mesh, hostile ones too: the sweep goes on
            return job.failed(_reason(error, job))
        return [_planned(job, mesh_file, size, thin, n, warnings) for n in job.block_sizes]


def _open(job: Job) -> MeshFile:
    opened = read_lonlat if job.options.is_lonlat else read
    mesh_file = opened(job.path, split_quads=job.options.split_quads)
    check_triangles_only(mesh_file)
    warn_of_degrees(mesh_file)
    return mesh_file


def _planned(
    job: Job,
    mesh_file: MeshFile,
    size: SizeField,
    thin: Thinned | None,
    tris_per_block: int,
    warned: _Warnings,
) -> Row:
    start, before = time.process_time(), len(warned.lines)
    options = job.options
    try:
        plan = plan_sizes(
            mesh_file,
            size,
            thin=thin,
            tris_per_block=tris_per_block,
            objective=options.objective,
            persistence=log(options.persistence),
            plateau=options.plateau,
            gradient_limit=options.gradient_limit,
        ).plan
    except Exception as error:
        return replace(job, block_sizes=(tris_per_block,)).failed(_reason(error, job))[0]
    warnings = [line.removeprefix(f"{job.path}: ") for line in warned.lines]
    del warned.lines[before:]  # those of this block size alone
    return job.row(
        tris_per_block,
        **_results(plan),
        format=mesh_file.format,
        cpu_seconds=time.process_time() - start,
        warnings=shortened("; ".join(dict.fromkeys(warnings))),
    )


def _results(plan: Plan) -> dict[str, Any]:
    mesh = plan.regions.size.mesh
    return {
        "points": mesh.n_points,
        "triangles": mesh.n_triangles,
        "regions": len(plan.regions),
        "transitions": sum(p.chosen is not None for p in plan.region_plans),
        "limited": sum(p.limited is not None for p in plan.region_plans),
        "blocks": plan.n_blocks,
        "planned_triangles": plan.planned_triangles,
        "blocks_by_count": plan.drivers.blocks_by_count,
        "blocks_gradient_limited": plan.drivers.blocks_gradient_limited,
        "q_min": plan.q_min,
        "q_bound": plan.q_bound,
        "iota_positive": plan.irregularity.positive,
        "iota_negative": plan.irregularity.negative,
        "charge": plan.drivers.charge,
    }


def _reason(error: Exception, job: Job) -> str:
    if isinstance(error, BsgplanError):
        return str(error).removeprefix(f"{job.path}: ")  # the row has it in its first column
    return f"internal error: {type(error).__name__}: {error}"


class _Warnings(logging.Handler):
    """What this thread is warned of while the context lasts: `lines`."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []
        self.thread = threading.get_ident()
        self.logger = logging.getLogger("bsgplan")

    def emit(self, record: logging.LogRecord) -> None:
        """Keep the line of one record, unless another job in this process was warned."""
        if record.thread == self.thread:
            self.lines.append(" ".join(record.getMessage().split()))

    def __enter__(self) -> _Warnings:
        self.logger.addHandler(self)
        return self

    def __exit__(self, *_: object) -> None:
        self.logger.removeHandler(self)
