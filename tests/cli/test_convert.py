"""`bsgplan convert`: formats by suffix or name, companions, one-line errors."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from bsgplan.cli import main
from bsgplan.io import Boundary, read, write
from bsgplan.io.formats import BY_NAME, FORMATS
from bsgplan.io.write import n_boundaries_written

SQUARE = """a square
2 5
1 0 0 1
2 1 0 1
3 1 1 1
9 7 7 1
4 0 1 1
1 3 1 2 3
2 3 1 3 4
1
2
2
1
2
0
0
"""
COUNTED = SQUARE.replace("2 5", "2 4", 1).replace("9 7 7 1\n", "")


@pytest.fixture
def square(tmp_path):
    path = tmp_path / "fort.14"
    path.write_text(SQUARE)
    return path


def test_the_suffix_tells_the_format(square, capsys):
    out = square.with_name("out.2dm")
    assert main(["convert", str(square), str(out)]) == 0
    told = capsys.readouterr()
    assert told.out == f"{out}: 2dm, 4 points, 2 triangles, 1 boundary\n1 point of no cell dropped\n"
    assert told.err == ""
    assert read(out).boundaries[0].name == "open 1"


def test_a_name_tells_it_where_the_suffix_does_not(square):
    out = square.with_name("out.msh")
    for name in ("gmsh", "gmsh41", "jigsaw", "mfem"):
        assert main(["convert", str(square), str(out), "--format", name]) == 0
        assert read(out).format == name.removesuffix("41")
    assert main(["convert", str(square), str(square.with_name("fort.hgrid")), "--format", "fort.14"]) == 0


@pytest.mark.parametrize(("text", "is_told"), [(SQUARE, True), (COUNTED, False)])
def test_companions_that_no_longer_fit_are_named(square, text, is_told, capsys):
    """An attribute file lists points by number: dropping a point moves the numbers after it."""
    square.write_text(text)
    for name in ("fort.13", "fort.15", "fort.63", "notes.txt"):
        square.with_name(name).write_text("")
    assert main(["convert", str(square), str(square.with_name("out.14"))]) == 0
    err = capsys.readouterr().err
    assert ("fort.13, fort.15 beside" in err) == is_told
    assert "fort.63" not in err
    assert (err == "") == (not is_told)


def test_the_companions_of_schism_are_its_own(tmp_path, capsys):
    for name in ("hgrid.gr3", "hgrid.ll", "drag.gr3", "tvd.prop", "vgrid.in", "fort.13"):
        (tmp_path / name).write_text(SQUARE)
    assert main(["convert", str(tmp_path / "hgrid.gr3"), str(tmp_path / "out.gr3")]) == 0
    err = capsys.readouterr().err
    assert "drag.gr3, hgrid.ll, tvd.prop, vgrid.in beside" in err
    assert "fort.13" not in err


def test_what_is_lost_is_one_warning(square, capsys):
    assert main(["convert", str(square), str(square.with_name("out.off"))]) == 0
    err = capsys.readouterr().err
    assert err.startswith("warning: ")
    assert "no place for point array depth, 1 open boundary" in err
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    ("out", "words", "code", "message"),
    [
        ("out.xyz", [], 2, "suffix '.xyz'"),
        ("out.msh", ["--format", "gmsh9"], 2, "'gmsh9' is not written"),
        ("fort.14", [], 2, "is a file that is read"),
        ("no/out.off", [], 3, "does not exist"),
    ],
)
def test_errors_are_one_line_and_leave_nothing(square, out, words, code, message, capsys):
    assert main(["convert", str(square), str(square.parent / out), *words]) == code
    told = capsys.readouterr()
    assert (told.out, told.err.count("\n")) == ("", 1)
    assert message in told.err
    assert [p.name for p in square.parent.iterdir()] == ["fort.14"]
    assert square.read_text() == SQUARE


def test_neither_file_of_a_pair_is_overwritten_by_its_own_mesh(square, capsys):
    node = square.with_name("pair.node")
    assert main(["convert", str(square), str(node)]) == 0
    before = node.read_text()
    assert main(["convert", str(node), str(node.with_suffix(".ele"))]) == 2
    assert "is a file that is read" in capsys.readouterr().err
    assert node.read_text() == before


def test_quads_are_split_where_asked(tmp_path, capsys):
    mesh, out = tmp_path / "mixed.14", tmp_path / "mixed.off"
    mesh.write_text("quad\n2 5\n1 0 0 1\n2 1 0 1\n3 1 1 1\n4 0 1 1\n5 2 0 1\n1 4 1 2 3 4\n2 3 2 5 3\n")
    assert main(["convert", str(mesh), str(out)]) == 3
    assert "split them with --split-quads" in capsys.readouterr().err
    assert not out.exists()
    assert main(["convert", str(mesh), str(out), "--split-quads"]) == 0
    assert read(out).mesh.n_triangles == 3


@pytest.mark.parametrize("name", [found.name for found in FORMATS if found.writer is not None])
def test_the_boundaries_told_are_those_written(square, name, caplog):
    """Those in the last line and those that a warning says are lost make up all of them."""
    pytest.importorskip({"xdmf": "h5py", "exodus": "netCDF4"}.get(name, "numpy"))
    kinds = (Boundary("open", np.array([0, 1])), Boundary("land", np.array([1, 2]), 0))
    many = replace(read(square), boundaries=(*kinds, Boundary("named", np.array([2, 3]), 5, "wall")))
    write(many, square.with_name("out.node" if name == "triangle" else "out"), format=name)
    lost = [int(n) for n in re.findall(r"(\d+) (?:open|land|named) boundar", caplog.text)]
    assert n_boundaries_written(many, BY_NAME[name]) == 3 - sum(lost)


def test_boundaries_without_a_place_are_not_reported(square, capsys):
    """As .off they used to be, after the warning that there is no place for them."""
    out = square.with_name("out.off")
    assert main(["convert", str(square), str(out)]) == 0
    assert capsys.readouterr().out.splitlines()[0] == f"{out}: off, 4 points, 2 triangles"
