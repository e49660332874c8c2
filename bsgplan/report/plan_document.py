"""A plan as plain data: the JSON document `bsgplan.estimate/1`, shown whole in docs/command-line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from ..arrays import Floats
from ..mesh.irregularity import Irregularity
from ..planning import Candidate, Plan, RegionPlan
from ..planning.plan import n_refinements

SCHEMA = "bsgplan.estimate/1"


def estimate_document(
    mesh: Mapping[str, Any], plans: Sequence[Plan], *, planned_on: int, scale: Floats | None = None
) -> dict[str, Any]:
    """Return the document of one plan, or of several under "plans".

    mesh is the document of the mesh, planned_on the triangles of the one planned on; scale is the
    plane's length per true length at each point, (n_points,), of a projected mesh: sizes and areas are then
    true ones.
    """
    head = {"schema": SCHEMA, "mesh": dict(mesh), "size_field": _size_document(plans[0], planned_on, scale)}
    bodies = [plan_document(plan, scale=scale) for plan in plans]
    return head | bodies[0] if len(bodies) == 1 else head | {"plans": bodies}


def plan_document(plan: Plan, *, scale: Floats | None = None) -> dict[str, Any]:
    """Return one plan as plain data: regions, candidates and totals."""
    triangle_scale = None if scale is None else scale[plan.regions.size.mesh.triangles].mean(axis=1)
    return {
        "tris_per_block": plan.tris_per_block,
        "refinements": n_refinements(plan.tris_per_block),
        "objective": plan.objective,
        "gradient_limit": plan.gradient_limit,
        "regions": [_region_document(p, plan, triangle_scale) for p in plan.region_plans],
        "totals": _totals_document(plan),
    }


def _size_document(plan: Plan, planned_on: int, scale: Floats | None) -> dict[str, Any]:
    size = plan.regions.size
    h = size.h if scale is None else size.h / scale
    return {
        "source": size.source,
        "h_min": float(h.min()),
        "h_max": float(h.max()),
        "expected_triangles": size.expected_triangles,
        "planned_on_triangles": planned_on,
    }


def _region_document(plan: RegionPlan, whole: Plan, triangle_scale: Floats | None) -> dict[str, Any]:
    region, chosen = plan.region, plan.chosen
    areas = whole.regions.size.mesh.areas[region.triangles]
    true_areas = areas if triangle_scale is None else areas / triangle_scale[region.triangles] ** 2
    profile = region.profile
    unit = 1.0 if triangle_scale is None else float(triangle_scale[region.triangles].mean())
    is_transition = chosen is not None
    return {
        "id": region.id,
        "kind": region.kind,
        "fronts_are_closed": region.is_closed,
        "is_monotone": region.is_monotone,
        "n_triangles": region.n_triangles,
        "area": float(true_areas.sum()),
        "fine_elements": profile.fine_elements if is_transition else None,
        "coarse_elements": profile.coarse_elements if is_transition else None,
        "fronts": profile.fronts if is_transition else None,
        "layers": profile.layers if is_transition else None,
        "profile": list(plan.profile),
        "pattern": list(chosen.pattern.counts) if chosen else [],
        "blocks": plan.n_blocks,
        "planned_triangles": plan.planned_triangles,
        "q_bound": chosen.bounds.q_bound if chosen else None,
        "q_min": chosen.q_min if chosen else None,
        "irregularity": {
            "positive": plan.irregularity.positive,
            "negative": plan.irregularity.negative,
            "per_front": list(chosen.pattern.front_irregularity) if chosen else [],
        },
        "charge": region.charge,
        "limited": plan.limited,
        "largest_tris_per_block": plan.largest_tris_per_block,
        "candidates": [_candidate_document(c, unit) for c in plan.candidates],
        "unstructured": {
            "n_triangles": region.n_triangles,
            "q_min": region.q_min,
            "irregularity": _irregularity(region.irregularity),
        },
    }


def _candidate_document(candidate: Candidate, unit: float) -> dict[str, Any]:
    """Return a candidate as plain data; unit is the plane's length per true length in its region."""
    pattern, limits = candidate.pattern, candidate.bounds
    return {
        "pattern": list(pattern.counts),
        "blocks": candidate.n_blocks,
        "planned_triangles": candidate.planned_triangles,
        "irregularity": _irregularity(pattern.irregularity) | {"per_front": list(pattern.front_irregularity)},
        "q_bound": limits.q_bound,
        "positive_spread": limits.positive_spread,
        "positive_concentrated": limits.positive_concentrated,
        "angle_bound": float(np.degrees(limits.angle_bound)),
        "edge_ratio_bound": limits.edge_ratio_bound,
        "q_min": candidate.q_min,
        "misfit": candidate.misfit,
        "count_misfit": candidate.count_misfit,
        "front_positions": [float(x / unit) for x in candidate.spacing.positions],
        "rejected": candidate.rejected,
    }


def _totals_document(plan: Plan) -> dict[str, Any]:
    d = plan.drivers
    return {
        "blocks": plan.n_blocks,
        "planned_triangles": plan.planned_triangles,
        "blocks_by_count": d.blocks_by_count,
        "blocks_gradient_limited": d.blocks_gradient_limited,
        "blocks_boundary_limited": d.blocks_boundary_limited,
        "blocks_upper_limit": [asdict(u) for u in d.blocks_upper_limit],
        "paper_upper_limit": {
            "triangles": d.paper_upper_limit.triangles,
            "tris_per_block": d.paper_upper_limit.tris_per_block,
            "blocks": d.paper_upper_limit.blocks,
        },
        "blocks_gradient_bound": d.blocks_gradient_bound,
        "blocks_boundary": d.blocks_boundary,
        "charge": d.charge,
        "boundary_charge": d.boundary_charge,
        "q_bound": plan.q_bound,
        "q_min": plan.q_min,
        "irregularity": _irregularity(plan.irregularity)
        | {"note": "upper estimate: fronts shared by two regions count twice"},
        "limited_regions": [p.region.id for p in plan.region_plans if p.limited],
    }


def _irregularity(value: Irregularity) -> dict[str, Any]:
    return {"positive": value.positive, "negative": value.negative, "total": value.total}
