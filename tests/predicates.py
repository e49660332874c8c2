"""Definitions that an output must satisfy, stated as assertions."""

from __future__ import annotations

import numpy as np
import pytest
import reference

from bsgplan.io import MeshFile
from bsgplan.mesh import Mesh
from bsgplan.mesh.quality import signed_areas
from bsgplan.planning import Plan
from bsgplan.regions import Profile, Regions
from bsgplan.remesh import Replacement
from bsgplan.remesh.accept import QUALITY_LOSS


def assert_is_mesh(mesh: Mesh) -> None:
    """Every point used, every triangle of positive area, every edge in one or two triangles."""
    assert mesh.triangles.min() == 0
    assert set(np.unique(mesh.triangles)) == set(range(mesh.n_points))
    assert (mesh.areas > 0).all()
    n_cells = (mesh.topology.edge_cells >= 0).sum(axis=1)
    assert set(n_cells.tolist()) <= {1, 2}
    assert not mesh.points.flags.writeable
    assert not mesh.triangles.flags.writeable


def assert_identity_holds(mesh: Mesh) -> None:
    """iota_m = -6 chi - 2 p, p the pinches."""
    topology = mesh.topology
    assert mesh.irregularity.total == -6 * topology.euler_characteristic - 2 * topology.n_pinches


def assert_is_mesh_file(mesh_file: MeshFile) -> None:
    """The mesh is one, data have its rows, boundaries its indices."""
    mesh = mesh_file.mesh
    assert_is_mesh(mesh)
    assert all(len(values) == mesh.n_points for values in mesh_file.point_data.values())
    assert all(len(values) == mesh.n_triangles for values in mesh_file.cell_data.values())
    for boundary in mesh_file.boundaries:
        assert ((boundary.nodes >= 0) & (boundary.nodes < mesh.n_points)).all()
        for array in (boundary.partners, boundary.columns):
            assert array is None or len(array) == boundary.n_nodes


def assert_is_segmentation(regions: Regions) -> None:
    """Every triangle in exactly one region, regions edge-connected, sums of the parts those of the whole."""
    mesh = regions.size.mesh
    label = regions.label
    assert label.shape == (mesh.n_triangles,)
    assert [region.id for region in regions] == list(range(len(regions)))
    assert np.array_equal(np.concatenate([r.triangles for r in regions]), np.argsort(label, kind="stable"))
    pairs = [(a, b) for a, b in mesh.topology.neighbours.tolist() if label[a] == label[b]]
    n_components = len(reference.components(set(range(mesh.n_triangles)), pairs))
    assert n_components == len(regions) == len(np.unique(label))
    assert sum(r.weight for r in regions) == pytest.approx(regions.size.expected_triangles)
    assert sum(r.area for r in regions) == pytest.approx(mesh.area)
    for region in regions:
        assert region.kind in {"transition", "uniform"}
        assert 0 < region.h_min <= region.h_max
        assert region.q_min == mesh.qualities[region.triangles].min()
        assert_is_profile(region.profile)


def assert_is_profile(profile: Profile) -> None:
    """Stations ordered from the fine to the coarse end, everything positive and finite."""
    for name in ("depths", "counts", "levels", "lengths", "positions"):
        values = getattr(profile, name)
        assert np.isfinite(values).all(), name
        assert len(values) == len(profile.depths) >= 3
    assert profile.depths[0] == profile.positions[0] == 0
    assert (np.diff(profile.depths) > 0).all()
    assert (np.diff(profile.positions) >= 0).all()
    assert (np.diff(profile.levels) > 0).all()
    assert (profile.counts > 0).all()
    assert (profile.lengths > 0).all()
    assert profile.fronts == profile.layers + 1


def assert_is_plan(plan: Plan) -> None:
    """One plan a region, the chosen pattern among its candidates, totals that are sums."""
    assert len(plan.region_plans) == len(plan.regions)
    for part, region in zip(plan.region_plans, plan.regions, strict=True):
        assert part.region is region
        assert (part.chosen is None) == (region.kind == "uniform")
        assert part.n_blocks >= 1
        assert part.planned_triangles == part.n_blocks * plan.tris_per_block
        if part.chosen is None:
            assert part.candidates == ()
            continue
        assert part.chosen in part.candidates
        counts = part.chosen.pattern.counts
        assert part.chosen.n_blocks == sum(counts) + sum(counts[1:-1])
        assert len(part.profile) == len(counts)
        assert part.chosen.rejected is None or all(c.rejected for c in part.candidates)
        is_rejected = [c.rejected is not None for c in part.candidates]
        assert is_rejected == sorted(is_rejected)
        for candidate in part.candidates:
            assert candidate.pattern.is_closed == region.is_closed
            assert candidate.rejected or 0 < candidate.q_min <= 1 + 1e-9
            if candidate.spacing.is_straight:  # walls that converge take up irregularity in their corners
                assert candidate.q_min <= candidate.bounds.q_bound + 1e-9 <= 1 + 1e-9
    assert plan.n_blocks == sum(p.n_blocks for p in plan.region_plans)
    assert plan.planned_triangles == sum(p.planned_triangles for p in plan.region_plans)
    assert plan.irregularity.positive == sum(p.irregularity.positive for p in plan.region_plans)
    assert plan.irregularity.negative == sum(p.irregularity.negative for p in plan.region_plans)


def plan_key(plan: Plan) -> tuple[list[tuple[str, int, int, tuple[int, ...]]], list[float]]:
    """Return what two plans of one mesh share: counts, compared exactly, and ratios, compared as floats."""
    parts = plan.region_plans
    counts = [
        (p.region.kind, p.region.n_triangles, p.n_blocks, p.chosen.pattern.counts if p.chosen else ())
        for p in parts
    ]
    ratios = [plan.regions.size.expected_triangles, *(p.region.h_max / p.region.h_min for p in parts)]
    return counts, [*ratios, *(p.chosen.q_min for p in parts if p.chosen)]


def assert_is_graft(result: Replacement) -> None:
    """A mesh of positive triangles over the same area; what was not replaced and every rim bit for bit."""
    old, new, graft = result.size.mesh, result.mesh, result.graft
    assert_is_mesh(new)
    assert_identity_holds(new)
    assert (signed_areas(new.points, new.triangles) > 0).all()
    assert new.area == pytest.approx(old.area, rel=1e-12)
    stays = graft.new_index >= 0
    assert np.array_equal(new.points[graft.new_index[stays]], old.points[stays])
    outside = graft.source[: graft.n_outside]
    assert np.array_equal(new.triangles[: graft.n_outside], graft.new_index[old.triangles[outside]])
    assert set(np.flatnonzero(result.label < 0).tolist()) <= set(outside.tolist())
    rims = [
        np.sort(numbers[mesh.topology.edges[mesh.topology.is_boundary_edge]], axis=1)
        for mesh, numbers in ((old, graft.new_index), (new, np.arange(new.n_points)))
    ]
    assert set(map(tuple, rims[0].tolist())) == set(map(tuple, rims[1].tolist()))
    assert np.allclose(graft.shares.sum(axis=1), 1.0)
    assert (graft.shares >= 0).all()


def assert_is_replacement(result: Replacement) -> None:
    """A graft; no part has more irregular vertices or less quality than allowed."""
    assert_is_graft(result)
    for part in result.parts:
        assert part.after.irregular_interior <= part.before.irregular_interior
        assert part.after.q_min >= part.before.q_min - QUALITY_LOSS
    before, after = result.totals()
    assert after.irregular_interior <= before.irregular_interior
