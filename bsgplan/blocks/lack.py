"""What a mesh lacks in quality: how many triangles are inverted, how far poor ones are from what will do."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..mesh.quality import corner_edge_lengths, mean_ratio, signed_areas
from .placed import PlacedMesh

POOR = 0.3
"""Triangles under this mean ratio are poor."""


def qualities(mesh: PlacedMesh) -> Floats:
    """Return the mean ratio of each triangle, negative where inverted, (n_triangles,)."""
    return mean_ratio(
        signed_areas(mesh.points, mesh.triangles), corner_edge_lengths(mesh.points, mesh.triangles)
    )


def lacks(quality: Floats) -> Floats:
    """Return by how much each triangle falls short of POOR, (n,).

    >>> lacks(np.array([0.9, 0.1, -0.2])).round(3).tolist()
    [0.0, 0.2, 0.5]
    """
    return np.maximum(POOR - quality, 0.0)


def merit(mesh: PlacedMesh) -> tuple[int, float, float]:
    """Return what a better mesh has more of: minus inverted triangles, minus the sum of lacks, the least q.

    The sum: one ear of a sharp bay is poor in every mesh and says nothing about the others.
    """
    quality = qualities(mesh)
    return -int(np.count_nonzero(quality <= 0)), -float(lacks(quality).sum()), float(quality.min())
