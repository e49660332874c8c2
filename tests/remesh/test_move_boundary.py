"""A boundary that moves: points on the old line, corners and ends kept, the file's lists carried along."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from predicates import assert_identity_holds, assert_is_mesh
from strategies import jittered
from strategies import meshes as random_meshes

import bsgplan
from bsgplan.arrays import Floats
from bsgplan.cli import main
from bsgplan.io import Boundary, MeshFile
from bsgplan.laid_out.shifted import free_edges, shifted
from bsgplan.mesh import Mesh
from bsgplan.mesh.edges import edge_numbers
from bsgplan.remesh.replace import replace
from bsgplan.remesh.replacement import Replacement
from bsgplan.replace_pipeline import replace_in
from bsgplan.sizing import size_field

CASES = Path(__file__).resolve().parents[2] / "cases"


def moved(mesh: Mesh, boundaries: tuple[Boundary, ...] = (), **options: object) -> Replacement:
    free, fixed = free_edges(mesh, boundaries)
    label = np.zeros(mesh.n_triangles, np.int64)
    return replace(size_field(mesh), label=label, fixed_points=fixed, free_edges=free, **options)  # type: ignore[arg-type]


def rim(mesh: Mesh) -> Floats:
    return mesh.points[mesh.topology.edges[mesh.topology.is_boundary_edge]]


def assert_on_line(old: Mesh, new: Mesh) -> None:
    """Boundary points of the new mesh lie on the boundary of the old one."""
    line = shapely.multilinestrings(shapely.linestrings(rim(old)))
    off = shapely.distance(shapely.points(rim(new).reshape(-1, 2)), line)
    assert off.max() <= 1e-9 * np.ptp(old.points)


def assert_carried(before: MeshFile, after: MeshFile) -> None:
    """Every list is edges of the boundary, its ends where they were, about as long as it was."""
    for old, new in zip(before.boundaries, after.boundaries, strict=True):
        edge = edge_numbers(after.mesh, new.segments)
        assert (edge >= 0).all()
        assert after.mesh.topology.is_boundary_edge[edge].all()
        assert (old.kind, old.code, old.name) == (new.kind, new.code, new.name)
        lengths = [
            np.linalg.norm(np.diff(mesh.points[b.segments], axis=1), axis=-1).sum()
            for mesh, b in ((before.mesh, old), (after.mesh, new))
        ]
        assert lengths[1] == pytest.approx(lengths[0], rel=0.03)
        if old.edges is None:
            ends = [mesh.points[b.nodes[[0, -1]]] for mesh, b in ((before.mesh, old), (after.mesh, new))]
            assert np.array_equal(*ends)


def test_points_of_a_square_slide_along_its_sides_and_its_corners_stay() -> None:
    mesh = jittered(20, 20, 5)
    result = moved(mesh)
    still = replace(size_field(mesh), label=np.zeros(mesh.n_triangles, np.int64))
    assert_is_mesh(result.mesh)
    assert_identity_holds(result.mesh)
    assert result.mesh.area == pytest.approx(mesh.area, rel=1e-12)
    assert_on_line(mesh, result.mesh)
    corners = [{p.tobytes() for p in m.points} for m in (mesh, result.mesh)]
    assert {p.tobytes() for p in np.array([[0.0, 0], [19, 0], [19, 19], [0, 19]])} <= corners[0] & corners[1]
    own = {p.tobytes() for p in mesh.points[mesh.topology.is_boundary]}
    assert own - corners[1]  # some slid
    left = [
        r.totals()[1].irregular_boundary_fitted + r.totals()[1].irregular_interior for r in (still, result)
    ]
    assert left[1] <= left[0]


@given(mesh=random_meshes(), seed=st.integers(0, 999))
@settings(max_examples=20)
def test_whatever_the_mesh_the_loops_stay_loops(mesh: Mesh, seed: int) -> None:
    """A set of all boundary points becomes that of the new mesh; the Euler characteristic is the same."""
    whole = Boundary("named", np.flatnonzero(mesh.topology.is_boundary), 7, "all")
    result = moved(mesh, (whole,), effort=2, seed=seed)
    assert_is_mesh(result.mesh)
    assert_on_line(mesh, result.mesh)
    assert result.mesh.topology.euler_characteristic == mesh.topology.euler_characteristic
    (carried,) = shifted(mesh, result.mesh, result.graft.new_index, (whole,))
    assert np.array_equal(np.sort(carried.nodes), np.flatnonzero(result.mesh.topology.is_boundary))


def test_lists_on_a_mesh_that_did_not_change_are_what_they_were() -> None:
    mesh = jittered(5, 5, 1)
    by_place = {tuple(p): k for k, p in enumerate(np.rint(mesh.points).tolist())}
    bottom = np.array([by_place[x, 0.0] for x in range(5)])
    depth = np.arange(5.0)[:, None]
    lists = (
        Boundary("open", bottom, columns=depth),
        Boundary("land", bottom[::-1], 20),
        Boundary("named", bottom, 3, "bottom", edges=np.column_stack([bottom[:-1], bottom[1:]])),
    )
    found = shifted(mesh, mesh, np.arange(mesh.n_points), lists)
    assert [b.nodes.tolist() for b in found[:2]] == [bottom.tolist(), bottom[::-1].tolist()]
    assert np.array_equal(found[0].columns, depth)
    assert found[2].edges is not None
    assert {tuple(sorted(e)) for e in found[2].edges.tolist()} == {
        tuple(sorted(e)) for e in zip(bottom[:-1].tolist(), bottom[1:].tolist(), strict=True)
    }


def test_numbers_at_the_nodes_of_a_list_are_interpolated_by_length() -> None:
    """One point of five gone: the numbers of the others as they were, ends kept."""
    mesh = jittered(12, 12, 4)
    y = np.isclose(mesh.points[:, 1], 0.0)
    nodes = np.flatnonzero(y)[np.argsort(mesh.points[y, 0])]
    listed = Boundary("land", nodes, 3, columns=mesh.points[nodes, :1] * [2.0])
    result = moved(mesh, (listed,))
    (carried,) = shifted(mesh, result.mesh, result.graft.new_index, (listed,))
    assert carried.columns is not None
    np.testing.assert_allclose(carried.columns[:, 0], 2 * result.mesh.points[carried.nodes, 0], atol=1e-9)
    assert not np.array_equal(result.mesh.points[carried.nodes], mesh.points[nodes])


@pytest.mark.parametrize("name", ["bahamas_bight_of_abaco.fort.14"])
def test_a_real_coast_keeps_its_line_and_its_lists(meshes: Path, name: str) -> None:
    mesh_file = bsgplan.read(meshes / name)
    result = replace_in(mesh_file, move_boundary=True)
    before, after = result.replacement.totals()
    assert after.irregular_interior < 0.4 * before.irregular_interior
    assert after.q_min >= before.q_min - 0.02
    assert_on_line(mesh_file.mesh, result.after.mesh)
    assert_carried(mesh_file, result.after)
    assert result.after.mesh.area == pytest.approx(mesh_file.mesh.area, rel=0.01)
    n = [sum(b.n_nodes for b in f.boundaries if b.kind == "land") for f in (mesh_file, result.after)]
    assert n[1] != n[0] or not np.array_equal(rim(mesh_file.mesh), rim(result.after.mesh))


def test_the_command_moves_the_boundary_inside_the_region_only(tmp_path: Path) -> None:
    case = CASES / "transition" / "mesh.msh"
    out = tmp_path / "r.msh"
    words = ["--region", "0.3,0,0.96,1", "--move-boundary", "--effort", "15", "-o", str(out)]
    assert main(["replace", str(case), *words]) == 0
    before, after = bsgplan.read(case), bsgplan.read(out)
    assert_on_line(before.mesh, after.mesh)
    assert_carried(before, after)
    centre = before.mesh.centroids
    outside = ~((centre[:, 0] > 0.3) & (centre[:, 0] < 0.96))
    old = {p.tobytes() for p in before.mesh.points[before.mesh.triangles[outside]].reshape(-1, 2)}
    assert old <= {p.tobytes() for p in after.mesh.points}


def test_a_mesh_with_quads_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "q.vtu"
    import meshio

    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0]])
    meshio.write(path, meshio.Mesh(points, [("quad", [[0, 1, 2, 3]]), ("triangle", [[1, 4, 2]])]))
    assert main(["replace", str(path), "--move-boundary"]) == 2
    assert "--split-quads" in capsys.readouterr().err
