"""Selafin by a slow twin that packs the published layout record by record."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from predicates import assert_is_mesh_file
from reference import SELAFIN_POINTS as POINTS
from reference import selafin
from strategies import meshes as random_meshes

from bsgplan.errors import MeshReadError, OutputError
from bsgplan.io import MeshFile, read
from bsgplan.io.selafin_write import boundary_numbers, write_selafin


@pytest.fixture
def small(reading):
    """A function that writes bytes as .slf and reads them."""
    return reading("small.slf")


@pytest.mark.parametrize("double", [False, True])
@pytest.mark.parametrize("order", [">", "<"])
@pytest.mark.parametrize("date", [False, True])
def test_both_precisions_and_byte_orders(small, double, order, date):
    found = small(selafin(double=double, order=order, date=date))
    assert_is_mesh_file(found)
    assert found.format == "selafin"
    assert found.title == "a basin"
    assert found.mesh.points.tolist() == [list(p) for p in POINTS]
    assert found.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert found.point_data["BOTTOM"].tolist() == [-1.5] * 4
    assert found.point_data["WATER DEPTH"].tolist() == [1.0, 1.25, 1.5, 1.75]
    assert found.point_data["ipobo"].tolist() == [1, 2, 3, 4]
    assert found.notes == ("variables of the last of 2 frames",)


def test_the_origin_is_added(small):
    found = small(selafin(origin=(1000, 2000)))
    assert found.mesh.points[0].tolist() == [1000, 2000]
    assert "origin (1000, 2000) added to the coordinates" in found.notes


def test_a_mesh_without_frames_and_a_frame_cut_off(small):
    assert set(small(selafin(frames=0)).point_data) == {"ipobo"}
    found = small(selafin(frames=2)[:-10])
    assert found.point_data["WATER DEPTH"].tolist() == [0.0, 0.25, 0.5, 0.75]
    assert any("bytes after the last whole frame left out" in note for note in found.notes)


@pytest.mark.parametrize(
    ("n_bytes", "message"),
    [
        (60, "the title needs 80 bytes, the file ends after 56"),
        (100, "the number of variables needs 4 bytes"),
        (250, "fetch the whole file"),
    ],
)
def test_truncated_files_are_refused(small, n_bytes, message):
    with pytest.raises(MeshReadError, match=message):
        small(selafin()[:n_bytes])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ((2, 4, 3, 1), (2**31 - 1, 4, 3, 1), "the connectivity has 25769803764 bytes, the record there 24"),
        ((2, 4, 3, 1), (2, 2**31 - 1, 3, 1), "has 8589934588 bytes, the record there 16"),
        ((2, 4, 3, 1), (-2, 4, 3, 1), "are no mesh"),
        ((1, 3, 4), (1, 3, 5), "element 1 names point 4"),
        ((8, 2, 0, 8), (8, 2**30, 0, 8), "variables do not fit"),
        ((8, 2, 0, 8), (8, 2, 0, 9), "the record of the number of variables has no end"),
    ],
)
def test_damaged_integers_are_refused(small, old, new, message):
    old_bytes, new_bytes = (struct.pack(f">{len(n)}i", *n) for n in (old, new))
    content = selafin()
    assert content.count(old_bytes) == 1
    with pytest.raises(MeshReadError, match=message):
        small(content.replace(old_bytes, new_bytes))


def test_prisms_are_refused_with_a_remedy(small):
    with pytest.raises(MeshReadError, match=r"elements of 6 nodes in 10 planes .* two-dimensional"):
        small(selafin(corners=6, planes=10))


def test_boundary_numbers_by_hand(tmp_path):
    """A square ring: outline first, counter-clockwise; the hole after it, clockwise."""
    outer = [(0, 0), (3, 0), (3, 3), (0, 3)]
    inner = [(1, 1), (2, 1), (2, 2), (1, 2)]
    triangles = [
        t for k in range(4) for t in ((k, (k + 1) % 4, k + 4), ((k + 1) % 4, (k + 1) % 4 + 4, k + 4))
    ]
    text = f"ring\n{len(triangles)} 8\n"
    text += "".join(f"{k} {x} {y} 0\n" for k, (x, y) in enumerate(outer + inner, 1))
    text += "".join(f"{k} 3 {a + 1} {b + 1} {c + 1}\n" for k, (a, b, c) in enumerate(triangles, 1))
    (tmp_path / "ring.14").write_text(text)
    numbers = boundary_numbers(read(tmp_path / "ring.14").mesh).tolist()
    start = numbers.index(1)
    assert [numbers[(start + k) % 4] for k in range(4)] == [1, 2, 3, 4]
    start = numbers.index(5)
    assert [numbers[4 + (start - 4 - k) % 4] for k in range(4)] == [5, 6, 7, 8]


@given(mesh=random_meshes(), seed=st.integers(0, 2**32 - 1))
def test_random_meshes_survive_to_the_last_bit(tmp_path, mesh, seed):
    values = np.random.default_rng(seed).normal(size=mesh.n_points)
    none = np.empty((0, 4), int)
    written = MeshFile("x", "test", mesh, none, np.empty((0, 2)), point_data={"h": values}, title="T")
    write_selafin(written, tmp_path / "random.slf")
    found = read(tmp_path / "random.slf")
    assert np.array_equal(found.mesh.points, mesh.points)
    assert np.array_equal(found.mesh.triangles, mesh.triangles)
    assert np.array_equal(found.point_data["h"], values)
    assert found.title == "T"
    numbers = found.point_data["ipobo"].astype(int)
    on_rim = mesh.topology.is_boundary
    assert np.array_equal(numbers > 0, on_rim)
    assert sorted(numbers[on_rim].tolist()) == list(range(1, on_rim.sum() + 1))


def test_quads_and_surfaces_have_no_place(tmp_path, meshes):
    for name, what in (("square_triquad.mesh", "200 quads"), ("bunny_adaptive.off", "surface in space")):
        with pytest.raises(OutputError, match=what):
            write_selafin(read(meshes / name), tmp_path / "x.slf")
    assert not list(tmp_path.iterdir())
