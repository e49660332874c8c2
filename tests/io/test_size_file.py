"""Size files: each format by hand and through the command line, the mistakes in them, degrees."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest

import bsgplan
from bsgplan.cli import main
from bsgplan.errors import InvalidSize, MeshReadError
from bsgplan.io.size_file import sizes_from
from bsgplan.io.size_pos import read_pos
from bsgplan.io.size_sol import isotropic
from bsgplan.sized import size_of

PLATE = "cases/plate/mesh.msh"
SQUARE = "a square\n2 4\n1 0 0 1\n2 1 0 1\n3 1 1 1\n4 0 1 1\n1 3 1 2 3\n2 3 1 3 4\n"
"""A fort.14 file of the unit square."""
TWO_STEPS = """// a comment, "View" in it
View "h" {
  TIME {0, 1};
  ST(0,0,0, 1,0,0, 1,1,0){0.1,0.2,0.2, 9,9,9};
  ST(0,0,0, 1,1,0, 0,1,0){0.1,0.2,0.1, 9,9,9};
  VT(0,0,0, 1,1,0, 0,1,0){1,1,1,1,1,1,1,1,1};
};
"""


@pytest.fixture
def square(tmp_path):
    (tmp_path / "square.14").write_text(SQUARE)
    return bsgplan.read(tmp_path / "square.14")


def sizes(mesh_file, text: str, name: str | None = None, suffix: str = ".pos") -> list[float]:
    path = Path(mesh_file.path).with_suffix(suffix)
    path.write_text(text)
    return sizes_from(path, mesh_file, name=name).round(9).tolist()


def test_the_first_time_step_of_scalar_triangles(square):
    assert sizes(square, TWO_STEPS) == [0.1, 0.2, 0.2, 0.1]


def test_quadrilaterals_points_and_lines(square):
    assert sizes(square, 'View "h" {SQ(0,0,0,1,0,0,1,1,0,0,1,0){1,2,3,4};};') == [1, 2, 3, 4]
    assert sizes(square, 'View "h" {SL(0,0,0,1,0,0){1,2};SP(1,1,0){3}; SP(0,1,0){4};};') == [1, 2, 3, 4]
    second = 'View "h" {ST2(0,0,0,2,0,0,0,2,0,1,0,0,1,1,0,0,1,0){1,1,1,7,7,7};};'
    assert sizes(square, second) == [1, 1, 1, 1]


def test_one_of_several_views_is_chosen_by_name(square):
    one = 'View "a" {SQ(0,0,0,1,0,0,1,1,0,0,1,0){1,1,1,1};};'
    two = one + "\n" + one.replace('"a"', '"b"').replace("1,1,1,1", "2,2,2,2")
    assert sizes(square, two, "b") == [2, 2, 2, 2]
    with pytest.raises(MeshReadError, match="2 views, a, b; choose one with --size"):
        sizes(square, two)
    with pytest.raises(MeshReadError, match=r"no view 'c' .* a, b"):
        sizes(square, two, "c")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('View "h" {ST(0,0,0,1,0,0,1,1,0){1,x,3};};', "ST with values '1,x,3'"),
        ('View "h" {ST(0,0,0,1,0,0,1,1){1,2,3};};', "ST with coordinates"),
        ('View "h" {ST(0, ,0,1,0,0,1,1,0){1,2,3};};', "ST with coordinates '0, ,0,1"),
        ('View "h" {ST(0,0,0,1,0,0,1,1,0){1,2};};', "ST with values '1,2'"),
        ('View "h" {ST(0,0,0,1,0,0,1,1,0){1,2,3}; ST(0,0,0,1,', "between the elements"),
        ('View "h" {VT(0,0,0,1,0,0,1,1,0){1,2,3,1,2,3,1,2,3};};', "holds VT; give scalars"),
        ('View "h" {};', "holds nothing"),
        ('View "h" {SP(0,0,0){1};SP(1,0,0){1};SP(2,0,0){1};};', "span no area"),
        ('View "h" {SP(0,0,0){1};SP(1,0,5){1};SP(2,1,0){1};};', "lie in space"),
        ("$PostFormat\n1.4 0 8\n$EndPostFormat\n", "legacy .pos"),
    ],
)
def test_a_view_that_cannot_be_read_is_refused_with_the_place(square, text, message):
    with pytest.raises(MeshReadError, match=message):
        sizes(square, text)


def test_what_gmsh_writes_is_read(square, tmp_path):
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        view = gmsh.view.add("wanted")
        data = [0, 1, 1, 0, 0, 1, 0, 0, 0, 0.1, 0.2, 0.3, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0.1, 0.3, 0.4]
        gmsh.view.addListData(view, "ST", 2, data)
        gmsh.view.write(view, str(tmp_path / "gmsh.pos"))
    finally:
        gmsh.finalize()
    assert sizes_from(tmp_path / "gmsh.pos", square).round(9).tolist() == [0.1, 0.2, 0.3, 0.4]


SOL = "MeshVersionFormatted 2\nDimension 2\n# by hand\nSolAtVertices\n4\n{types}\n{values}\nEnd\n"


def test_a_scalar_solution_and_one_behind_a_vector(square):
    text = SOL.format(types="1 1", values="1\n2\n3\n4")
    assert sizes(square, text, suffix=".sol") == [1, 2, 3, 4]
    text = SOL.format(types="2 2 1", values="0 0 1\n0 0 2\n0 0 3\n0 0 4")
    assert sizes(square, text, suffix=".sol") == [1, 2, 3, 4]


def test_a_metric_gives_the_size_of_the_same_area_and_a_warning(square, caplog):
    text = SOL.format(types="1 3", values="4 0 4\n1 0 1\n1 0 0.0625\n2.5 1.5 2.5")
    assert sizes(square, text, suffix=".sol") == [0.5, 1, 2, round(4**-0.25, 9)]
    assert "stretched up to 4 : 1" in caplog.text


def test_a_metric_in_space_counts_in_the_plane_of_the_surface():
    random = np.random.default_rng(90125)
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    metric = turn @ np.diag([4.0, 0.25, 77.0]) @ turn.T  # sizes 1/2 and 2 in the plane, 77 across it
    rows = metric[[0, 1, 1, 2, 2, 2], [0, 0, 1, 0, 1, 2]]
    assert isotropic(rows[None], turn[:, 2][None]) == pytest.approx([1.0])


@pytest.mark.parametrize(
    ("types", "values", "message"),
    [
        ("1 1", "1\n2\n3", "3 numbers where 4 vertices need 1"),
        ("1 1", "1\n2\n3\nfour", "no number"),
        ("1 2", "1 1\n1 1\n1 1\n1 1", "vectors only"),
        ("1 7", "1\n1\n1\n1", "types are 1, 2 and 3"),
        ("1 3", "1 2 1\n" * 4, "not positive definite"),
    ],
)
def test_a_solution_that_cannot_be_read_is_refused(square, types, values, message):
    with pytest.raises((MeshReadError, InvalidSize), match=message):
        sizes(square, SOL.format(types=types, values=values), suffix=".sol")


def test_a_solution_of_another_mesh_is_refused_and_unused_points_count(tmp_path, square):
    text = SOL.format(types="1 1", values="1 2 3 4 5").replace("\n4\n", "\n5\n")
    with pytest.raises(InvalidSize, match=r"5 values, but .*square.14 has 4 points"):
        sizes(square, text, suffix=".sol")
    points = np.array([[0.0, 0], [9, 9], [1, 0], [1, 1], [0, 1]])
    meshio.write_points_cells(tmp_path / "unused.vtk", points, [("triangle", [[0, 2, 3], [0, 3, 4]])])
    unused = bsgplan.read(tmp_path / "unused.vtk")
    assert sizes(unused, text, suffix=".sol") == [1, 3, 4, 5]


GRID = "# by hand\nmshid=3;{kind}\n{radii}NDIMS=2\nCOORD=1;2\n{x}\nCOORD=2;3\n{y}\nVALUE=6;1\n{values}\n"
PLAIN = {"kind": "EUCLIDEAN-GRID", "radii": "", "x": "0\n1", "y": "0\n0.5\n1", "values": "1\n2\n3\n4\n5\n6"}
GLOBE = {**PLAIN, "kind": "ELLIPSOID-GRID", "radii": "RADII=6371;6371;6371\n", "y": "-1\n0\n1"}


def test_a_grid_runs_along_y_first(square):
    text = GRID.format(**PLAIN)
    assert sizes(square, text, suffix=".msh") == [1, 4, 6, 3]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("VALUE=6;1", "VALUE=5;1"), "announces 5 numbers, 6 follow"),
        (("COORD=2;3", "COORD=3;3"), "give a grid of x and y"),
        (("VALUE=6;1\n1", "VALUE=6;1\none"), "no number"),
        (("VALUE=6;1", "VALUE=6;2"), "several values"),
        (("EUCLIDEAN", "ELLIPSOID"), "with --lonlat"),
        (("0.5", "7"), "do not ascend"),
    ],
)
def test_a_grid_that_cannot_be_read_is_refused(square, change, message):
    text = GRID.format(**PLAIN).replace(*change)
    with pytest.raises((MeshReadError, InvalidSize), match=message):
        sizes(square, text, suffix=".msh")


DATE_LINE = """across the date line
4 6
1 179.8 0 5
2 -179.8 0 5
3 -179.8 0.4 5
4 179.8 0.4 5
5 179.4 0 5
6 179.4 0.4 5
1 3 1 2 3
2 3 1 3 4
3 3 5 1 4
4 3 5 4 6
"""


def test_degrees_across_the_date_line_from_a_grid_and_from_a_mesh(tmp_path):
    (tmp_path / "fort.14").write_text(DATE_LINE)
    mesh_file = bsgplan.read_lonlat(tmp_path / "fort.14")
    scale = mesh_file.projection.scale(mesh_file.mesh.points)
    east = f"{np.radians(270.0)}"
    grid = GRID.format(**{**GLOBE, "x": "0\n" + east})
    with pytest.raises(InvalidSize, match="no size at 6 of 6 points"):
        sizes(mesh_file, grid.replace(east, "1"), suffix=".msh")
    found = np.array(sizes(mesh_file, grid, suffix=".msh")) / scale
    longitude, latitude = mesh_file.projection.to_unbroken_degrees(mesh_file.mesh.points).T
    along, up = longitude / 270, np.radians(latitude)
    rows = [np.log(a) * (1 - along) + np.log(b) * along for a, b in ((2e3, 5e3), (3e3, 6e3))]
    assert np.allclose(found, np.exp(rows[0] * (1 - up) + rows[1] * up))
    found = sizes_from(tmp_path / "fort.14", mesh_file, name="depth")
    assert np.allclose(found / scale, 5)
    own = sizes_from(tmp_path / "fort.14", mesh_file)
    assert np.allclose(own, bsgplan.size_field(mesh_file.mesh).h, rtol=1e-6)


def test_any_mesh_is_a_background_with_its_array_or_its_edges(tmp_path):
    plate = bsgplan.read(PLATE)
    triangles = plate.mesh.triangles
    h = bsgplan.size_field(plate.mesh).h
    meshio.write_points_cells(
        tmp_path / "background.vtu",
        np.column_stack([plate.mesh.points, np.zeros(plate.mesh.n_points)]),
        [("triangle", triangles)],
        {"h": h, "vector": np.zeros((len(h), 2))},
        {"cells": [np.full(len(triangles), 0.25)]},
    )
    assert np.allclose(sizes_from(tmp_path / "background.vtu", plate, name="h"), h)
    assert np.allclose(sizes_from(tmp_path / "background.vtu", plate, name="cells"), 0.25)
    assert np.allclose(sizes_from(tmp_path / "background.vtu", plate), h)
    assert size_of(plate, "h", tmp_path / "background.vtu").source.endswith("background.vtu: h")
    with pytest.raises(InvalidSize, match="'vector' has shape"):
        sizes_from(tmp_path / "background.vtu", plate, name="vector")
    with pytest.raises(MeshReadError, match=r"no array 'g' for --size; .* cells, h, vector"):
        sizes_from(tmp_path / "background.vtu", plate, name="g")


def test_the_command_takes_a_size_file_and_tells_its_mistakes(tmp_path, capsys, square):
    (tmp_path / "h.pos").write_text(TWO_STEPS)
    words = ["estimate", square.path, "--tris-per-block", "1", "--json", "--size-file"]
    assert main([*words, str(tmp_path / "h.pos")]) == 0
    field = json.loads(capsys.readouterr().out)["size_field"]
    assert field["source"] == str(tmp_path / "h.pos")
    assert (field["h_min"], field["h_max"]) == pytest.approx((0.1, 0.2))
    for name, code in (("absent.pos", 3), ("square.14", 0)):
        assert main([*words, str(tmp_path / name)]) == code
    assert main(["estimate", "cases/rectangle/mesh.msh", "--size-file", str(tmp_path / "h.pos")]) == 3
    err = capsys.readouterr().err.splitlines()
    assert err[-1].startswith("error: ")
    assert "no size at" in err[-1]
    assert main([*words, str(tmp_path / "h.pos"), "--save", str(tmp_path / "h.pos")]) == 2


def test_every_triangle_of_a_long_view_is_there(tmp_path):
    n = 20_000
    rows = [f"ST({k},0,0,{k + 1},0,0,{k},1,0){{1,1,2}};" for k in range(n)]
    (tmp_path / "many.pos").write_text('View "h" {\n' + "\n".join(rows) + "\n};\n")
    assert read_pos(tmp_path / "many.pos", None).sizes.shape == (n, 3)


@pytest.mark.parametrize("factor", [1e-6, 1e6])
def test_sizes_in_an_unlikely_unit_are_warned_of(caplog, factor):
    plate = bsgplan.read("cases/plate/mesh.msh")
    wanted = replace(plate, point_data={"h": np.full(plate.mesh.n_points, factor)})
    size_of(wanted, "h")
    assert "check their unit" in caplog.text
    caplog.clear()
    size_of(replace(plate, point_data={"h": size_of(plate).h}), "h")
    assert not caplog.text


@pytest.mark.parametrize("suffix", [".pos", ".msh"])
def test_sizes_in_metres_are_no_sizes_of_a_mesh_in_degrees(tmp_path, suffix, capsys):
    """A view and a grid about the origin in metres used to cover the degrees, and were read off silently."""
    path = tmp_path / "fort.14"
    path.write_text(DATE_LINE)
    around = {
        ".pos": 'View "h" {SQ(-39045,-9e3,0, 36215,-9e3,0, 36215,9e3,0, -39045,9e3,0){1,2,3,4};};',
        ".msh": GRID.format(**{**PLAIN, "x": "-39045\n36215", "y": "-9000\n0\n9000"}),
    }
    sizes_file = tmp_path / f"metres{suffix}"
    sizes_file.write_text(around[suffix])
    assert bsgplan.cli.main(["estimate", str(path), "--lonlat", "--size-file", str(sizes_file)]) == 3
    told = capsys.readouterr().err
    assert told.splitlines()[-1] == (
        f"error: {sizes_file}: places of x -39045 .. 36215, y -9000 .. 9000 are no degrees; "
        "with --lonlat give sizes at longitudes and latitudes"
    )
