"""Definitions that an output must satisfy, stated as assertions."""

from __future__ import annotations

import numpy as np

from bsgplan.io import MeshFile
from bsgplan.mesh import Mesh


def assert_is_mesh(mesh: Mesh) -> None:
    """Every point used, every triangle of positive area, every edge in one or two triangles."""
    assert mesh.triangles.min() == 0
    assert set(np.unique(mesh.triangles)) == set(range(mesh.n_points))
    assert (mesh.areas > 0).all()
    n_cells = (mesh.topology.edge_cells >= 0).sum(axis=1)
    assert set(n_cells.tolist()) <= {1, 2}
    assert not mesh.points.flags.writeable
    assert not mesh.triangles.flags.writeable


def assert_identity_holds(mesh: Mesh) -> None:
    """iota_m = -6 chi - 2 p, p the pinches."""
    topology = mesh.topology
    assert mesh.irregularity.total == -6 * topology.euler_characteristic - 2 * topology.n_pinches


def assert_is_mesh_file(mesh_file: MeshFile) -> None:
    """The mesh is one, data have its rows, boundaries its indices."""
    mesh = mesh_file.mesh
    assert_is_mesh(mesh)
    assert all(len(values) == mesh.n_points for values in mesh_file.point_data.values())
    assert all(len(values) == mesh.n_triangles for values in mesh_file.cell_data.values())
    for boundary in mesh_file.boundaries:
        assert ((boundary.nodes >= 0) & (boundary.nodes < mesh.n_points)).all()
        for array in (boundary.partners, boundary.columns):
            assert array is None or len(array) == boundary.n_nodes
