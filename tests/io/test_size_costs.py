"""Size files cost less than what meshio takes for the mesh, in a bounded buffer."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import meshio
import numpy as np
import pytest
from costs import seconds, with_peak

from bsgplan.io import write
from bsgplan.io.file import MeshFile
from bsgplan.io.pos_write import ARRAY, write_pos
from bsgplan.io.size_jigsaw import read_grid
from bsgplan.io.size_pos import read_pos
from bsgplan.io.size_sol import read_sol
from bsgplan.mesh import Mesh

SIDE = 230
MOST_BYTES = 8 << 20
"""Memory beside the result and the eighth by which it grows: buffers, whatever the size of the file."""


@pytest.fixture(scope="module")
def large(tmp_path_factory):
    """A folder with sizes on a grid of 105 800 triangles in every format, and the mesh in MSH 2.2."""
    folder = tmp_path_factory.mktemp("sizes")
    random = np.random.default_rng(50417)
    n = SIDE + 1
    x, y = np.meshgrid(np.arange(float(n)), np.arange(float(n)))
    points = np.column_stack([x.ravel(), y.ravel()]) + random.uniform(-0.2, 0.2, (n * n, 2))
    cell = np.arange(SIDE * SIDE)
    a = cell // SIDE * n + cell % SIDE
    triangles = np.concatenate(
        [np.column_stack([a, a + 1, a + n + 1]), np.column_stack([a, a + n + 1, a + n])]
    )
    sizes = random.uniform(0.5, 2, n * n)
    mesh_file = MeshFile(
        "made", "made", Mesh(points, triangles), np.empty((0, 4), np.int64), np.empty((0, 2)),
        point_data={ARRAY: sizes},
    )  # fmt: skip
    write(mesh_file, folder / "large.msh", format="gmsh")
    write_pos(mesh_file, folder / "large.pos")
    values = "".join(f"{size!r}\n" for size in sizes.tolist())
    (folder / "large.sol").write_text(
        f"MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n{n * n}\n1 1\n{values}End\n"
    )
    axis = "".join(f"{k}\n" for k in range(n))
    (folder / "grid.msh").write_text(
        f"MSHID=3;EUCLIDEAN-GRID\nNDIMS=2\nCOORD=1;{n}\n{axis}COORD=2;{n}\n{axis}VALUE={n * n};1\n{values}"
    )
    return folder


def pos(path: Path) -> list[np.ndarray]:
    """Return the arrays of a view."""
    found = read_pos(path, None)
    return [found.corners, found.sizes]


READERS: dict[str, Callable[[Path], list[np.ndarray]]] = {
    "large.pos": pos,
    "large.sol": lambda path: [read_sol(path).values],
    "grid.msh": lambda path: [read_grid(path, is_lonlat=False).sizes],
}


@pytest.mark.parametrize("name", ["large.sol", "grid.msh"])  # a view has twelve decimals a triangle
def test_sizes_cost_less_than_reading_the_mesh_costs_meshio(large, name):
    ours = seconds(lambda: READERS[name](large / name))
    assert ours < seconds(lambda: meshio.gmsh.read(large / "large.msh"))


@pytest.mark.parametrize("name", READERS)
def test_the_memory_is_that_of_the_result_and_a_few_buffers(large, name):
    arrays, peak = with_peak(lambda: READERS[name](large / name))
    assert peak < 1.125 * sum(array.nbytes for array in arrays) + MOST_BYTES


@pytest.mark.parametrize("name", READERS)
def test_blanks_take_no_memory(large, name, tmp_path):
    padded = (large / name).read_bytes().replace(b"\n", b" " * 800 + b"\n")
    (tmp_path / name).write_bytes(padded)
    arrays, peak = with_peak(lambda: READERS[name](tmp_path / name))
    for ours, expected in zip(arrays, READERS[name](large / name), strict=True):
        assert np.array_equal(ours, expected)
    assert peak < 1.125 * sum(array.nbytes for array in arrays) + MOST_BYTES < len(padded)
