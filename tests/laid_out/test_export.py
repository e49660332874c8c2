"""Exports opened by those that shall read them."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bsgplan.cli.app import main
from bsgplan.errors import InvalidOption, MeshReadError, OutputError
from bsgplan.io import Boundary, read
from bsgplan.laid_out import FORMATS, LaidOut, arrays_of, export, load_layout
from bsgplan.laid_out.export import n_boundaries_written

from .conftest import as_file, lattice

SUFFIX = {"msh22": "msh", "msh41": "msh", "hyteg": "msh", "fort14": "14"}


@pytest.fixture(scope="session")
def saved(plate: LaidOut, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The plate as a saved layout, its arrays alone."""
    path = tmp_path_factory.mktemp("layout") / "layout.json"
    path.write_text(json.dumps(document(plate), allow_nan=False))
    return path


def document(laid: LaidOut) -> dict[str, Any]:
    """Return what of a saved layout concerns the exports."""
    arrays = {"blocks": arrays_of(laid.blocks_file()), "grid": arrays_of(laid.grid_file())}
    return {"schema": "bsgplan.layout/1", **arrays}


def test_a_saved_layout_loads_back_to_the_last_bit(plate: LaidOut, ocean: LaidOut, tmp_path: Path) -> None:
    """Points, triangles, arrays and boundaries of blocks and grid."""
    for laid in (plate, ocean):
        path = tmp_path / "layout.json"
        path.write_text(json.dumps(document(laid), allow_nan=False))
        for part in ("blocks", "grid"):
            made, found = getattr(laid, f"{part}_file")(), load_layout(path, part)
            np.testing.assert_array_equal(found.mesh.points, made.mesh.points)
            np.testing.assert_array_equal(found.mesh.triangles, made.mesh.triangles)
            for name in ("point_data", "cell_data"):
                assert list(getattr(found, name)) == list(getattr(made, name))
                for key, values in getattr(made, name).items():
                    np.testing.assert_array_equal(getattr(found, name)[key], values)
            for a, b in zip(found.boundaries, made.boundaries, strict=True):
                assert (a.kind, a.code, a.name) == (b.kind, b.code, b.name)
                np.testing.assert_array_equal(a.nodes, b.nodes)
                np.testing.assert_array_equal(a.segments, b.segments)


@pytest.mark.parametrize("what", ["blocks", "grid"])
@pytest.mark.parametrize("format", list(FORMATS))
def test_the_command_writes_every_format(
    saved: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], format: str, what: str
) -> None:
    """One line about the file, nothing beside it but the pieces of a .vtm."""
    out = tmp_path / f"out.{SUFFIX.get(format, format)}"
    assert main(["export", str(saved), "--what", what, "--format", format, "-o", str(out)]) == 0
    captured = capsys.readouterr()
    assert captured.out.startswith(f"{out}: {format}, ")
    expected = {out.name} | ({"out"} if format == "vtm" else set())
    assert {path.name for path in tmp_path.iterdir()} == expected


def test_mfem_reads_groups_as_attributes(plate: LaidOut, tmp_path: Path) -> None:
    """As many elements and boundary elements as there are, five boundary attributes."""
    mfem = pytest.importorskip("mfem.ser")
    for found in (plate.blocks_file(), plate.grid_file()):
        export(found, tmp_path / "m.msh", format="msh22")
        mesh = mfem.Mesh(str(tmp_path / "m.msh"), 1, 1)
        assert mesh.GetNE() == found.mesh.n_triangles
        assert mesh.GetNBE() == np.count_nonzero(found.mesh.topology.is_boundary_edge)
        assert mesh.bdr_attributes.Size() == 5
        areas = sum(mesh.GetElementVolume(k) for k in range(mesh.GetNE()))
        assert areas == pytest.approx(found.mesh.areas.sum())


def test_islands_are_closed_and_barriers_have_two_sides_for_mfem(tmp_path: Path) -> None:
    """ADCIRC's island leaves out its last step: as a Gmsh group it has it."""
    mfem = pytest.importorskip("mfem.ser")
    mesh = lattice(2)
    ring = Boundary("land", np.array([0, 1, 2, 5, 8, 7, 6, 3]), 1)
    export(as_file(mesh, (ring,)), tmp_path / "m.msh", format="msh22")
    assert mfem.Mesh(str(tmp_path / "m.msh"), 1, 1).GetNBE() == 8


def test_scikit_fem_reads_groups_by_name(plate: LaidOut, tmp_path: Path) -> None:
    """Both Gmsh versions; the sides of each group as many as the boundary has."""
    skfem = pytest.importorskip("skfem")
    grid = plate.grid_file()
    for format in ("msh22", "msh41"):
        export(grid, tmp_path / "m.msh", format=format)
        mesh = skfem.MeshTri.load(tmp_path / "m.msh")
        assert mesh.nelements == grid.mesh.n_triangles
        assert {name: len(f) for name, f in mesh.boundaries.items()} == {
            b.name: len(b.segments) for b in grid.boundaries
        }


def test_pyvista_sees_every_array(plate: LaidOut, tmp_path: Path) -> None:
    """One cell a block; the arrays of the grid; a .vtm has a piece for each block."""
    import pyvista

    export(plate.blocks_file(), tmp_path / "b.vtu")
    export(plate.grid_file(), tmp_path / "g.vtu")
    export(plate.grid_file(), tmp_path / "m.vtm")
    n_blocks = plate.grid.layout.n_blocks
    blocks, grid = pyvista.read(tmp_path / "b.vtu"), pyvista.read(tmp_path / "g.vtu")
    assert blocks.n_cells == n_blocks
    assert {"block", "level", "region", "size", "quality"} <= set(blocks.cell_data.keys())
    assert {"block", "i", "j", "region"} <= set(grid.cell_data.keys())
    assert "irregularity" in grid.point_data
    pieces = pyvista.read(tmp_path / "m.vtm")
    assert pieces.n_blocks == n_blocks
    assert all(pieces[k].n_cells == 16 for k in range(n_blocks))


def test_hyteg_gets_two_tags_and_flags(plate: LaidOut, tmp_path: Path) -> None:
    """Every element line: lines `1 2 1 1`, triangles `2 2 0 0`; no names; ids from 1."""
    blocks = plate.blocks_file()
    export(blocks, tmp_path / "h.msh", format="hyteg")
    text = (tmp_path / "h.msh").read_text()
    assert re.findall(r"\$\w+", text)[::2] == ["$MeshFormat", "$Nodes", "$Elements"]
    rows = [line.split() for line in text.split("$Elements\n")[1].splitlines()[1:-1]]
    assert [int(row[0]) for row in rows] == list(range(1, len(rows) + 1))
    n_rim = np.count_nonzero(blocks.mesh.topology.is_boundary_edge)
    assert [row[1:5] for row in rows[:n_rim]] == [["1", "2", "1", "1"]] * n_rim
    assert [row[1:5] for row in rows[n_rim:]] == [["2", "2", "0", "0"]] * plate.grid.layout.n_blocks


def test_the_view_holds_the_wanted_size(plate: LaidOut, tmp_path: Path) -> None:
    """One scalar triangle a block; its values are the array's at the corners."""
    blocks = plate.blocks_file()
    export(blocks, tmp_path / "t.pos")
    rows = re.findall(r"ST\((.*)\)\{(.*)\};", (tmp_path / "t.pos").read_text())
    sizes = np.array([row[1].split(",") for row in rows], dtype=float)
    np.testing.assert_array_equal(sizes, blocks.point_data["target_size"][blocks.mesh.triangles])


def test_a_barrier_without_pairs_is_refused_by_name(tmp_path: Path) -> None:
    """A fort.14 whose weir has one side only would be a lie."""
    mesh_file = as_file(lattice(2), (Boundary("land", np.array([0, 1, 2]), 24),))
    with pytest.raises(OutputError, match=r"barrier land 1 \(IBTYPE 24\) has 3 nodes"):
        export(mesh_file, tmp_path / "a.14")
    assert not list(tmp_path.iterdir())


def test_an_unknown_format_is_told(tmp_path: Path) -> None:
    """By name and by suffix."""
    with pytest.raises(InvalidOption, match="format 'stl' is unknown; give a --format of msh22"):
        export(as_file(lattice(1)), tmp_path / "a.msh", format="stl")
    with pytest.raises(InvalidOption, match=r"suffix '.abc' tells no format"):
        export(as_file(lattice(1)), tmp_path / "a.abc")


DAMAGES: dict[str, Any] = {
    "triangles": [[0, 1, 10**9]],
    "points": [[0, 0], [1]],
    "cell_data": {"block": [1, 2]},
    "point_data": {"depth": "deep"},
    "boundaries": [{"kind": "wall"}],
    "cell_names": {"a": 3},
    "projection": {"longitude": "east"},
}


@pytest.mark.parametrize("field", list(DAMAGES))
def test_a_damaged_layout_is_told_in_one_line(
    saved: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], field: str
) -> None:
    """Exit code 3, the file and the field named, nothing written."""
    found = json.loads(saved.read_text())
    found["grid"][field] = DAMAGES[field]
    path = tmp_path / "damaged.json"
    path.write_text(json.dumps(found))
    assert main(["export", str(path), "-o", str(tmp_path / "o.vtu")]) == 3
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert told.startswith(f"error: {path}: grid")
    assert not (tmp_path / "o.vtu").exists()


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.99])
def test_a_cut_off_layout_is_told(saved: Path, tmp_path: Path, share: float) -> None:
    """Whatever is missing of the text."""
    text = saved.read_text()
    path = tmp_path / "cut.json"
    path.write_text(text[: int(share * len(text))])
    with pytest.raises(MeshReadError, match="no readable JSON"):
        load_layout(path, "grid")


@pytest.mark.parametrize(
    "text",
    [
        "[]",
        "3",
        '{"schema": "bsgplan.estimate/1"}',
        "[" * 100_000,
        '{"schema": "bsgplan.layout/1"}',
        "\x00\xff",
    ],
)
def test_another_json_is_told(tmp_path: Path, text: str) -> None:
    """Other documents, other values, nested to the skies."""
    path = tmp_path / "other.json"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(MeshReadError, match=r"other\.json: "):
        load_layout(path, "grid")


def test_degrees_come_back(tmp_path: Path) -> None:
    """A mesh in degrees is laid out in metres and written in degrees."""
    from bsgplan.io import read_lonlat, write_fort14
    from bsgplan.laid_out import lay_out_file
    from bsgplan.sizing import size_field

    mesh = lattice(12)
    write_fort14(as_file(mesh, (), point_data={"depth": mesh.points[:, 0]}), tmp_path / "in.14")
    mesh_file = read_lonlat(tmp_path / "in.14")
    laid = lay_out_file(mesh_file, size_field(mesh_file.mesh), side=2, effort=3)
    (tmp_path / "l.json").write_text(json.dumps(document(laid)))
    export(load_layout(tmp_path / "l.json", "grid"), tmp_path / "out.14")
    found = read(tmp_path / "out.14")
    np.testing.assert_allclose(found.mesh.bounds[:4], [0, 1, 0, 1], atol=1e-6)
    np.testing.assert_allclose(found.point_data["depth"], found.mesh.points[:, 0], atol=2e-4)


def test_sizes_exported_in_degrees_feed_back(tmp_path: Path) -> None:
    """The view of a layout in degrees is a size file of its mesh: places in degrees, sizes in true metres."""
    from bsgplan.io import read_lonlat, write_fort14
    from bsgplan.io.size_file import sizes_from
    from bsgplan.laid_out import lay_out_file
    from bsgplan.pipeline import plan_blocks
    from bsgplan.sizing import size_field

    write_fort14(as_file(lattice(16)), tmp_path / "in.14")
    mesh_file = read_lonlat(tmp_path / "in.14")
    size = size_field(mesh_file.mesh)
    export(lay_out_file(mesh_file, size, side=2, effort=3).grid_file(), tmp_path / "h.pos")
    found = sizes_from(tmp_path / "h.pos", mesh_file)
    assert np.abs(np.log(found / size.h)).max() < np.log(1.25)
    without = plan_blocks(mesh_file, tris_per_block=4).plan.n_blocks
    fed_back = plan_blocks(mesh_file, tris_per_block=4, size_file=tmp_path / "h.pos").plan.n_blocks
    assert fed_back == pytest.approx(without, rel=0.1)


@pytest.mark.parametrize("format", ["msh22", "msh41"])
def test_sides_without_a_group_are_lines_too(tmp_path: Path, format: str) -> None:
    """A mesh without groups has one line element for each side; sides left over are a group of their own."""
    import meshio

    mesh = lattice(3)
    some = Boundary("named", np.array([0, 1, 2]), 1, "inlet")
    for given, names in (((), {"boundary": [1, 1]}), ((some,), {"inlet": [1, 1], "unmarked": [2, 1]})):
        export(as_file(mesh, given), tmp_path / "m.msh", format=format)
        found = meshio.gmsh.read(tmp_path / "m.msh")
        lines = np.concatenate([block.data for block in found.cells if block.type == "line"])
        assert len(np.unique(np.sort(lines, axis=1), axis=0)) == len(lines) == 12
        assert {name: pair.tolist() for name, pair in found.field_data.items()} == names
        assert n_boundaries_written(as_file(mesh, given), format) == len(names)


def test_mfem_has_a_boundary_without_groups(tmp_path: Path) -> None:
    """One attribute on all sides."""
    mfem = pytest.importorskip("mfem.ser")
    export(as_file(lattice(3)), tmp_path / "m.msh")
    mesh = mfem.Mesh(str(tmp_path / "m.msh"), 1, 1)
    assert (mesh.GetNBE(), mesh.bdr_attributes.Size()) == (12, 1)
