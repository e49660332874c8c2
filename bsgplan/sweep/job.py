"""The noun Job: one mesh file at some block sizes, one row each.

A job and its rows are plain data, so they travel to any process. A row is told from others by `Key`: the
content of the file, what was asked, and the version that answered.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any, TypeAlias

from ..io.triangle import ELE, NODE, both_paths

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

COLUMNS = (*KEY, *RESULTS, "warnings", "error")
"""The columns of the CSV file."""

LONGEST_MESSAGE = 500
"""Characters of an error, or of the warnings, kept in a row."""


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
        return [self.row(n, error=shortened(reason)) for n in self.block_sizes]


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


def shortened(text: str) -> str:
    r"""Return a text on one line, cut where it is long.

    >>> shortened("two\nlines")
    'two lines'
    """
    return " ".join(text.split())[:LONGEST_MESSAGE]


def _text(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)
