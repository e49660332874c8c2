"""The noun Features: what of a mesh file a layout must respect, found before any block is laid."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Ints
from ..errors import InvalidOption
from ..io import MeshFile
from ..io.boundary import labels
from ..io.whole import MATERIAL_ARRAYS
from ..sizing import SizeField
from .barriers import barrier_pairs
from .tracks import changes, find_tracks

log = logging.getLogger("bsgplan")

SMALLEST_REGION = 4
"""Interfaces are followed where half of the regions, or more, have room for this many blocks."""


@dataclass(frozen=True, eq=False)
class Features:
    """Interfaces and points that stay, for `lay_out(..., interfaces=, kept=)`."""

    interfaces: Bools
    """Interior edges of `mesh.topology` that no block crosses, (n_edges,)."""
    kept: Ints
    """Points that must be corners of blocks, (k,), sorted."""
    region_array: str | None
    """Name of the cell array that tells materials apart; None where the mesh is of one material."""


def find_features(
    mesh_file: MeshFile, size: SizeField, *, side: int, keep: Iterable[str | int] = ()
) -> Features:
    """Return what a layout of this file with side x side triangles a block must respect.

    Material interfaces; points where one boundary follows another; pairs of barrier nodes a block apart,
    so that both sides are cut alike; and what keep names: a boundary or inner line by its name (`open 1`,
    `land 2` where it has none), a point by its number from 0. Raises InvalidOption for a name that is
    not there.
    """
    mesh = mesh_file.mesh
    topology = mesh.topology
    array = region_array(mesh_file)
    interfaces = np.zeros(len(topology.edges), dtype=bool)
    if array is not None:
        region = mesh_file.cell_data[array]
        pair = topology.edge_cells
        number = np.unique(region, return_inverse=True)[1]
        blocks = np.bincount(number, size.triangle_weights) / side**2
        if np.median(blocks) >= SMALLEST_REGION:
            interfaces = ~topology.is_boundary_edge & (region[pair[:, 0]] != region[pair[:, 1]])
        else:
            log.warning(
                "%s: half of the %d regions of %s would get fewer than %d blocks, blocks do not follow their "
                "interfaces; give fewer triangles a block",
                mesh_file.path, len(blocks), array, SMALLEST_REGION,
            )  # fmt: skip
    tracks = find_tracks(mesh, mesh_file.boundaries)
    lines, points = _named(mesh_file, keep)
    held = np.array([track.boundary in lines for track in tracks.tracks], dtype=bool)
    if held.any():
        interfaces[tracks.edge[held[tracks.track]]] = True
        interfaces &= ~topology.is_boundary_edge
    for track, n_missing in zip(tracks.tracks, tracks.missing, strict=True):
        if n_missing:
            name = labels(mesh_file.boundaries)[track.boundary][1]
            log.warning(
                "%s: %d steps of boundary %s are no edges of the mesh, they are left out of the layout's",
                mesh_file.path, n_missing, name,
            )  # fmt: skip
    kept = [
        changes(mesh, topology.is_boundary_edge | interfaces, tracks),
        np.array(points, dtype=np.int64),
    ]
    pairs = barrier_pairs(mesh_file.boundaries, size, side, interfaces, np.unique(np.concatenate(kept)))
    return Features(interfaces, np.unique(np.concatenate([*kept, pairs])), array)


def region_array(mesh_file: MeshFile) -> str | None:
    """Return the first cell array of `MATERIAL_ARRAYS` with more than one whole number, or None."""
    for name in MATERIAL_ARRAYS:
        values = mesh_file.cell_data.get(name)
        if values is not None and values.ndim == 1 and np.isfinite(values).all():
            found = np.unique(values)
            if len(found) > 1 and (found == np.rint(found)).all():
                return name
    return None


def _named(mesh_file: MeshFile, keep: Iterable[str | int]) -> tuple[set[int], list[int]]:
    """Return the boundaries and the points that are named."""
    lines, points = set[int](), list[int]()
    made_here = np.arange(mesh_file.mesh.n_points)
    in_file = mesh_file.kept_points if len(mesh_file.kept_points) else made_here
    names = [(name, boundary.name) for (_, name), boundary in
             zip(labels(mesh_file.boundaries), mesh_file.boundaries, strict=True)]  # fmt: skip
    for word in keep:
        found = {k for k, both in enumerate(names) if str(word) in both}
        if found:
            lines |= found
        elif str(word).isdecimal():
            own = np.flatnonzero(in_file == int(word))
            if not len(own):
                raise InvalidOption(
                    f"--keep {word}: no point in use of {mesh_file.path} has this number; "
                    f"they count from 0 to {in_file[-1]}"
                )
            points.append(int(own[0]))
        else:
            there = ", ".join(name for name, _ in names) or "none"
            raise InvalidOption(
                f"--keep {word!r}: no boundary or line of {mesh_file.path} has this name; there are: {there}"
            )
    return lines, points
