"""Hostile input: whatever stands in a file, the answer is a mesh or one line, in little time and memory."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest
from conftest import SHARED
from costs import read_or_refused
from hypothesis import given
from hypothesis import strategies as st
from predicates import assert_is_mesh_file
from seeds import INTEGERS, OWN, Seed, damaged, is_text, seeds

from bsgplan.cli import main
from bsgplan.errors import BsgplanError
from bsgplan.io import read

SEEDS = seeds()
FOLDER = SHARED / "meshes"
TWINS = ("oracle", "rivals")
"""Folders of the same meshes in another format, and of other programs' answers: read in test_real_meshes."""
FILES = [p for p in sorted(FOLDER.rglob("*")) if p.is_file() and p.parent.name not in TWINS]


def read_or_refuse(seed: Seed, folder, damaged_name: str, content: bytes) -> bool:
    """Read a damaged file: a valid mesh, or one line that is an error of ours; return whether it was read."""
    path = seed.written(folder, damaged_name, content)
    found, message = read_or_refused(lambda: read(path))
    if found is None:
        assert re.fullmatch(r"\S*seed[^:]*: .+", message)  # one line: a dot is no line's end
    else:
        assert_is_mesh_file(found)
        assert np.isfinite(found.mesh.points).all()
    return found is not None


def test_every_reader_of_ours_has_a_seed_that_it_reads(tmp_path):
    assert {seed.format.name for seed in SEEDS} == {own.name for own in OWN}
    for seed in SEEDS:
        found = read(seed.written(tmp_path))
        assert_is_mesh_file(found)
        assert found.format == seed.format.name


@pytest.mark.parametrize("seed", [s for s in SEEDS if is_text(s.files[s.main])], ids=repr)
def test_ends_of_lines_tabs_and_a_byte_order_mark_change_nothing(tmp_path, seed):
    expected = read(seed.written(tmp_path)).mesh
    for change in (
        lambda text: b"\xef\xbb\xbf" + text,
        lambda text: text.replace(b"\n", b"\r\n"),
        lambda text: text.replace(b" ", b"\t") if seed.format.name != "mfem" else text,
        lambda text: text.rstrip(b"\n"),
    ):
        for name, content in seed.files.items():
            found = read(seed.written(tmp_path, name, change(content))).mesh
            assert np.array_equal(found.points, expected.points)
            assert np.array_equal(found.triangles, expected.triangles)


@pytest.mark.parametrize("seed", SEEDS, ids=repr)
@given(data=st.data())
def test_a_damaged_file_is_read_as_a_mesh_or_refused_in_one_line(tmp_path, seed, data):
    name = data.draw(st.sampled_from(sorted(seed.files)))
    read_or_refuse(seed, tmp_path, name, data.draw(damaged(seed.files[name])))


@pytest.mark.parametrize("seed", SEEDS, ids=repr)
def test_a_file_cut_off_anywhere_is_read_or_refused(tmp_path, seed):
    for name, content in seed.files.items():
        for stop in range(0, len(content), max(len(content) // 60, 1)):
            read_or_refuse(seed, tmp_path, name, content[:stop])


@pytest.mark.parametrize("seed", SEEDS, ids=repr)
def test_a_number_of_any_size_anywhere_takes_no_memory(tmp_path, seed):
    """A header that claims 10^12 nodes is one of these."""
    for name, content in seed.files.items():
        if is_text(content):
            words = list(re.finditer(rb"\S+", content))
            step = max(len(words) // 60, 1)
            cases = [content[: w.start()] + b"1000000000000" + content[w.end() :] for w in words[::step]]
            cases += [content[: w.start()] + b"-7" + content[w.end() :] for w in words[::step]]
        else:
            big = INTEGERS[10:12]
            cases = [
                content[:start] + new + content[start + 4 :]
                for start in range(0, len(content), max(len(content) // 400 * 4, 4))
                for new in big
            ]
        for case in cases:
            read_or_refuse(seed, tmp_path, name, case)


@pytest.mark.parametrize("own", OWN, ids=lambda own: own.name)
@given(content=st.binary(max_size=300))
def test_garbage_after_any_signature_is_refused(tmp_path, own, content):
    seed = next(seed for seed in SEEDS if seed.format is own)
    head = seed.files[seed.main][:40]
    read_or_refuse(seed, tmp_path, seed.main, head + content)


@pytest.mark.parametrize("path", FILES, ids=[str(p.relative_to(FOLDER)) for p in FILES])
def test_every_shared_file_is_planned_or_refused_in_one_line(path, capsys):
    """Exit code 3 where the file is no mesh of triangles, 1 where it is one but no plan meets the request."""
    try:
        allowed = {3} if len(read(path).quads) else {0, 1}
    except BsgplanError:
        allowed = {3}
    code = main(["estimate", str(path), "--tris-per-block", "16", "--json"])
    out, err = capsys.readouterr()
    assert code in allowed
    assert "Traceback" not in err
    assert len([line for line in err.splitlines() if line.startswith("error: ")]) == (code != 0)
    if code == 0:
        document = json.loads(out, parse_constant=pytest.fail)
        assert document["schema"] == "bsgplan.estimate/1"
    else:
        assert out == ""
