"""Chunks of text: the tables of Python, whatever the buffer, the comments and the spelling of a number."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.errors import MeshReadError
from bsgplan.io import chunks
from bsgplan.io.chunks import Lines, n_lines_of
from bsgplan.io.number_table import LARGEST_WHOLE, numbers_of, numbers_with_commas

COLUMNS = ("a", "b", "c")
WORDS = st.integers(-(10**20), 10**20).map(str) | st.floats(allow_nan=False, allow_infinity=False).map(repr)
ROWS = st.lists(
    st.tuples(
        st.lists(WORDS, min_size=3, max_size=3),
        st.sampled_from(["", "! one two", "4 5", "\r", "  "]),
        st.booleans(),
    ),
    min_size=1,
    max_size=30,
)


@given(rows=ROWS, buffer=st.sampled_from([1 << 20, 300, 97]), ends=st.sampled_from(["", "\n", "\n \n"]))
def test_tables_are_those_of_python_whatever_the_buffer(tmp_path, rows, buffer, ends):
    lines = []
    for words, rest, is_fortran in rows:
        spelt = [word.replace("e", "D") for word in words] if is_fortran else words
        lines.append(" ".join([*spelt, rest]))
    path = tmp_path / "t"
    path.write_text("\n".join(lines) + ends)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(chunks, "CHUNK_BYTES", buffer)
        assert n_lines_of(path) == len(rows)
        taken = Lines(path)
        parts = [*taken.take(1), *taken.take(len(rows) - 1)]
        rest = [line for chunk in taken.take() for line in chunk.lines]
    found = np.concatenate([chunk.table(COLUMNS, "a row") for chunk in parts])
    assert found.tolist() == [[float(word) for word in words] for words, _, _ in rows]
    assert np.concatenate([chunk.line_numbers for chunk in parts]).tolist() == list(range(1, len(rows) + 1))
    assert all(not line.strip() for line in rest)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 2 3\n4 5\n6 7 8 9\n", "line 2: a row needs 3 numbers"),
        ("1 2 3 4\n5 6\n", "line 2: a row needs 3 numbers"),
        ("1 2 3\n\n4 5 6\n", "line 2: blank"),
        ("1 2 3\n4 x 6\n", "line 2: a row has b 'x'"),
        ("1 2 3\n4 5 inf\n", "line 2: a row has c 'inf'"),
        ("1 2 3\n4 5 6;7\n", "line 2: a row has c '6;7'"),
    ],
)
def test_no_line_lends_a_number_to_the_next(tmp_path, text, message):
    (tmp_path / "t").write_text(text)
    (chunk,) = Lines(tmp_path / "t").take()
    with pytest.raises(MeshReadError, match=message):
        chunk.table(COLUMNS, "a row")


@pytest.mark.parametrize("number", [LARGEST_WHOLE + 1, 2**63, 10**30, -(2**63), -(10**30)])
def test_a_whole_number_too_large_for_an_integer_is_a_float(number):
    assert numbers_of(str(number).encode()).tolist() == [float(number)]


def test_numbers_that_are_whole_stay_integers():
    assert numbers_of(b"1 -2\n3").dtype == np.int64
    assert numbers_of(b"1 -2.0\n3").dtype == np.float64


@pytest.mark.parametrize(
    "text", ["", " ", " ,1", "1, ", "1,\n,1", ",", "1,", ",1", "1,,1", "1 1", "1,-", "1,x"]
)
def test_a_blank_between_commas_is_no_number(text):
    """By numpy it is -1."""
    n = text.count(",") + 1
    assert numbers_with_commas(text.encode(), n) is None
    assert numbers_with_commas(text.encode(), n + 1) is None
    assert numbers_with_commas(b" 1 ,\n2,-3e1", 3).tolist() == [1, 2, -30]
