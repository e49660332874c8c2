"""The noun PlannedMesh: a mesh file with its plans, and every way to look at them or write them down."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from .atomic import replacing
from .io import MeshFile, Projection
from .io.file import RawMesh, quads_apart
from .planning import Plan
from .report import Table, mesh_report, plan_document, plan_tables
from .report.quad_report import quad_measures
from .report.table import html, text


@dataclass(frozen=True, eq=False)
class PlannedMesh:
    """A mesh file and its plans, one a block size."""

    mesh_file: MeshFile
    """The mesh planned; the part inside, where a region was drawn."""
    plans: tuple[Plan, ...] = field(repr=False)
    """One plan a block size."""
    planned_on: int
    """Triangles of the mesh that the plans were made on: those of the file, or of its thinned mesh."""

    @property
    def plan(self) -> Plan:
        """The plan at the first block size."""
        return self.plans[0]

    def tables(self, *, all_candidates: bool = False) -> list[Table]:
        """Return the tables of the plan, or one table over the block sizes where there are several."""
        if len(self.plans) > 1:
            first, *others = [plan_tables.block_sizes_table(self.plans)]
        else:
            first, *others = plan_tables.tables(self.plan, all_candidates=all_candidates)
        return [replace(first, notes=(*first.notes, *self._thinning())), *others]

    def _thinning(self) -> tuple[str, ...]:
        n_triangles = self.mesh_file.mesh.n_triangles
        if self.planned_on == n_triangles:
            return ()
        return (
            f"planned on {self.planned_on} of {n_triangles} triangles, thinned where edges stay short; "
            "--every-triangle plans on all",
        )

    def document(self) -> dict[str, Any]:
        """Return the JSON document `bsgplan.estimate/1`."""
        return plan_document.estimate_document(
            mesh_document(self.mesh_file),
            self.plans,
            planned_on=self.planned_on,
            scale=self.mesh_file.scale,
        )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the document to a JSON file, whole or not at all; raises OutputError."""
        with replacing(path) as temporary:
            temporary.write_text(dumps(self.document()), encoding="utf-8")

    def figure(self, path: str | os.PathLike[str] | None = None) -> Any:
        """Return the matplotlib Figure of the first plan, written to path if given."""
        from .report.figure import figure, save_figure

        name = "/".join(Path(self.mesh_file.path).parts[-2:])
        result = figure(self.plan, projection=self.mesh_file.projection, name=name)
        if path is not None:
            save_figure(result, path)
        return result

    def write_vtk(self, path: str | os.PathLike[str]) -> None:
        """Write the mesh with regions, sizes, front coordinate, charge and block fronts to a .vtu."""
        from .io.vtk import write_plan

        write_plan(path, self.plan, self.mesh_file.projection)

    def write_vtk_patterns(self, path: str | os.PathLike[str]) -> None:
        """Write the chosen patterns as subdivided blocks to a .vtu."""
        from .io.vtk_patterns import write_patterns

        write_patterns(path, self.plan, self.mesh_file.projection)

    def __str__(self) -> str:
        return "\n\n".join(text(table) for table in self.tables())

    def _repr_html_(self) -> str:
        return "".join(html(table) for table in self.tables())


def mesh_document(mesh_file: MeshFile) -> dict[str, Any]:
    """Return the document of a mesh file: what it holds and what can be measured on it."""
    projection, mesh = mesh_file.projection, mesh_file.mesh
    quad_scale = None if projection is None else projection.scale(mesh_file.quad_points)
    found = mesh_file.description()
    bounds = mesh.bounds
    if projection is not None:
        degrees = projection.to_unbroken_degrees(mesh.points)
        bounds = tuple(np.column_stack([degrees.min(axis=0), degrees.max(axis=0)]).ravel().tolist())
    return {
        "path": found["path"],
        "format": found["format"],
        **mesh_report.measures(mesh, scale=mesh_file.scale),
        "bounds": list(bounds),
        "quads": quad_measures(mesh_file.quad_points, mesh_file.quads, scale=quad_scale),
        **found,
    }


def quads_document(
    path: str | os.PathLike[str], file_format: str, raw: RawMesh, projection: Projection | None = None
) -> dict[str, Any]:
    """Return the document of a mesh of quads and no triangle, as it stands in its file.

    Raises InvalidMesh where a quad names a point that is not there.
    """
    points, quads, _ = quads_apart(raw)
    scale = None if projection is None else projection.scale(points)
    shown = points if projection is None else projection.to_unbroken_degrees(points)
    return {
        "path": os.fspath(path),
        "format": file_format,
        **mesh_report.measures_without_triangles(),
        "n_points": len(points),
        "bounds": np.column_stack([shown.min(axis=0), shown.max(axis=0)]).ravel().tolist(),
        "quads": quad_measures(points, quads, scale=scale),
        "title": raw.title,
        "ignored": dict(raw.ignored),
        "boundaries": [],
        "arrays": {"points": sorted(raw.point_data), "cells": sorted(raw.quad_data)},
        "notes": [*raw.notes, "no triangles; --split-quads makes triangles of the quads"],
        "projection": None if projection is None else projection.description(),
    }


def dumps(document: dict[str, Any]) -> str:
    """Return a document as JSON text that ends with a newline; every number is finite."""
    return json.dumps(document, indent=2, allow_nan=False) + "\n"
