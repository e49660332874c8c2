"""What a layout carries over from its file: boundaries in order, data, regions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from bsgplan.io import MeshFile, read
from bsgplan.laid_out import LaidOut, export, lay_out_file
from bsgplan.sizing import size_field

from .conftest import as_file, lattice


def assert_boundaries_cover(found: MeshFile) -> None:
    """Assert that every boundary edge of a mesh lies in exactly one boundary, none inside."""
    mesh = found.mesh
    rim = {tuple(e) for e in np.sort(mesh.topology.edges[mesh.topology.is_boundary_edge], axis=1).tolist()}
    listed: list[tuple[int, ...]] = []
    for boundary in found.boundaries:
        listed += [tuple(e) for e in np.sort(boundary.segments, axis=1).tolist()]
    assert len(listed) == len(set(listed))
    assert set(listed) == rim


@pytest.mark.parametrize("what", ["blocks_file", "grid_file"])
def test_every_side_has_one_boundary(plate: LaidOut, ocean: LaidOut, what: str) -> None:
    """The boundaries of both inputs cover the rim once; so must those of blocks and grid."""
    for laid in (plate, ocean):
        found = getattr(laid, what)()
        assert_boundaries_cover(found)
        assert [(b.kind, b.code, b.name) for b in found.boundaries] == [
            (b.kind, b.code, b.name) for b in laid.mesh_file.boundaries
        ]


def test_segments_keep_ends_order_and_direction(ocean: LaidOut) -> None:
    """First and last node stand where they stood, and the nodes between go one way."""
    grid = ocean.grid_file()
    for before, after in zip(ocean.mesh_file.boundaries, grid.boundaries, strict=True):
        old, new = ocean.mesh_file.mesh.points[before.nodes], grid.mesh.points[after.nodes]
        np.testing.assert_allclose(new[[0, -1]], old[[0, -1]], atol=1e-9)
        length = np.linalg.norm(np.diff(new, axis=0), axis=1).sum()
        assert length == pytest.approx(np.linalg.norm(np.diff(old, axis=0), axis=1).sum())


def test_numbers_at_nodes_follow_the_place(ocean: LaidOut) -> None:
    """The crest of the case is the x of its node, linear along a straight side: interpolation is exact."""
    grid = ocean.grid_file()
    crest = grid.boundaries[2]
    assert crest.columns is not None
    np.testing.assert_allclose(crest.columns[:, 0], grid.mesh.points[crest.nodes, 0], atol=1e-9)


def test_linear_depth_is_interpolated_exactly(ocean: LaidOut) -> None:
    """3 x - y at every vertex, of blocks and of the grid."""
    for found in (ocean.blocks_file(), ocean.grid_file()):
        x, y = found.mesh.points.T
        np.testing.assert_allclose(found.point_data["depth"], 3 * x - y, atol=1e-9)


def test_regions_stay_apart() -> None:
    """Two materials halve a square: no block straddles, each has its half's number, areas are the halves'."""
    mesh = lattice(16)
    region = np.where(mesh.centroids[:, 0] > 0.5, 9.0, 4.0)
    laid = lay_out_file(as_file(mesh, cell_data={"material": region}), size_field(mesh), side=2, effort=5)
    grid = laid.grid_file()
    np.testing.assert_array_equal(grid.cell_data["material"], np.where(grid.mesh.centroids[:, 0] > 0.5, 9, 4))
    np.testing.assert_array_equal(laid.block_region[grid.cell_data["block"]], grid.cell_data["region"])


def test_cell_arrays_say_what_they_are(plate: LaidOut) -> None:
    """side^2 triangles a block; the sizes square to the area; quality is the mean ratio."""
    blocks, grid = plate.blocks_file(), plate.grid_file()
    assert (np.bincount(grid.cell_data["block"]) == 16).all()
    assert (blocks.cell_data["level"] == 2).all()
    area = np.sqrt(3) / 4 * grid.cell_data["size"] ** 2
    assert area.sum() == pytest.approx(grid.mesh.areas.sum())
    np.testing.assert_array_equal(grid.cell_data["quality"], grid.mesh.qualities)
    is_off = blocks.point_data["irregularity"] != 0
    np.testing.assert_array_equal(is_off, plate.grid.layout.is_irregular)


def test_barriers_keep_their_pairs(meshes: Path, tmp_path: Path) -> None:
    """Three weirs of ADCIRC: as many nodes on both sides, heights within the input's."""
    mesh_file = read(meshes / "weirs_internal_overflow.fort.14")
    laid = lay_out_file(mesh_file, size_field(mesh_file.mesh), side=4, effort=20)
    export(laid.grid_file(), tmp_path / "grid.14")
    found = read(tmp_path / "grid.14")
    old = [b for b in mesh_file.boundaries if b.partners is not None]
    new = [b for b in found.boundaries if b.partners is not None]
    assert len(new) == len(old) == 3
    for before, after in zip(old, new, strict=True):
        assert after.columns is not None
        assert before.columns is not None
        assert after.partners is not None
        assert len(set(after.nodes.tolist())) == len(set(after.partners.tolist())) == after.n_nodes
        assert (after.columns.min(axis=0) >= before.columns.min(axis=0) - 1e-12).all()
        assert (after.columns.max(axis=0) <= before.columns.max(axis=0) + 1e-12).all()


def test_the_open_boundary_of_abaco_is_carried(meshes: Path, tmp_path: Path) -> None:
    """Lengths of open, mainland and island; depth within the input's range; fort.14 reads back."""
    mesh_file = read(meshes / "bahamas_bight_of_abaco.fort.14")
    laid = lay_out_file(mesh_file, size_field(mesh_file.mesh), side=4, effort=5)
    export(laid.grid_file(), tmp_path / "grid.14")
    found = read(tmp_path / "grid.14")
    assert [(b.kind, b.code) for b in found.boundaries] == [("open", None), ("land", 0), ("land", 1)]
    n_rim = np.count_nonzero(found.mesh.topology.is_boundary_edge)
    assert sum(b.n_nodes for b in found.boundaries) == n_rim + 2  # the two where open and land meet
    depth, old = found.point_data["depth"], mesh_file.point_data["depth"]
    assert old.min() - 1e-12 <= depth.min() <= depth.max() <= old.max() + 1e-12
