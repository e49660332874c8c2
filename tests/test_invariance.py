"""A plan does not change when its mesh is moved, turned, scaled or laid into space."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from predicates import plan_key
from scipy.spatial.transform import Rotation
from strategies import hilly

import bsgplan
from bsgplan import sized
from bsgplan.io import MeshFile
from bsgplan.mesh import Mesh
from bsgplan.pipeline import plan_blocks
from bsgplan.planning import Plan, estimate
from bsgplan.regions import find_regions
from bsgplan.sizing import named_size_field

ROUNDING = 1e-5
"""Ratios of two plans agree to this: solvers stop at four digits, and stop alike but for the last ones."""

REAL = (
    "bahamas_bight_of_abaco.fort.14",
    "mesh_NACA0012_inv.su2",
    "osteonT1_11.mesh",
    "bunny_adaptive.off",
    "helmholtz_apartment.vtk",
    "oracle/jigsaw_piece.msh.vtu",
)


def moved(mesh_file: MeshFile, points: np.ndarray) -> MeshFile:
    """The same file with its points somewhere else."""
    return replace(mesh_file, mesh=Mesh(points, mesh_file.mesh.triangles))


def assert_is_same(one: Plan, other: Plan) -> None:
    """Counts are equal, ratios to `ROUNDING`."""
    (counts, ratios), (other_counts, other_ratios) = plan_key(one), plan_key(other)
    assert counts == other_counts
    assert ratios == pytest.approx(other_ratios, rel=ROUNDING)


def similar(points: np.ndarray, h: float) -> dict[str, np.ndarray]:
    """Return the points turned and tiny, at UTM coordinates with edges of a metre, huge and in space."""
    dimension = points.shape[1]
    turn = Rotation.from_rotvec([0.3, 0.5, 0.7]).as_matrix()
    angle = 0.7123
    flat_turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    far = np.array([5e5, 5e6, 0.0])[:dimension]
    return {
        "tiny": points @ (flat_turn if dimension == 2 else turn).T * 1e-8,
        "far": (points - points.mean(axis=0)) / h + far,
        "huge": np.column_stack([points, np.zeros((len(points), 3 - dimension))]) @ turn * 1e8,
    }


@pytest.mark.parametrize("name", REAL)
def test_real_meshes_keep_their_plans(meshes, name):
    mesh_file = bsgplan.read(meshes / name)
    mesh = mesh_file.mesh
    plan = plan_blocks(mesh_file).plan
    for points in similar(mesh.points, float(np.median(mesh.edge_lengths))).values():
        assert_is_same(plan_blocks(moved(mesh_file, points)).plan, plan)


@pytest.mark.parametrize("name", REAL[:3])
def test_real_meshes_keep_their_plans_where_they_are_thinned(meshes, name, monkeypatch):
    monkeypatch.setattr(sized, "LARGE", 1)
    mesh_file = bsgplan.read(meshes / name)
    mesh = mesh_file.mesh
    result = plan_blocks(mesh_file)
    assert result.planned_on < mesh.n_triangles / 2
    places = similar(mesh.points, float(np.median(mesh.edge_lengths)))
    for where in ("tiny", "far"):
        assert_is_same(plan_blocks(moved(mesh_file, places[where])).plan, result.plan)


@settings(max_examples=10)
@given(
    hilly(),
    st.floats(-8, 8),
    st.floats(0, 2 * np.pi),
    st.tuples(st.floats(-1e5, 1e5), st.floats(-1e5, 1e5)),
)
def test_any_similar_mesh_has_the_same_plan(case, log_scale, angle, shift):
    mesh, log_h = case
    plan = planned(mesh, np.exp(log_h))
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    scale = 10.0**log_scale
    points = scale * (mesh.points @ turn.T + shift)
    assert_is_same(planned(Mesh(points, mesh.triangles), scale * np.exp(log_h)), plan)


def planned(mesh: Mesh, h: np.ndarray) -> Plan:
    """Return the plan of sizes on a mesh, with few triangles a block."""
    field = named_size_field(mesh, h, "h")
    return estimate(find_regions(field, tris_per_block=4), tris_per_block=4)
