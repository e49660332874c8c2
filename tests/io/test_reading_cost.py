"""Our text readers cost less than meshio's of ASCII MSH 2.2, per triangle, and keep memory bounded."""

from __future__ import annotations

import meshio
import numpy as np
import pytest
from costs import seconds, with_peak

from bsgplan.io import write
from bsgplan.io.file import MeshFile
from bsgplan.io.formats import BY_NAME
from bsgplan.mesh import Mesh

SIDE = 150
FILES = {
    "fort.14": "large.14",
    "2dm": "large.2dm",
    "triangle": "large.ele",
    "jigsaw": "jigsaw.msh",
    "gmsh1": "gmsh1.msh",
    "su2": "large.su2",
    "mfem": "mfem.mesh",
}
"""Every text format with a reader of ours."""
MOST_BYTES = 320
"""Bytes a triangle at the peak of a reader: the whole command has 1000."""
BUFFERS = 2**24
"""Bytes of the buffers beside that, whatever the size of the file."""


@pytest.fixture(scope="module")
def large(tmp_path_factory):
    """A folder with a grid of 45 000 triangles in every text format of ours and in MSH 2.2."""
    folder = tmp_path_factory.mktemp("large")
    random = np.random.default_rng(5021)
    x, y = np.meshgrid(np.arange(SIDE + 1.0), np.arange(SIDE + 1.0))
    points = np.column_stack([x.ravel(), y.ravel()]) + random.uniform(-0.2, 0.2, (x.size, 2))
    cell = np.arange(SIDE * SIDE)
    a, up = cell // SIDE * (SIDE + 1) + cell % SIDE, SIDE + 1
    triangles = np.concatenate(
        [np.column_stack([a, a + 1, a + up + 1]), np.column_stack([a, a + up + 1, a + up])]
    )
    mesh = MeshFile("made", "made", Mesh(points, triangles), np.empty((0, 4), np.int64), np.empty((0, 2)))
    for name, file in {**FILES, "gmsh": "large.msh"}.items():
        if name != "gmsh1":
            write(mesh, folder / file, format=name)
    nodes = "".join(f"{k} {x!r} {y!r} 0\n" for k, (x, y) in enumerate(points.tolist(), 1))
    cells = "".join(f"{k} 2 1 1 3 {a} {b} {c}\n" for k, (a, b, c) in enumerate((triangles + 1).tolist(), 1))
    (folder / FILES["gmsh1"]).write_text(
        f"$NOD\n{len(points)}\n{nodes}$ENDNOD\n$ELM\n{len(triangles)}\n{cells}$ENDELM\n"
    )
    return folder


@pytest.mark.parametrize("name", FILES)
def test_a_triangle_costs_less_than_in_meshio(large, name):
    ours = seconds(lambda: BY_NAME[name].read(large / FILES[name]))
    assert ours < seconds(lambda: meshio.gmsh.read(large / "large.msh"))


@pytest.mark.parametrize("name", FILES)
def test_the_memory_is_bounded(large, name):
    raw, peak = with_peak(lambda: BY_NAME[name].read(large / FILES[name]))
    assert len(raw.triangles) == 2 * SIDE * SIDE
    assert peak < MOST_BYTES * len(raw.triangles) + BUFFERS


@pytest.mark.parametrize("name", FILES)
def test_text_is_read_a_buffer_at_a_time(large, name, tmp_path):
    """Blanks at the ends of lines make a file twenty times as long or more, and its reader no larger."""
    for path in large.glob(FILES[name].replace(".ele", ".*e*")):
        (tmp_path / path.name).write_bytes(path.read_bytes().replace(b"\n", b" " * 1000 + b"\n"))
    padded = tmp_path / FILES[name]
    raw, peak = with_peak(lambda: BY_NAME[name].read(padded))
    assert np.array_equal(raw.triangles, BY_NAME[name].read(large / FILES[name]).triangles)
    assert peak < MOST_BYTES * len(raw.triangles) + BUFFERS < padded.stat().st_size
