"""A replacement as tables and as the JSON document `bsgplan.replace/1`."""

from __future__ import annotations

from typing import Any

from ..arrays import Floats
from ..remesh import Replacement
from ..remesh.measures import Measures
from ..remesh.replacement import Part
from ..words import counted
from .rows import plain_irregularity
from .table import QUALITY, Column, Table, Value

SCHEMA = "bsgplan.replace/1"

MOST_REGIONS = 20
"""Regions with a row of their own, those with the most irregular vertices; the rest is in the document."""


def tables(replacement: Replacement) -> list[Table]:
    """Return the tables of a replacement: in total, its regions, and the parts that were left alone."""
    regions = list(replacement.regions())
    is_told_by_regions = len(regions) > 1 or bool((replacement.label < 0).any())
    alone = [part for part in replacement.parts if part.reason]
    return [
        total_table(*replacement.totals(), notes=notes(replacement)),
        *([regions_table(regions, replacement.charges())] if is_told_by_regions else []),
        *([parts_table(alone)] if alone else []),
    ]


def notes(replacement: Replacement) -> tuple[str, ...]:
    """Return the budget of irregular vertices, and what strips of fronts had to do with the result."""
    charges = replacement.charges()
    up, down = (float(charges[sign * charges > 0].sum()) for sign in (1, -1))
    told = [
        f"budget: the size demands iota {up:+.1f} and {down:.1f} inside its regions",
        f"floor: the boundary leaves no fewer than {_irregular(replacement.floor())} inside",
    ]
    tried = sum(part.strips.tried for part in replacement.parts)
    kept = sum(part.strips.kept for part in replacement.parts if not part.reason)
    if replacement.is_interrupted:
        told.append("stopped early")
    if tried:
        gone = sum(part.strips.gone for part in replacement.parts if not part.reason)
        less = f", {_irregular(gone)} less" if kept else ""
        told.append(f"strips of fronts: the better start in {kept} of {tried} clear transitions{less}")
    return tuple(told)


def total_table(before: Measures, after: Measures, notes: tuple[str, ...] = ()) -> Table:
    """Return one row a measure of the whole mesh."""
    rows: list[tuple[Value, ...]] = [
        (name, a, b, _change(a, b))
        for name, a, b in (
            ("triangles", before.n_triangles, after.n_triangles),
            ("irregular inside", before.irregular_interior, after.irregular_interior),
            ("irregular on the boundary", before.irregular_boundary, after.irregular_boundary),
            ("  by its angles", before.irregular_boundary_fitted, after.irregular_boundary_fitted),
            ("iota+", before.irregularity.positive, after.irregularity.positive),
        )
    ]
    rows += [
        (name, a, b, f"{b - a:+.3f}")
        for name, a, b in (
            ("q_min", before.q_min, after.q_min),
            ("q of the worst 1 %", before.q_1_percent, after.q_1_percent),
            ("q mean", before.q_mean, after.q_mean),
            ("size misfit, rms log", before.size_misfit, after.size_misfit),
        )
    ]
    columns = (
        Column("whole mesh"),
        Column("before", "", ".3f"),
        Column("after", "", ".3f"),
        Column("change"),
    )
    return Table("", columns, tuple(rows), notes)


def regions_table(regions: list[tuple[int, Measures, Measures]], charges: Floats) -> Table:
    """Return one row a region, the most irregular first."""
    columns = (
        Column("region"),
        Column("triangles"),
        Column("after"),
        Column("irregular"),
        Column("after"),
        Column("budget", "", "+.1f"),
        Column("iota+"),
        Column("after"),
        Column("q_min", "", QUALITY),
        Column("after", "", QUALITY),
        Column("misfit", "", ".3f"),
        Column("after", "", ".3f"),
    )
    order = sorted(regions, key=lambda row: -row[1].irregular_interior)[:MOST_REGIONS]
    rows = [
        (
            str(k),
            *(a.n_triangles, b.n_triangles, a.irregular_interior, b.irregular_interior),
            float(charges[k]),
            *(a.irregularity.positive, b.irregularity.positive),
            *(a.q_min, b.q_min, a.size_misfit, b.size_misfit),
        )
        for k, a, b in order
    ]
    rest = len(regions) - len(order)
    notes = (f"{rest} more regions are in the document (--json)",) if rest else ()
    return Table("regions, finest 0; irregular vertices are those inside", columns, tuple(rows), notes)


def parts_table(parts: list[Part]) -> Table:
    """Return why parts were left alone."""
    return Table("left alone", (Column("part"), Column("why")), tuple((p.name, p.reason) for p in parts))


def document(mesh: dict[str, Any], replacement: Replacement) -> dict[str, Any]:
    """Return the JSON document: before and after in total, by regions, and the parts tried."""
    before, after = replacement.totals()
    charges = replacement.charges()
    return {
        "schema": SCHEMA,
        "mesh": mesh,
        "before": plain(before),
        "after": plain(after),
        "budget": {
            "positive": float(charges[charges > 0].sum()),
            "negative": float(charges[charges < 0].sum()),
            "floor": replacement.floor(),
        },
        "regions": [
            {"region": k, "budget": float(charges[k]), "before": plain(a), "after": plain(b)}
            for k, a, b in replacement.regions()
        ],
        "is_interrupted": replacement.is_interrupted,
        "parts": [
            {
                "name": part.name,
                "is_replaced": not part.reason,
                "reason": part.reason or None,
                "strips": vars(part.strips),
                "before": plain(part.before),
                "after": plain(part.after),
            }
            for part in replacement.parts
        ],
    }


def plain(measures: Measures) -> dict[str, Any]:
    """Return measures as plain data."""
    return {**vars(measures), "irregularity": plain_irregularity(measures.irregularity)}


def _change(before: int, after: int) -> str:
    return f"{100 * (after / before - 1):+.0f} %" if before else f"{after - before:+d}"


def _irregular(n: int) -> str:
    return counted(n, "irregular vertex", "irregular vertices")
