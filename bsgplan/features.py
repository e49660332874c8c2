"""What of a mesh file a layout must keep: lines that no block may cross, points that must stay.

Regions of the file (physical surfaces, attributes) are always kept apart. Further features go by name: a cell
array, whose values are kept apart, or a boundary, of which lines inside are kept and, on the rim, the ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .arrays import Bools, Floats, Ints
from .errors import MeshReadError
from .io import MeshFile
from .mesh import Mesh

REGIONS = ("gmsh:physical", "attribute")
"""Cell arrays that name regions: physical surfaces of Gmsh, attributes of MFEM."""


@dataclass(frozen=True, eq=False)
class Features:
    """What a layout must keep."""

    interfaces: Bools
    """Interior edges that no block may cross, (n_edges,)."""
    points: Ints
    """Points that must be corners of blocks, (n,)."""


def features_of(mesh_file: MeshFile, names: Sequence[str] = ()) -> Features:
    """Return the features of a mesh file: its regions, and those of the given names.

    Raises MeshReadError for a name that is no cell array and no boundary of the file.
    """
    mesh = mesh_file.mesh
    interfaces = np.zeros(len(mesh.topology.edges), dtype=bool)
    is_kept = np.zeros(mesh.n_points, dtype=bool)
    for name in REGIONS:
        if name in mesh_file.cell_data:
            interfaces |= interfaces_of(mesh, mesh_file.cell_data[name])
    for name in names:
        if name in mesh_file.cell_data:
            interfaces |= interfaces_of(mesh, mesh_file.cell_data[name])
            continue
        groups = [b for b in mesh_file.boundaries if name in (b.name, b.kind, str(b.code))]
        if not groups:
            there = [*mesh_file.cell_data, *(b.name or b.code or b.kind for b in mesh_file.boundaries)]
            known = ", ".join(dict.fromkeys(map(str, there))) or "none"
            raise MeshReadError(f"{mesh_file.path}: nothing called {name!r} for --keep; the file has {known}")
        for group in groups:
            _keep_points(mesh, group.nodes, interfaces, is_kept)
    return Features(interfaces, np.flatnonzero(is_kept))


def interfaces_of(mesh: Mesh, values: Floats) -> Bools:
    """Return the interior edges between triangles of different values, (n_edges,); rows are compared whole."""
    first, second = mesh.topology.edge_cells.T
    rows = values.reshape(len(values), -1)
    return np.asarray(~mesh.topology.is_boundary_edge & (rows[first] != rows[second]).any(axis=1))


def _keep_points(mesh: Mesh, nodes: Ints, interfaces: Bools, is_kept: Bools) -> None:
    """Mark the inner edges between the nodes, those that lie alone, and where the nodes end on the rim."""
    topology = mesh.topology
    is_member = np.zeros(mesh.n_points, dtype=bool)
    is_member[nodes] = True
    both = is_member[topology.edges].all(axis=1)
    inside = both & ~topology.is_boundary_edge
    # an edge that leaves the line for the rim's own nodes is no part of it: both its ends lie on the rim
    inside &= ~topology.is_boundary[topology.edges].all(axis=1)
    is_full = is_member[mesh.triangles].all(axis=1)  # the third side of such a triangle cuts a bend short
    longest = np.take_along_axis(
        topology.cell_edges[is_full],
        mesh.edge_lengths[topology.cell_edges[is_full]].argmax(axis=1)[:, None],
        axis=1,
    )
    inside[longest] = False
    interfaces |= inside
    touched = np.zeros(mesh.n_points, dtype=bool)
    touched[topology.edges[both]] = True
    rim = topology.is_boundary_edge & (is_member[topology.edges].sum(axis=1) == 1)
    ends = topology.edges[rim]
    is_kept[ends[is_member[ends]]] = True
    is_kept[is_member & ~touched] = True
