"""Text read in a bounded buffer: the same whatever the buffer, every error with its line."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.errors import MeshReadError
from bsgplan.io import text_records
from bsgplan.io.text_records import TextRecords
from bsgplan.io.text_write import table_lines


def write(path, text):
    path.write_text(text)
    return path


@given(
    rows=st.lists(st.lists(st.integers(-(2**53), 2**53), min_size=1, max_size=5), min_size=1, max_size=30),
    gaps=st.lists(st.sampled_from(["", "\n", "  \n# a comment\n\n", "\r\n"]), min_size=31, max_size=31),
    buffer=st.sampled_from([1 << 20, 200, 101]),
    ends=st.sampled_from(["", "\n"]),
)
def test_rows_are_those_of_python_whatever_the_buffer(tmp_path, rows, gaps, buffer, ends):
    lines, text = [], ""
    for row, gap in zip(rows, gaps, strict=False):
        text += gap + " ".join(map(str, row)) + "\n"
        lines.append(text.count("\n"))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(text_records, "BUFFER", buffer)
        with TextRecords(write(tmp_path / "t", text.rstrip("\n") + ends), comment=b"#") as records:
            found = records.rows(len(rows), "a row")
            assert records.line() is None
    assert found.lengths.tolist() == [len(row) for row in rows]
    assert found.values.tolist() == [float(n) for row in rows for n in row]
    assert found.line_numbers.tolist() == lines


def test_lines_peeks_and_numbers_take_turns(tmp_path):
    text = "head 2\n\n1 2 # two\n3\n% no comment here\n"
    with TextRecords(write(tmp_path / "t", text), comment=b"#") as records:
        assert records.peek() == records.line() == b"head 2"
        assert records.peek() == b"1 2"
        assert records.rows(2, "a row").values.tolist() == [1, 2, 3]
        assert records.line() == b"% no comment here"
        assert records.line_number == 5
        assert records.line() is None
        assert records.peek() == b""


@pytest.mark.parametrize("buffer", [1 << 20, 12])
def test_numbers_end_at_a_word(tmp_path, monkeypatch, buffer):
    monkeypatch.setattr(text_records, "BUFFER", buffer)
    text = "1 2\n\n3\n4 5 6\n 7\n end 8\nlast\n"
    with TextRecords(write(tmp_path / "t", text), comment=b"#") as records:
        assert records.numbers("a node").tolist() == [1, 2, 3, 4, 5, 6, 7]
        assert records.line() == b"end 8"
        assert records.line_number == 6
        assert records.line() == b"last"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 2\n3 x\n", "line 2: a row has 'x', not a finite number"),
        ("1 2\n3 nan\n", "line 2: a row has 'nan'"),
        ("1 2\n3 4e999\n", "line 2: a row has '4e999'"),
        ("1 2\n3 0x10\n", "line 2: a row has '0x10'"),
        ("1 2\n3 4\x005\n", "line 2: a row has"),
        ("1 2\n3 4-5\n", "line 2: a row has '4-5'"),
        ("1 2\n", "the file ends after 1 of 2 lines, a row each"),
        ("1 2\n" + "3" * 2_000_000, "line 2 has more than 1048576 bytes"),
        ("1 2\n" + " 3" * 2_000_000, "line 2 has more than 1048576 bytes"),
    ],
)
def test_a_bad_row_is_named_by_its_line(tmp_path, text, message):
    with (
        TextRecords(write(tmp_path / "t", text), comment=b"#") as records,
        pytest.raises(MeshReadError, match=message),
    ):
        records.rows(2, "a row")


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=50))
def test_tables_come_back_to_the_last_bit(tmp_path, values):
    text = "".join(table_lines("%d %r\n", np.arange(len(values)), np.array(values)))
    with TextRecords(write(tmp_path / "t", text), comment=b"#") as records:
        found = records.rows(len(values), "a row").columns(0, 2, "a row")
    assert found[:, 1].tolist() == values
    assert found[:, 0].tolist() == list(range(len(values)))
