"""Hostile size files: an answer or one line, in little time and memory, whatever stands in them."""

from __future__ import annotations

import re
import time

import numpy as np
import pytest
from costs import read_or_refused
from hypothesis import given
from hypothesis import strategies as st
from seeds import damaged

import bsgplan
from bsgplan.io.size_file import GRID, SOLUTION, VIEW, sizes_from

SQUARE = "a square\n2 4\n1 0 0 1\n2 1 0 1\n3 1 1 1\n4 0 1 1\n1 3 1 2 3\n2 3 1 3 4\n"
SEEDS = {
    "two.pos": b'// c\nView "h" {\nTIME{0, 1};\nST(0,0,0,1,0,0,1,1,0){.1,.2,.2, 9,9,9};\n'
    b"ST(0,0,0, 1,1,0,0,1,0){1e-1,.2,.1 /* d */, 9,9,9};\nSQ(0,0,0,1,0,0,1,1,0,0,1,0){1,2,3,4,5,6,7,8};\n};\n"
    b'View "k" {};\n',
    "one.pos": b'View "h" {SL(0,0,0,1,0,0){1,2};SP(1,1,0){3}; SP(0,1,0){4};};',
    "metric.sol": b"MeshVersionFormatted 2\nDimension 2\n# c\nSolAtVertices\n4\n2 2 3\n"
    b"1 1 4 0 4\n1 1 1 0 1\n1 1 1 0 2\n0 0 2.5 1.5 2.5\nEnd\n",
    "grid.msh": b"# c\nMSHID=3;EUCLIDEAN-GRID\nNDIMS=2\nCOORD=1;2\n0\n1\nCOORD=2;3\n0\n.5\n1\n"
    b"VALUE=6;1\n1\n2\n3\n4\n5\n6\n",
}


@pytest.fixture(scope="module")
def square(tmp_path_factory):
    path = tmp_path_factory.mktemp("square") / "square.14"
    path.write_text(SQUARE)
    return bsgplan.read(path)


def read_or_refuse(square, path, content: bytes, name: str | None = None) -> str | None:
    """Return the one line with which a size file is refused, None where it is read."""
    path.write_bytes(content)
    found, message = read_or_refused(lambda: sizes_from(path, square, name=name))
    if found is None:
        assert re.fullmatch(re.escape(str(path)) + ": .+", message)  # one line
        assert len(message) < 1000
    else:
        assert found.shape == (4,)
        assert (found > 0).all()
        assert np.isfinite(found).all()
    return None if found is not None else message


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.filterwarnings("ignore:overflow", "ignore:invalid value", "ignore:divide by zero")
@given(data=st.data())
def test_a_damaged_size_file_is_read_or_refused_in_one_line(tmp_path, square, seed, data):
    name = data.draw(st.sampled_from([None, "h"])) if seed.endswith(".pos") else None
    read_or_refuse(square, tmp_path / seed, data.draw(damaged(SEEDS[seed])), name)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_size_file_cut_off_anywhere_is_read_or_refused(tmp_path, square, seed):
    for stop in range(len(SEEDS[seed])):
        read_or_refuse(square, tmp_path / seed, SEEDS[seed][:stop], "h" if seed == "two.pos" else None)


VIEW_OF = b'View "h" {'
MANY = 1 << 20


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (VIEW_OF + b"ST(" + b"0," * 2 * MANY, "more without a closing bracket"),
        (VIEW_OF + b"ST(0,0,0)" * MANY, "more without a closing bracket"),
        (VIEW_OF + b"(" * 4 * MANY, "more without a closing bracket"),
        (VIEW_OF + b"{" * 4 * MANY + b"}", "more without a closing bracket"),
        (VIEW_OF + b"}" * 4 * MANY, "the view holds nothing"),
        (VIEW_OF + b"," * MANY + b"}", "between the elements"),
        (VIEW_OF + b"{}" * MANY + b"}", "between the elements"),
        (VIEW_OF + b"ST(){}" * MANY + b"}", "ST with coordinates ''"),
        (VIEW_OF + b"".join(b"A%dB%d(){}" % (k % 7, k % 9) for k in range(MANY)), "between the elements"),
        (VIEW_OF + b"".join(b"%s(){}" % (b"T" * (1 + k % 800)) for k in range(1, 6000)), "the view holds T"),
        (VIEW_OF + b" " * 8 * MANY + b"};", "the view holds nothing"),
        (VIEW_OF + b"\n// a comment" * MANY + b"\n};", "the view holds nothing"),
        (VIEW_OF + b"TIME{" * MANY + b"}", "without a closing bracket|between"),
        (VIEW_OF + b"TIME{}" * MANY + b"}", "the view holds nothing"),
        (VIEW_OF + b"/* " * MANY, "comment .* that does not end"),
        (VIEW_OF + b"/" * 4 * MANY, "the view holds nothing"),
        (VIEW_OF + b'"' * (MANY // 4), "between the elements"),
        (b'View "' + b"a" * 4 * MANY, "more without a closing quote"),
        (b'View"a"{' * (MANY // 16), "the view holds nothing"),
        (b"".join(b'View"%d"{}' % k for k in range(MANY // 32)), "32768 views, 0, 1, .* 19, ..; choose"),
    ],
    ids=lambda value: value[:18].decode("ascii", "replace") if isinstance(value, bytes) else "",
)
def test_a_hostile_view_is_refused(tmp_path, square, content, message):
    assert re.search(message, read_or_refuse(square, tmp_path / "h.pos", content))


SOLUTION_OF = b"MeshVersionFormatted 2 Dimension 2 "


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (SOLUTION_OF + b"SolAtVertices 1000000000000 1 1\n1\n2\nEnd", "2 numbers where 1000000000000"),
        (SOLUTION_OF + b"SolAtVertices 4 1000000000000 1\n1\n2\nEnd", "1000000000000 solutions of types"),
        (SOLUTION_OF + b"SolAtVertices " + b"9" * 5000, "no SolAtVertices"),
        (SOLUTION_OF + b"SolAtVertices 4 1 1 " + b"7" * 3 * MANY, "no line of a mesh"),
        (SOLUTION_OF + b"SolAtVertices 4 1 1 " + b"7 " * 2 * MANY, "2097152 numbers where 4"),
        (SOLUTION_OF + b"SolAtVertices 4 1 1 1 2 three 4 End", "line 1: 'three' is no number"),
        (SOLUTION_OF + b"SolAtVertices 4 1 1\n1\n2\n3-4\n4 End", "line 4: a value has '3-4', not a finite"),
        (SOLUTION_OF + b"SolAtEdges " + b"Dimension 2 " * MANY, "no SolAtVertices"),
        (SOLUTION_OF + b"SolAtTriangles 1 1 1 " + b"a 1 " * MANY, "no SolAtVertices"),
        (SOLUTION_OF + b"SolAtVertices 4 1 1 " + b"#" * 4 * MANY, "0 numbers where 4"),
    ],
)
def test_a_hostile_solution_is_refused(tmp_path, square, content, message):
    assert re.search(message, read_or_refuse(square, tmp_path / "h.sol", content))


GRID_OF = b"MSHID=3;EUCLIDEAN-GRID\n"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (GRID_OF + b"A=1\n" * (MANY // 8), "section 101; no grid"),
        (GRID_OF + b"A=\n1\n" * (MANY // 8), "section 101; no grid"),
        (GRID_OF + b"COORD=1;1000000000000\n1\n2\n", "announces 1000000000000 numbers, 2 follow"),
        (GRID_OF + b"COORD=1;" + b"9" * 5000 + b"\n1\n2\n", "announces 99999999999999999999 numbers"),
        (GRID_OF + b"COORD=1;2\n" + b"7" * 3 * MANY, "no line of a mesh"),
        (GRID_OF + b"a" * 3 * MANY, "no line of a mesh"),
        (GRID_OF + b"COORD=\n1\n", "announces  numbers"),
        (GRID_OF + b"RADII=a;b\n", "RADII=a;b, no lengths"),
        (GRID_OF + b"COORD=1;1\n1\nwhat\n", "line 4: 'what' is no number"),
    ],
)
def test_a_hostile_grid_is_refused(tmp_path, square, content, message):
    assert re.search(message, read_or_refuse(square, tmp_path / "h.msh", content))


@pytest.mark.parametrize("pattern", [VIEW, SOLUTION, GRID])
def test_comments_before_a_file_take_no_time(pattern):
    """Twelve of them took seconds, each one more four times as long."""
    for comments in (b"#   \r\n" * 600, b"/**/" * 1000, b"//  \r\n" * 600, b"/*" * 2000, b" \n" * 2000):
        start = time.process_time()
        assert not pattern.match(comments + b"x")
        assert time.process_time() - start < 1
    assert VIEW.match(b'// a\r\n/* b */ /**/\n View \n"h"')
    assert SOLUTION.match(b"# a\r\n\n # b\r\nMeshVersionFormatted 2 # c\n SolAtVertices")
    assert GRID.match(b"# a  \r\n# b\nMSHID = 3;EUCLIDEAN-GRID")
