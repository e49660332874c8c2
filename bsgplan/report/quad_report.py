"""What the quads of a mesh are like, as plain data and as rows for a table: measured, never planned."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..arrays import Floats, Ints
from ..errors import InvalidMesh
from ..mesh.irregularity import mesh_irregularity, vertex_irregularity
from ..mesh.quads import quad_angles
from ..mesh.topology import topology
from .rows import Row, plain_irregularity, shown_irregularity, shown_share

QUAD_TOPOLOGY = (
    "n_components",
    "n_boundary_loops",
    "euler_characteristic",
    "irregularity",
    "irregular_interior",
    "n_interior",
    "irregular_boundary",
    "n_boundary",
)
"""Measures of quads that need a manifold mesh."""


def quad_measures(points: Floats, quads: Ints, *, scale: Floats | None = None) -> dict[str, Any] | None:
    """Return the measures of the quads of a mixed mesh, None where there are none.

    What is asked of a topology is None where the quads alone are no manifold mesh.
    """
    if not len(quads):
        return None
    sides = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    lengths = np.linalg.norm(points[sides[:, 1]] - points[sides[:, 0]], axis=1)
    if scale is not None:
        lengths = lengths / scale[sides].mean(axis=1)
    angles = np.degrees(quad_angles(points, quads))
    result: dict[str, Any] = {
        "n_quads": len(quads),
        "n_points": len(points),
        "edge_min": float(lengths.min()),
        "edge_max": float(lengths.max()),
        "angle_min": float(angles.min()),
        "angle_max": float(angles.max()),
    }
    try:
        topo = topology(quads, len(points))
        irregularity = mesh_irregularity(topo)
    except InvalidMesh:
        return {**result, **dict.fromkeys(QUAD_TOPOLOGY)}
    is_irregular, is_boundary = vertex_irregularity(topo) != 0, topo.is_boundary
    found = (
        topo.n_components,
        topo.n_boundary_loops,
        topo.euler_characteristic,
        plain_irregularity(irregularity),
        int(np.count_nonzero(is_irregular & ~is_boundary)),
        int(np.count_nonzero(~is_boundary)),
        int(np.count_nonzero(is_irregular & is_boundary)),
        int(np.count_nonzero(is_boundary)),
    )
    return {**result, **dict(zip(QUAD_TOPOLOGY, found, strict=True))}


def quad_rows(quads: Mapping[str, Any], unit: str) -> list[Row]:
    """Return the rows of the quads of a document, lengths in unit."""
    result: list[Row] = [("quads", f"{quads['n_quads']}", "")]
    if quads["irregularity"]:
        result += [
            ("components of quads", f"{quads['n_components']}", ""),
            (
                "irregularity of quads",
                shown_irregularity(quads["irregularity"]),
                "valence - optimal valence, summed",
            ),
            ("... inside", shown_share(quads["irregular_interior"], quads["n_interior"]), "vertices"),
            (
                "... on the boundary",
                shown_share(quads["irregular_boundary"], quads["n_boundary"]),
                "vertices",
            ),
        ]
    return [
        *result,
        ("angles of quads", f"{quads['angle_min']:.3g} .. {quads['angle_max']:.3g}", "degrees"),
        ("edge length of quads", f"{quads['edge_min']:.3g} .. {quads['edge_max']:.3g}", unit),
    ]
