"""The noun Job, one mesh file at some block sizes, and the work on it: one row a block size, come what may.

A job and its rows are plain data, so they travel to any process. A row is told from others by `Key`: the
content of the file, what was asked, and the version that answered.
"""

from __future__ import annotations

import hashlib
import time
from collections.abc import Iterable
from dataclasses import dataclass, replace
from importlib.metadata import version
from math import log
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from ..errors import BsgplanError
from ..io.triangle import ELE, NODE, both_paths

if TYPE_CHECKING:
    from ..io import MeshFile
    from ..planning import Plan
    from ..result import PlannedMesh

Row: TypeAlias = dict[str, str]
Key: TypeAlias = tuple[str, str, str, str, str]

KEY = ("file", "tris_per_block", "options", "content", "version")
"""Columns that tell a row from any other."""

RESULTS = (
    "format", "points", "triangles", "regions", "transitions", "limited", "blocks", "planned_triangles",
    "blocks_by_count", "blocks_gradient_limited", "q_min", "q_bound", "iota_positive", "iota_negative",
    "charge", "cpu_seconds",
)  # fmt: skip
"""Columns of a plan; empty where there is an error."""

COLUMNS = (*KEY, *RESULTS, "error")
"""The columns of the CSV file."""

LONGEST_ERROR = 500
"""Characters of an error kept in a row."""


@dataclass(frozen=True)
class Options:
    """What is asked of every mesh, as `bsgplan estimate` has it."""

    objective: str = "balanced"
    size: str | None = None
    size_file: str | None = None
    is_lonlat: bool = False
    split_quads: bool = False
    persistence: float = 1.3
    plateau: float = 0.05
    gradient_limit: float = 0.6

    def __str__(self) -> str:
        words = [f"objective={self.objective}", f"persistence={self.persistence:g}"]
        words += [f"plateau={self.plateau:g}", f"gradient-limit={self.gradient_limit:g}"]
        words += [f"size={self.size}"] if self.size is not None else []
        words += [f"size-file={self.size_file}"] if self.size_file is not None else []
        words += ["lonlat"] if self.is_lonlat else []
        return " ".join([*words, "split-quads"] if self.split_quads else words)


@dataclass(frozen=True)
class Job:
    """One mesh file at some block sizes."""

    file: str
    """The path as the user sees it: column "file"."""
    path: str
    """The absolute path, the same on every machine that works on it."""
    content: str
    """Digest of the bytes of all files read, empty where one of them cannot be."""
    block_sizes: tuple[int, ...]
    """Triangles per block, one row each."""
    options: Options = Options()
    size_path: str | None = None
    """The absolute path of the size file."""

    def key(self, tris_per_block: int) -> Key:
        """Return what tells the row of a block size from any other."""
        return self.file, str(tris_per_block), str(self.options), self.content, version("bsgplan")

    def without(self, done: Iterable[Key]) -> Job:
        """Return the job with the block sizes that have no row yet."""
        kept = set(done)
        return replace(self, block_sizes=tuple(n for n in self.block_sizes if self.key(n) not in kept))

    def row(self, tris_per_block: int, **values: Any) -> Row:
        """Return the row of a block size, columns not given empty."""
        row = dict.fromkeys(COLUMNS, "") | dict(zip(KEY, self.key(tris_per_block), strict=True))
        return row | {name: _text(value) for name, value in values.items()}

    def failed(self, reason: str) -> list[Row]:
        """Return a row with an error for each block size."""
        line = " ".join(reason.split())[:LONGEST_ERROR]
        return [self.row(n, error=line) for n in self.block_sizes]


def job(file: str, block_sizes: tuple[int, ...], options: Options) -> Job:
    """Return the job of a file."""
    path = Path(file)
    size_path = None if options.size_file is None else str(Path(options.size_file).resolve())
    files = both_paths(path) if path.suffix.lower() in (NODE, ELE) else (path,)
    content = _digest(files if size_path is None else (*files, Path(size_path)))
    return Job(file, str(path.resolve()), content, block_sizes, options, size_path)


def _digest(files: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    try:
        for file in files:
            with file.open("rb") as stream:
                digest.update(hashlib.file_digest(stream, "sha256").digest())
    except OSError:
        return ""
    return digest.hexdigest()[:16]


def plan_rows(job: Job) -> list[Row]:
    """Return one row for each block size of a job, with its plan or its error; raises nothing of its own."""
    try:
        mesh_file = _open(job)
    except Exception as error:  # any mesh, hostile ones too: the sweep goes on
        return job.failed(_reason(error))
    return [row for n in job.block_sizes for row in _planned(job, mesh_file, n)]


def _open(job: Job) -> MeshFile:
    from ..io import read, read_lonlat

    opened = read_lonlat if job.options.is_lonlat else read
    return opened(job.path, split_quads=job.options.split_quads)


def _plan(job: Job, mesh_file: MeshFile, tris_per_block: int) -> PlannedMesh:
    from ..pipeline import plan_blocks

    return plan_blocks(
        mesh_file,
        tris_per_block=tris_per_block,
        size=job.options.size,
        size_file=job.size_path,
        objective=job.options.objective,
        persistence=log(job.options.persistence),
        plateau=job.options.plateau,
        gradient_limit=job.options.gradient_limit,
    )


def _planned(job: Job, mesh_file: MeshFile, tris_per_block: int) -> list[Row]:
    start = time.process_time()
    try:
        result = _plan(job, mesh_file, tris_per_block)
    except Exception as error:
        return replace(job, block_sizes=(tris_per_block,)).failed(_reason(error))
    values = _results(result.plan) | {"format": result.mesh_file.format}
    return [job.row(tris_per_block, **values, cpu_seconds=time.process_time() - start)]


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


def _reason(error: Exception) -> str:
    if isinstance(error, BsgplanError):
        return str(error)
    return f"internal error: {type(error).__name__}: {error}"


def _text(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)
