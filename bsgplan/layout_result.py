"""The noun LayoutResult: a mesh file laid out in blocks, and every way to show or write that."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from .arrays import Floats
from .atomic import replacing
from .blocks.floor import floor_of
from .blocks.layout import BlockGrid
from .blocks.levels import levels, ranks
from .blocks.measures import (
    boundary_deviation,
    grid_measures,
    input_measures,
    layout_measures,
    least_time_step,
    target_conformity,
)
from .io import MeshFile
from .laid_out import LaidOut, arrays_of, export
from .planning import Plan
from .report import Table, layout_tables
from .report.layout_document import LayoutReport, layout_document
from .report.table import html, text

DEPTH = "depth"
"""Point array of ADCIRC and SCHISM meshes: still water depth, metres, positive down."""


@dataclass(frozen=True, eq=False)
class LayoutResult:
    """A mesh file, its block layout cut into a grid, and the estimate of it."""

    laid_out: LaidOut
    """Blocks and grid, with the mesh file that they are made from."""
    plan: Plan = field(repr=False)
    """The estimate at the same block size."""
    n_ranks: int | None = None
    """Processes that the blocks shall be handed out to, if asked."""
    seconds_cpu: float = 0.0
    """Processor time of layout and grid."""
    is_interrupted: bool = False
    """The annealing was stopped early."""

    @property
    def mesh_file(self) -> MeshFile:
        """The mesh laid out."""
        return self.laid_out.mesh_file

    @property
    def grid(self) -> BlockGrid:
        """Blocks and triangles."""
        return self.laid_out.grid

    @cached_property
    def blocks_file(self) -> MeshFile:
        """The blocks as a mesh file."""
        return self.laid_out.blocks_file()

    @cached_property
    def grid_file(self) -> MeshFile:
        """The triangles as a mesh file."""
        return self.laid_out.grid_file()

    @cached_property
    def report(self) -> LayoutReport:
        """Everything that is told about the layout, measured once."""
        layout = self.grid.layout
        return LayoutReport(
            grid=self.grid,
            plan=self.plan,
            before=input_measures(layout.size),
            blocks=layout_measures(layout),
            triangles=grid_measures(self.grid),
            on_target=target_conformity(layout),
            deviation=boundary_deviation(self.grid),
            floor=floor_of(layout),
            levels=levels(layout.placed.topology, layout.side),
            ranks=None if self.n_ranks is None else ranks(layout.n_blocks, self.n_ranks),
            time_steps=self._time_steps(),
            seconds_cpu=self.seconds_cpu,
            is_interrupted=self.is_interrupted,
        )

    def tables(self) -> list[Table]:
        """Return the tables: comparison, limits, levels."""
        return layout_tables.tables(self.report)

    def document(self) -> dict[str, Any]:
        """Return the JSON document `bsgplan.layout/1`."""
        return layout_document(self.report)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the document with blocks and grid to a JSON file for `load_layout`; raises OutputError."""
        parts = {"blocks": arrays_of(self.blocks_file), "grid": arrays_of(self.grid_file)}
        content = json.dumps(self.document() | parts, allow_nan=False)
        with replacing(path) as temporary:
            temporary.write_text(content + "\n", encoding="utf-8")

    def figure(self, path: str | os.PathLike[str] | None = None) -> Any:
        """Return the matplotlib Figure of blocks and irregular vertices, written to path if given."""
        from .report.figure import save_figure
        from .report.layout_figure import layout_figure

        name = "/".join(Path(self.mesh_file.path).parts[-2:])
        result = layout_figure(self.grid, projection=self.mesh_file.projection, name=name)
        if path is not None:
            save_figure(result, path)
        return result

    def write_blocks(self, path: str | os.PathLike[str]) -> None:
        """Write the blocks, one cell each, in the format of the suffix; see `export`."""
        export(self.blocks_file, path)

    def write_grid(self, path: str | os.PathLike[str]) -> None:
        """Write the triangles with their blocks in the format of the suffix; see `export`."""
        export(self.grid_file, path)

    def _time_steps(self) -> tuple[float, float] | None:
        depth = self.mesh_file.point_data.get(DEPTH)
        if depth is None or depth.ndim != 1:
            return None
        mesh, grid, projection = self.mesh_file.mesh, self.grid.mesh, self.mesh_file.projection
        scales: list[Floats | None] = [
            None if projection is None else projection.scale(np.asarray(m.points)) for m in (mesh, grid)
        ]
        before = least_time_step(mesh, depth, scales[0])
        after = least_time_step(grid, self.grid.at_points(depth), scales[1])
        return None if before is None or after is None else (before, after)

    def __str__(self) -> str:
        return "\n\n".join(text(table) for table in self.tables())

    def _repr_html_(self) -> str:
        return "".join(html(table) for table in self.tables())
