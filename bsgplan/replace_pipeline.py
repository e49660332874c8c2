"""The whole flow of a replacement: what `bsgplan replace` and a notebook call."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace as with_changes

import numpy as np
from shapely.geometry.base import BaseGeometry

from .arrays import Bools, Ints
from .errors import InvalidOption
from .io import Boundary, MeshFile
from .io.whole import MATERIAL_ARRAYS
from .laid_out.shifted import free_edges, shifted
from .mesh.edges import edge_numbers
from .pipeline import triangles_in
from .regions.labels import connected
from .regions.segmentation import segment
from .remesh import replace
from .remesh.accept import Terms
from .remesh.graft import Graft
from .remesh.replace import EFFORT, SEED
from .replace_result import ReplacedMesh
from .sized import size_of


def replace_in(
    mesh_file: MeshFile,
    *,
    region: BaseGeometry | None = None,
    size: str | None = None,
    size_file: str | os.PathLike[str] | None = None,
    move_boundary: bool = False,
    terms: Terms = Terms(),  # noqa: B008 - frozen
    effort: int = EFFORT,
    seed: int = SEED,
    progress: Callable[[str, float], None] = lambda _, __: None,
    is_stopped: Callable[[], bool] = lambda: False,
) -> ReplacedMesh:
    """Return a mesh file with parts of its mesh replaced where that pays.

    region is a polygon in the coordinates of the file; without one the whole mesh is tried, and told by the
    regions of its size field. move_boundary lets points of the boundary slide along
    it, come and go. is_stopped ends the annealing early where it gives True. Boundaries, edges
    between materials, points of named groups and of quads stay.
    Raises what its steps raise.
    """
    progress("measuring sizes", 0.0)
    mesh = mesh_file.mesh
    field = size_of(mesh_file, size, size_file)
    if region is None:
        label = segment(field)[0] if mesh.is_planar else np.zeros(mesh.n_triangles, dtype=np.int64)
    else:
        inside = triangles_in(mesh_file, region)
        piece = connected(mesh, np.where(inside, 0, 1))
        label = np.full(mesh.n_triangles, -1, dtype=np.int64)
        label[inside] = np.unique(piece[inside], return_inverse=True)[1]
    fixed, free, carry = fixed_points(mesh_file), None, _renumbered
    if move_boundary:
        if len(mesh_file.quad_nodes):
            raise InvalidOption("--move-boundary: the mesh has quads; cut them first (--split-quads)")
        free, fixed = free_edges(mesh, mesh_file.boundaries)
        carry = _shifted
    replacement = replace(
        field,
        label=label,
        is_drawn=region is not None,
        fixed_edges=fixed_edges(mesh_file),
        fixed_points=fixed,
        free_edges=free,
        terms=terms,
        effort=effort,
        seed=seed,
        progress=progress,
        is_stopped=is_stopped,
    )
    return ReplacedMesh(mesh_file, replacement, regrafted(mesh_file, replacement.graft, carry))


def fixed_edges(mesh_file: MeshFile) -> Bools:
    """Return the interior edges that stay: between materials, and those of boundaries inside, (n_edges,)."""
    topology = mesh_file.mesh.topology
    pair, is_inside = topology.edge_cells, ~topology.is_boundary_edge
    result = np.zeros(len(topology.edges), dtype=bool)
    for name in MATERIAL_ARRAYS:
        values = mesh_file.cell_data.get(name)
        if values is not None and values.ndim == 1 and np.array_equal(values, np.rint(values)):
            result |= values[pair[:, 0]] != values[pair[:, 1]]
    for boundary in mesh_file.boundaries:
        edge = edge_numbers(mesh_file.mesh, boundary.segments)
        result[edge[edge >= 0]] = True
    return np.asarray(result & is_inside)


def fixed_points(mesh_file: MeshFile) -> Ints:
    """Return the points that stay, (k,): those of boundaries and groups, their partners, those of quads."""
    lists = [mesh_file.quad_nodes[mesh_file.quad_nodes >= 0]]
    for boundary in mesh_file.boundaries:
        lists.append(boundary.nodes)
        if boundary.partners is not None:
            lists.append(boundary.partners)
    return np.unique(np.concatenate(lists))


Carry = Callable[[MeshFile, Graft], tuple[Boundary, ...]]
"""How the boundaries of a file come to its new mesh."""


def _renumbered(mesh_file: MeshFile, graft: Graft) -> tuple[Boundary, ...]:
    return tuple(b.renumbered(graft.new_index) for b in mesh_file.boundaries)


def _shifted(mesh_file: MeshFile, graft: Graft) -> tuple[Boundary, ...]:
    return shifted(mesh_file.mesh, graft.mesh, graft.new_index, mesh_file.boundaries)


def regrafted(mesh_file: MeshFile, graft: Graft, carry: Carry = _renumbered) -> MeshFile:
    """Return the mesh file with the mesh of a graft: data carried over, boundaries by their points.

    Point data are exact at points that stayed and linear between old ones at others; cell data are those of
    the old triangle at the centroid.
    """
    projection, mesh = mesh_file.projection, graft.mesh
    new_index, kept = graft.new_index, np.flatnonzero(graft.new_index >= 0)
    degrees = mesh_file.degrees
    if projection is not None:
        degrees = projection.to_degrees(mesh.points)
        degrees[new_index[kept]] = mesh_file.file_points[kept]
    n_quads_own = int(np.count_nonzero(mesh_file.quad_nodes < 0))
    all_index = np.concatenate([new_index, mesh.n_points + np.arange(n_quads_own)])
    number = np.full(mesh.n_points, -1, dtype=np.int64)
    if len(mesh_file.kept_points):
        number[new_index[kept]] = mesh_file.kept_points[kept]
    return with_changes(
        mesh_file,
        mesh=mesh,
        point_data={name: graft.at_points(values) for name, values in mesh_file.point_data.items()},
        cell_data={name: graft.at_triangles(values) for name, values in mesh_file.cell_data.items()},
        boundaries=carry(mesh_file, graft),
        all_boundaries=tuple(b.renumbered(all_index) for b in mesh_file.all_boundaries),
        quad_nodes=np.where(mesh_file.quad_nodes >= 0, new_index[mesh_file.quad_nodes], -1),
        degrees=degrees,
        kept_points=number,
        is_renumbered=True,
    )
