"""Readers of size files against slow twins, whatever the buffer; what they cost; hostile files."""

from __future__ import annotations

from itertools import chain, cycle, islice

import numpy as np
import pytest
import size_reference
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.errors import MeshReadError
from bsgplan.io import size_pos, text_records
from bsgplan.io.pos_text import uncommented
from bsgplan.io.size_jigsaw import read_grid
from bsgplan.io.size_pos import read_pos
from bsgplan.io.size_sol import read_sol

NUMBERS = (
    st.integers(-(10**20), 10**20).map(str)
    | st.floats(-1e60, 1e60).map(repr)
    | st.floats(-1, 1).map("{:.6g}".format)
)
BLANKS = st.sampled_from(["", " ", "\n", "\t\r\n", "/**/", "// a ) } comment\n", "/* View { \n */", " " * 70])
CORNERS = {"ST": 3, "SQ": 4, "SP": 1, "SL": 2, "ST2": 6, "SQ2": 9, "VT": 9, "T3": 1}
"""Kinds of element, and their nodes in these tests."""


@st.composite
def views(draw) -> str:
    """Return a .pos file with one or two views, elements of all kinds, blanks and comments everywhere."""
    text, blanks = draw(BLANKS), cycle(draw(st.lists(BLANKS, min_size=1, max_size=7)))
    pool = cycle(draw(st.lists(NUMBERS, min_size=1, max_size=11)))
    for name in draw(st.sampled_from([("h",), ("h", "k"), ("h", "// h"), ("a } b", "h"), ("k", "h", "h")])):
        n_steps = draw(st.integers(1, 2))
        text += f'View{next(blanks)}"{name}"{next(blanks)}{{'
        if draw(st.booleans()):
            text += "TIME{0,1};"
        kinds = draw(st.lists(st.sampled_from(sorted(CORNERS)), min_size=1, max_size=12))
        for kind in kinds:
            n = CORNERS[kind]
            numbers = list(islice(pool, 3 * n))
            values = list(islice(pool, n * n_steps))
            a, b, c, d = islice(blanks, 4)
            text += f"{a}{kind}{b}({','.join(numbers)}){c}{{{(',' + d).join(values)}}};"
        text += next(blanks) + "};" + next(blanks)
    return text


BUFFERS = st.sampled_from([1 << 20, 300, 97, 31, 7])


@given(text=views(), name=st.sampled_from([None, "h"]), buffer=BUFFERS)
def test_a_view_is_that_of_the_twin_whatever_the_buffer(tmp_path, text, name, buffer):
    path = tmp_path / "h.pos"
    path.write_text(text)
    try:
        places, values = size_reference.pos(path, name)
    except ValueError:
        places = values = None
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(size_pos, "BUFFER", buffer)
        patch.setattr(size_pos, "joined", lambda points, sizes: (points[:, None], sizes[:, None]))
        patch.setattr(size_pos, "Background", lambda corners, sizes: (corners, sizes))
        if values is None:
            with pytest.raises(MeshReadError):
                read_pos(path, name)
            return
        found = read_pos(path, name)
    assert np.array_equal(found[0], places)
    assert np.array_equal(found[1], values)


@given(pieces=st.lists(st.sampled_from(["/", "*", '"', "\n", "a", "//", "/*", "*/", " "]), max_size=25))
def test_comments_go_whatever_the_pieces(pieces):
    whole = "".join(pieces)
    expected = size_reference.COMMENT.sub(lambda found: found[1] or " ", whole)
    try:
        found = b"".join(uncommented(piece.encode() for piece in pieces)).decode()
    except MeshReadError:
        assert "/*" in expected
        return
    assert found == expected


@given(
    values=st.lists(NUMBERS, min_size=6, max_size=60).map(lambda found: found[: len(found) // 6 * 6]),
    gaps=st.lists(st.sampled_from([" ", "\n", "\r\n", " # End 7\n", "\t"]), min_size=60, max_size=60),
    columns=st.sampled_from([(2, 1, 1), (2, 3, 3), (3, 1, 1), (3, 3, 6)]),
    buffer=BUFFERS,
)
def test_a_solution_is_that_of_the_twin_whatever_the_buffer(tmp_path, values, gaps, columns, buffer):
    dimension, kind, n_columns = columns
    path = tmp_path / "h.sol"
    body = "".join(value + gap for value, gap in zip(values, gaps, strict=False))
    head = f"MeshVersionFormatted 2\nDimension\n{dimension}\n# SolAtVertices 3\nSolAtVertices\n"
    path.write_text(f"{head}{len(values) // n_columns} 1 {kind} {body}End\n")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(text_records, "BUFFER", max(buffer, 97))
        patch.setattr(text_records, "WINDOW", buffer)
        found = read_sol(path).values
    assert np.array_equal(found, size_reference.sol(path))


@given(
    sizes=st.integers(2, 6).flatmap(
        lambda n: st.lists(st.lists(NUMBERS, min_size=n, max_size=n), min_size=2, max_size=6)
    ),
    gap=st.sampled_from(["\n", "\r\n", "\n\n", " \n# c\n"]),
    buffer=st.sampled_from([1 << 20, 300, 97]),
)
def test_a_grid_is_that_of_the_twin_whatever_the_buffer(tmp_path, sizes, gap, buffer):
    path = tmp_path / "h.msh"
    n_x, n_y = len(sizes), len(sizes[0])
    parts = ["MSHID=3;EUCLIDEAN-GRID", "NDIMS=2", f"COORD=1;{n_x}", *map(str, range(n_x))]
    parts += [
        f"COORD=2;{n_y}",
        *(f"{k}.5" for k in range(n_y)),
        f"VALUE = {n_x * n_y};1",
        *chain.from_iterable(sizes),
    ]
    path.write_text(gap.join(parts) + "\n")
    x, y, expected = size_reference.grid(path)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(text_records, "BUFFER", buffer)
        found = read_grid(path, is_lonlat=False)
    assert np.array_equal(found.x, x)
    assert np.array_equal(found.y, y)
    assert np.array_equal(found.sizes, expected)


def test_places_without_a_size_may_hold_no_number(tmp_path):
    (tmp_path / "h.msh").write_text(
        "MSHID=3;EUCLIDEAN-GRID\nCOORD=1;2\n0\n1\nCOORD=2;2\n0\n1\nVALUE=4;1\nnan\n-inf\n1\nNaN\n"
    )
    assert np.array_equal(
        read_grid(tmp_path / "h.msh", is_lonlat=False).sizes, [[np.nan, 1], [-np.inf, np.nan]], equal_nan=True
    )
    (tmp_path / "h.sol").write_text(
        "MeshVersionFormatted 2\nDimension 2\nSolAtVertices 3 1 1 1 nan Infinity End"
    )
    assert np.array_equal(read_sol(tmp_path / "h.sol").values[:, 0], [1, np.nan, np.inf], equal_nan=True)
