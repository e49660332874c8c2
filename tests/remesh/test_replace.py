"""Replacements: the outside bit for bit, positive triangles, far fewer irregular vertices, idempotent."""

import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from predicates import assert_is_graft, assert_is_replacement
from scipy.spatial import Delaunay
from strategies import jittered
from strategies import meshes as random_meshes

import bsgplan
from bsgplan.mesh import Mesh, clean
from bsgplan.remesh.accept import Terms, refusal
from bsgplan.remesh.anneal import remeshed
from bsgplan.remesh.cut import cut
from bsgplan.remesh.graft import graft
from bsgplan.remesh.measures import Measures, measured
from bsgplan.remesh.replace import replace
from bsgplan.remesh.replacement import Part, Replacement
from bsgplan.remesh.wish import Wish
from bsgplan.sizing import size_field


def whole(mesh: Mesh, **options: object) -> Replacement:
    return replace(size_field(mesh), label=np.zeros(mesh.n_triangles, np.int64), **options)  # type: ignore[arg-type]


@given(mesh=random_meshes(), seed=st.integers(0, 2**32 - 1), share=st.sampled_from([0.5, 0.9, 1.0]))
@settings(max_examples=25)
def test_whatever_is_drawn_the_rest_stays(mesh: Mesh, seed: int, share: float) -> None:
    random = np.random.default_rng(seed)
    label = np.where(random.random(mesh.n_triangles) < share, 0, -1)
    label[0] = 0
    assert_is_replacement(replace(size_field(mesh), label=label, is_drawn=True, effort=3))


@given(mesh=random_meshes(), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=15)
def test_the_rim_stays_also_where_the_result_would_be_refused(mesh: Mesh, seed: int) -> None:
    size = size_field(mesh)
    inside = np.random.default_rng(seed).random(mesh.n_triangles) < 0.8
    inside[0] = True
    part = cut(mesh, inside)
    log_size = size.log_h[part.point] - np.log(part.domain.scale)
    n = len(part.triangle)
    wish = Wish(n * 1.5, 0.1, np.zeros(n, np.int64), np.zeros(n), np.zeros(n))
    placed = remeshed(part, log_size, wish, n_sweeps=2, seed=seed % 1000).mesh
    label = np.where(inside, 0, -1)
    result = Replacement(size, graft(mesh, [(part, placed)]), label, ())
    fewest = Replacement(size, graft(mesh, []), label, ())
    assert_is_graft(result)
    assert np.array_equal(fewest.mesh.triangles, mesh.triangles)


def test_a_jittered_square_loses_most_of_its_irregular_vertices() -> None:
    result = whole(jittered(24, 24, 5))
    before, after = result.totals()
    assert_is_replacement(result)
    assert after.irregular_interior <= 0.25 * before.irregular_interior
    assert after.q_min >= before.q_min


def test_the_same_seed_gives_the_same_mesh_and_a_second_run_leaves_it() -> None:
    mesh = jittered(16, 16, 8)
    first, again = whole(mesh), whole(mesh)
    assert (first.mesh.points == again.mesh.points).all()
    assert (first.mesh.triangles == again.mesh.triangles).all()
    second = whole(first.mesh)
    one, two = first.totals()[1], second.totals()[1]
    assert 0.95 * one.irregular_interior <= two.irregular_interior <= one.irregular_interior
    assert two.q_min >= one.q_min


def test_values_at_kept_points_are_exact_and_between_them_linear() -> None:
    mesh = jittered(14, 14, 2)
    graft = whole(mesh).graft
    linear = mesh.points @ np.array([[2.0, 0.5], [-1.0, 3.0]])
    found = graft.at_points(linear)
    kept = graft.new_index >= 0
    assert (found[graft.new_index[kept]] == linear[kept]).all()
    np.testing.assert_allclose(found, graft.mesh.points @ np.array([[2.0, 0.5], [-1.0, 3.0]]), atol=1e-9)


def test_materials_keep_their_areas_where_the_edges_between_them_are_fixed() -> None:
    mesh = jittered(15, 15, 4)
    material = (mesh.centroids[:, 0] > 7).astype(np.int64)
    pair = mesh.topology.edge_cells
    fixed = (pair[:, 1] >= 0) & (material[pair[:, 0]] != material[pair[:, 1]])
    result = whole(mesh, fixed_edges=fixed)
    assert not result.parts[0].reason
    new = result.graft.at_triangles(material)
    assert result.mesh.areas[new == 1].sum() == pytest.approx(mesh.areas[material == 1].sum(), rel=1e-12)


def test_only_regions_that_stand_in_the_way_are_left_out_and_tried_apart(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Refused for region 2 alone: once more without it, then it alone; nothing else is tried twice."""
    mesh = jittered(12, 12, 6)
    label = (mesh.centroids[:, 0] // 4).astype(np.int64)
    before = measured(mesh, np.zeros(mesh.n_points))
    seen: list[tuple[str, set[int], int]] = []

    def refused_once(task, inside, name, progress, *, n_like):
        seen.append((name, set(np.unique(label[inside]).tolist()), n_like))
        reason = "quality would fall in region 2" if len(seen) == 1 else ""
        offenders = (2,) if reason else ()
        return Part(name, before, before, reason, offenders=offenders, could_gain=bool(reason)), None

    monkeypatch.setattr(sys.modules["bsgplan.remesh.replace"], "attempt", refused_once)
    result = replace(size_field(mesh), label=label)
    n = mesh.n_triangles
    assert seen == [("mesh", {0, 1, 2}, n), ("mesh without region 2", {0, 1}, n), ("region 2", {2}, n)]
    assert [part.reason for part in result.parts] == ["quality would fall in region 2", "", ""]


def test_no_region_loses_more_than_allowed_on_a_mesh_of_good_and_poor_halves() -> None:
    """One half jittered much, the other little: the poor half's q_min is no licence for the good one."""
    rough, fine = jittered(20, 20, 3), jittered(20, 20, 3, jitter=0.08)
    points = np.where((rough.points[:, :1] < 9.5), rough.points, fine.points)
    mesh = clean(points, Delaunay(points).simplices.astype(np.int64)).mesh
    label = (mesh.centroids[:, 0] > 9.5).astype(np.int64)
    result = replace(size_field(mesh), label=label)
    for _, old, new in result.regions():
        assert new.q_min >= old.q_min - 0.02


BEFORE = measured(jittered(8, 8, 1), np.zeros(64))


@pytest.mark.parametrize(
    ("change", "terms", "word"),
    [
        ({}, Terms(), "irregular vertices would go"),
        ({"irregular_interior": 1, "q_min": BEFORE.q_min - 0.03}, Terms(), "would fall"),
        ({"irregular_interior": 1}, Terms(min_quality=0.99), "asked for"),
        ({"irregular_interior": 1, "n_triangles": 2 * BEFORE.n_triangles}, Terms(), "are wanted"),
        ({"irregular_interior": 1, "size_misfit": 1.2 * BEFORE.size_misfit}, Terms(), "misfit"),
        ({"irregular_interior": 1, "size_misfit": 1.2 * BEFORE.size_misfit}, Terms(tolerance=0.3), ""),
        ({"irregular_interior": 1, "irregular_boundary_fitted": 99}, Terms(), "irregular vertices would go"),
    ],
)
def test_each_reason_to_refuse(change: dict[str, float], terms: Terms, word: str) -> None:
    after = Measures(**{**vars(BEFORE), **change})
    reason = refusal(BEFORE, after, float(BEFORE.n_triangles), terms)
    assert word in reason
    assert bool(reason) == bool(word)


def test_a_regular_mesh_is_left_alone() -> None:
    x, y = np.meshgrid(np.arange(6.0), np.arange(6.0), indexing="ij")
    points = np.column_stack([(x + y / 2).ravel(), (y * np.sqrt(0.75)).ravel()])
    a = (np.arange(5)[:, None] * 6 + np.arange(5)).ravel()
    mesh = Mesh(
        points, np.concatenate([np.column_stack([a, a + 6, a + 1]), np.column_stack([a + 6, a + 7, a + 1])])
    )
    (part,) = whole(mesh).parts
    assert part.reason == "every vertex is regular"


@pytest.mark.parametrize(("name", "fewer"), [("bahamas_bight_of_abaco.fort.14", 0.6)])
def test_a_real_coast(meshes: Path, name: str, fewer: float) -> None:
    """Islands and an open boundary, every boundary point where it was."""
    mesh_file = bsgplan.read(meshes / name)
    result = whole(mesh_file.mesh)
    assert_is_replacement(result)
    before, after = result.totals()
    assert after.irregular_interior <= (1 - fewer) * before.irregular_interior
    assert after.q_min >= before.q_min - 0.02
    assert after.size_misfit <= before.size_misfit
    assert 0.9 <= after.n_triangles / before.n_triangles <= 1.1
    for boundary in mesh_file.boundaries:
        assert (result.graft.new_index[boundary.nodes] >= 0).all()
