"""Plans made on a thinned mesh: near those made on every triangle, and told of the whole mesh."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bsgplan import plan_blocks, read, sized
from bsgplan.cli import main
from bsgplan.sized import sizes_to_plan
from tests.predicates import assert_is_plan, assert_is_segmentation

CASES = Path(__file__).resolve().parent.parent / "cases"
COUNTS = ("blocks_gradient_limited", "blocks_boundary_limited")


@pytest.fixture
def every_mesh_is_large(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sized, "LARGE", 1)


@pytest.mark.usefixtures("every_mesh_is_large")
@pytest.mark.parametrize(
    "name", ["annulus", "aerofoil", "islands", "plate", "rectangle", "shoreline", "square"]
)
def test_a_case_gets_nearly_the_plan_of_every_triangle(name: str) -> None:
    """Blocks to 5 %, about the noise of front counts; the drivers, which have no patterns, to 5 % as well."""
    mesh_file = read(CASES / name / "mesh.msh")
    thin, whole = (plan_blocks(mesh_file, every_triangle=every) for every in (False, True))
    assert thin.planned_on < whole.planned_on / 3 < thin.planned_on * 2
    assert_is_plan(thin.plan)
    assert_is_segmentation(thin.plan.regions)
    assert thin.plan.n_blocks == pytest.approx(whole.plan.n_blocks, rel=0.05)
    for count in COUNTS:
        assert getattr(thin.plan.drivers, count) == pytest.approx(
            getattr(whole.plan.drivers, count), rel=0.05
        )


@pytest.mark.usefixtures("every_mesh_is_large")
@pytest.mark.parametrize(
    "name",
    [
        "three_point_bending_test.msh",
        "columbia_plume_02_normal.msh",
        "mesh_NACA0012_inv.su2",
        "north_sea.msh",
    ],
)
def test_a_real_mesh_gets_nearly_the_plan_of_every_triangle(meshes: Path, name: str) -> None:
    mesh_file = read(meshes / name)
    thin, whole = (plan_blocks(mesh_file, every_triangle=every).plan for every in (False, True))
    assert thin.n_blocks == pytest.approx(whole.n_blocks, rel=0.06)
    for count in COUNTS:
        assert getattr(thin.drivers, count) == pytest.approx(getattr(whole.drivers, count), rel=0.05)


@pytest.mark.usefixtures("every_mesh_is_large")
def test_regions_and_sizes_are_those_of_the_whole_mesh() -> None:
    mesh_file = read(CASES / "rectangle" / "mesh.msh")
    regions = plan_blocks(mesh_file).plan.regions
    assert regions.size.mesh is mesh_file.mesh
    assert sum(r.n_triangles for r in regions) == mesh_file.mesh.n_triangles
    assert min(r.q_min for r in regions) == mesh_file.mesh.qualities.min()
    assert regions.size.expected_triangles == pytest.approx(mesh_file.mesh.n_triangles)
    assert np.array_equal(np.unique(regions.label), np.arange(len(regions)))


def test_small_meshes_and_small_blocks_are_planned_on_every_triangle(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh_file = read(CASES / "square" / "mesh.msh")
    n_triangles = mesh_file.mesh.n_triangles

    def is_thinned(**options: Any) -> bool:
        field, thin = sizes_to_plan(mesh_file, **options)
        assert field.mesh is (mesh_file.mesh if thin is None else thin.mesh)
        return thin is not None

    assert not is_thinned()
    monkeypatch.setattr(sized, "LARGE", n_triangles)
    assert is_thinned()
    assert not is_thinned(tris_per_block=(4, 16))
    assert not is_thinned(n_blocks=n_triangles // 4)
    assert is_thinned(n_blocks=20)


@pytest.mark.usefixtures("every_mesh_is_large")
def test_blocks_are_measured_by_the_triangles_of_the_mesh_where_sizes_are_given() -> None:
    """Sizes of half an edge: 16 of them are 4 triangles; sizes of two edges: 4 of them are 16."""
    mesh_file = read(CASES / "square" / "mesh.msh")
    edge = np.median(mesh_file.mesh.edge_lengths)
    for factor, tris_per_block, is_thinned in (
        (0.5, 16, False),
        (0.5, 64, True),
        (2.2, 4, True),
        (2.2, 1, False),
    ):
        sized = replace(mesh_file, point_data={"h": np.full(mesh_file.mesh.n_points, factor * edge)})
        _, thin = sizes_to_plan(sized, "h", tris_per_block=tris_per_block)
        assert (thin is not None) == is_thinned


@pytest.mark.usefixtures("every_mesh_is_large")
def test_a_drawn_region_and_named_sizes_are_planned_on_a_thinned_mesh_too(tmp_path: Path) -> None:
    mesh_file = read(CASES / "rectangle" / "mesh.msh")
    from shapely import box

    x0, x1, y0, y1 = mesh_file.mesh.bounds
    drawn = plan_blocks(mesh_file, region=box(x0, y0, x1, (y0 + y1) / 2))
    assert drawn.planned_on < drawn.mesh_file.mesh.n_triangles
    assert_is_plan(drawn.plan)


@pytest.mark.usefixtures("every_mesh_is_large")
def test_the_report_says_what_was_planned_on(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["estimate", str(CASES / "square" / "mesh.msh")]
    assert main(words) == 0
    assert "of 2036 triangles, thinned where edges stay short; --every-triangle" in capsys.readouterr().out
    assert main([*words, "--tris-per-block", "16,64"]) == 0
    assert "--every-triangle" in capsys.readouterr().out
    assert main([*words, "--every-triangle"]) == 0
    assert "thinned" not in capsys.readouterr().out
    assert main([*words, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["size_field"]["planned_on_triangles"]
    assert 300 < found < 800


@pytest.mark.usefixtures("every_mesh_is_large")
def test_pictures_and_files_show_the_whole_mesh(tmp_path: Path) -> None:
    import pyvista

    mesh_file = read(CASES / "rectangle" / "mesh.msh")
    planned = plan_blocks(mesh_file)
    planned.write_vtk(tmp_path / "plan.vtu")
    planned.figure(tmp_path / "plan.png")
    written = pyvista.read(tmp_path / "plan.vtu")
    n_triangles = int((written.celltypes == pyvista.CellType.TRIANGLE).sum())
    assert n_triangles == mesh_file.mesh.n_triangles
