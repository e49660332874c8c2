"""Plans and patterns as VTK: what is written is read back by meshio and by pyvista, or nothing is there."""

from __future__ import annotations

import errno
from pathlib import Path

import meshio
import numpy as np
import pytest
import pyvista

from bsgplan.errors import InvalidOption, OutputError
from bsgplan.io import MeshFile, read, read_lonlat
from bsgplan.io.vtk import plan_front_lines, write_patterns, write_plan
from bsgplan.planning import Plan, estimate
from bsgplan.regions import find_regions
from bsgplan.sizing import size_field

CASES = Path(__file__).parents[2] / "cases"


def plan_of(mesh_file: MeshFile, n: int = 16) -> Plan:
    return estimate(find_regions(size_field(mesh_file.mesh), tris_per_block=n), tris_per_block=n)


@pytest.fixture(scope="module", params=["rectangle", "annulus", "plate"])
def plan(request: pytest.FixtureRequest) -> Plan:
    return plan_of(read(CASES / request.param / "mesh.msh"))


@pytest.fixture(scope="module")
def uniform() -> Plan:
    return plan_of(read(CASES / "square" / "mesh.msh"))


@pytest.mark.parametrize("suffix", [".vtu", ".vtk"])
def test_a_plan_is_read_back_by_meshio_and_pyvista(plan: Plan, tmp_path: Path, suffix: str):
    path = tmp_path / f"plan{suffix}"
    write_plan(path, plan)
    mesh, lines = plan.regions.size.mesh, plan_front_lines(plan)
    grid, told = pyvista.read(path), meshio.read(path)
    assert {block.type: len(block.data) for block in told.cells} == {
        "triangle": mesh.n_triangles,
        "line": len(lines.region),
    }
    assert grid.n_cells == mesh.n_triangles + len(lines.region)
    names = {"region", "kind", "pattern", "level", "quality", "size", "front_coordinate"}
    assert set(told.cell_data) == set(grid.cell_data.keys()) == names
    assert set(told.point_data) == set(grid.point_data.keys()) == {"size", "charge", "front_coordinate"}
    for name in names:
        assert np.array_equal(np.concatenate(told.cell_data[name]), grid.cell_data[name])
    assert grid.point_data["charge"].sum() == pytest.approx(plan.drivers.charge)
    assert np.array_equal(grid.points[: mesh.n_points, :2], mesh.points)
    assert list(tmp_path.iterdir()) == [path]


def test_the_arrays_of_a_plan_say_what_they_should(plan: Plan, tmp_path: Path):
    write_plan(tmp_path / "plan.vtu", plan)
    told = meshio.read(tmp_path / "plan.vtu")
    (region, line_region), (kind, line_kind) = told.cell_data["region"], told.cell_data["kind"]
    assert np.array_equal(region, plan.regions.label)
    assert np.issubdtype(region.dtype, np.integer)
    is_transition = np.array([r.kind == "transition" for r in plan.regions])
    assert np.array_equal(kind, is_transition[region].astype(int))
    assert (line_kind == 2).all()
    assert is_transition[line_region].all()
    level, line_level = told.cell_data["level"]
    assert (level == -1).all()
    for region_plan in plan.region_plans:
        if region_plan.chosen is not None:
            own = np.unique(line_level[line_region == region_plan.region.id])
            assert set(own) <= set(range(region_plan.chosen.pattern.n_fronts))
            assert set(range(1, region_plan.chosen.pattern.n_layers)) <= set(own)
    assert np.array_equal(told.cell_data["quality"][0], plan.regions.size.mesh.qualities)
    assert np.array_equal(told.cell_data["size"][0], plan.regions.size.triangle_h)


def test_a_projected_plan_is_written_in_degrees_and_true_metres(tmp_path: Path):
    degrees, mesh_file = (open_(CASES / "rectangle" / "mesh.msh") for open_ in (read, read_lonlat))
    plan = plan_of(mesh_file)
    write_plan(tmp_path / "plan.vtu", plan, mesh_file.projection)
    told = pyvista.read(tmp_path / "plan.vtu")
    mesh = mesh_file.mesh
    assert told.points[: mesh.n_points, :2] == pytest.approx(degrees.mesh.points, abs=1e-9)
    assert told.bounds[1] == pytest.approx(2.96, abs=1e-6)
    scale = mesh_file.projection.scale(mesh.points)
    assert told.point_data["size"][: mesh.n_points] == pytest.approx(plan.regions.size.h / scale)


def test_patterns_are_their_blocks_subdivided(plan: Plan, tmp_path: Path):
    write_patterns(tmp_path / "patterns.vtu", plan)
    told, grid = meshio.read(tmp_path / "patterns.vtu"), pyvista.read(tmp_path / "patterns.vtu")
    planned = [p for p in plan.region_plans if p.chosen is not None]
    data = {name: values[0] for name, values in told.cell_data.items()}
    assert set(data) == set(grid.cell_data.keys()) == {"region", "block", "level", "quality"}
    blocks, counts = np.unique(data["block"], return_counts=True)
    assert blocks.tolist() == list(range(sum(p.n_blocks for p in planned)))
    assert (counts == plan.tris_per_block).all()
    assert data["quality"].min() == pytest.approx(plan.q_min)
    for p in planned:
        own = data["region"] == p.region.id
        assert len(np.unique(data["block"][own])) == p.n_blocks
        assert set(np.unique(data["level"][own])) == set(range(p.chosen.pattern.n_layers))
    a, b, c = told.points[told.cells[0].data].swapaxes(0, 1)
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()


def test_patterns_stand_apart(plan: Plan, tmp_path: Path):
    write_patterns(tmp_path / "patterns.vtu", plan)
    told = meshio.read(tmp_path / "patterns.vtu")
    region, corners = told.cell_data["region"][0], told.points[told.cells[0].data][..., :2]
    boxes = [
        (corners[region == k].min(axis=(0, 1)), corners[region == k].max(axis=(0, 1)))
        for k in np.unique(region)
    ]
    for i, (low, high) in enumerate(boxes):
        for other_low, other_high in boxes[:i]:
            assert (low > other_high).any() or (other_low > high).any()


def test_a_plan_without_patterns_is_a_plan_too(uniform: Plan, tmp_path: Path, caplog):
    write_plan(tmp_path / "plan.vtu", uniform)
    assert pyvista.read(tmp_path / "plan.vtu").n_cells == uniform.regions.size.mesh.n_triangles
    for suffix in (".vtu", ".vtk"):
        write_patterns(tmp_path / f"patterns{suffix}", uniform)
        assert pyvista.read(tmp_path / f"patterns{suffix}").n_cells == 0
    assert "no region has a pattern" in caplog.text


@pytest.mark.parametrize("write", [write_plan, write_patterns])
def test_another_suffix_is_wrong_usage(uniform: Plan, tmp_path: Path, write):
    with pytest.raises(InvalidOption, match=r"plan\.png: suffix '\.png' .* \.vtu or \.vtk"):
        write(tmp_path / "plan.png", uniform)


@pytest.mark.parametrize("write", [write_plan, write_patterns])
def test_a_missing_folder_is_told_in_one_line(uniform: Plan, tmp_path: Path, write):
    with pytest.raises(OutputError, match=r"plan\.vtu: cannot be written \(No such file") as told:
        write(tmp_path / "nowhere" / "plan.vtu", uniform)
    assert "\n" not in str(told.value)


def test_a_write_that_fails_leaves_the_old_file(uniform: Plan, tmp_path: Path, monkeypatch):
    def full(path: Path, *_: object, **__: object) -> None:
        Path(path).write_bytes(b"half")
        raise OSError(errno.ENOSPC, "No space left on device")

    path = tmp_path / "plan.vtu"
    path.write_text("old")
    monkeypatch.setattr(meshio, "write", full)
    with pytest.raises(OutputError, match="No space left"):
        write_plan(path, uniform)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
