"""A layout as plain data: the JSON document `bsgplan.layout/1`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import isfinite
from typing import Any

from ..blocks.floor import Floor
from ..blocks.layout import BlockGrid
from ..blocks.levels import VECTORS, Level, Ranks
from ..blocks.measures import EdgeRatio, Measures
from ..planning import Plan

SCHEMA = "bsgplan.layout/1"


@dataclass(frozen=True, eq=False)
class LayoutReport:
    """Everything that is told about a layout, measured once."""

    grid: BlockGrid
    """The layout and its grid."""
    plan: Plan
    """The estimate at the same block size."""
    before: Measures
    """Of the input mesh."""
    blocks: Measures
    """Of the blocks with straight sides."""
    triangles: Measures
    """Of the grid."""
    on_target: EdgeRatio
    """Edges of blocks against the target, all limits applied."""
    deviation: tuple[float, float]
    """Of the grid's boundary from the true one, most and 99th percentile, in h."""
    floor: Floor
    """What topology and corners demand."""
    levels: tuple[Level, ...]
    """From blocks to triangles."""
    ranks: Ranks | None
    """How blocks spread over ranks, if asked."""
    time_steps: tuple[float, float] | None
    """Smallest edge / sqrt(g depth) of input and grid, seconds, where there is a depth."""
    seconds_cpu: float
    """Processor time of the layout and its grid, the estimate and this report left out."""
    is_interrupted: bool
    """The user stopped the annealing early."""


def layout_document(report: LayoutReport) -> dict[str, Any]:
    """Return the document of a layout."""
    layout, target, plan = report.grid.layout, report.grid.layout.target, report.plan
    low, high = report.floor.corners
    return {
        "schema": SCHEMA,
        "tris_per_block": layout.side**2,
        "is_straight": report.grid.is_straight,
        "is_interrupted": report.is_interrupted,
        "input": measures_document(report.before),
        "estimate": estimate_measures(plan),
        "layout": measures_document(report.blocks),
        "grid": measures_document(report.triangles),
        "floor": {
            "irregularity": report.floor.irregularity,
            "n_corners": report.floor.n_corners,
            "corners": [low, high],
            "irregular": report.floor.irregular,
            "charge": plan.drivers.charge,
            "boundary_charge": plan.drivers.boundary_charge,
        },
        "limits": {
            "gradient_limit": target.gradient_limit if isfinite(target.gradient_limit) else None,
            "blocks": dict(target.blocks),
            "edge_ratio": asdict(report.on_target),
        },
        "boundary_deviation": {"max": report.deviation[0], "p99": report.deviation[1]},
        "levels": [asdict(level) for level in report.levels],
        "ranks": None if report.ranks is None else ranks_document(report.ranks, report.levels),
        "time_step": None
        if report.time_steps is None
        else {"input": report.time_steps[0], "grid": report.time_steps[1]},
        "seconds_cpu": report.seconds_cpu,
    }


def measures_document(measures: Measures) -> dict[str, Any]:
    """Return the measures of one mesh as plain data."""
    return asdict(measures)


def estimate_measures(plan: Plan) -> dict[str, Any]:
    """Return what a plan foretells of the same measures; what it does not is None."""
    return {
        "n_triangles": plan.planned_triangles,
        "n_blocks": plan.n_blocks,
        "q_min": plan.q_min,
        "q_mean": None,
        "q_p01": None,
        "irregular_interior": None,
        "irregular_boundary": None,
        "irregular_boundary_fitted": None,
        "irregularity": {"positive": plan.irregularity.positive, "negative": plan.irregularity.negative},
        "edge_ratio": None,
    }


def ranks_document(ranks: Ranks, levels: Sequence[Level]) -> dict[str, Any]:
    """Return how blocks spread over ranks, with the bytes of the fullest rank on the finest level."""
    return {
        **asdict(ranks),
        "vectors": VECTORS,
        "memory": ranks.memory(tuple(level.side for level in levels)),
    }
