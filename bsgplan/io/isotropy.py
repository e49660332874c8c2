"""The warning where a mesh is stretched: whatever is planned of it has triangles as wide as long."""

from __future__ import annotations

import logging

import numpy as np

from .file import MeshFile

STRETCHED = 5.0
"""Ratio of the principal stretches from which a triangle counts as stretched."""
QUALITY = 2 * STRETCHED / (1 + STRETCHED**2)
"""Mean ratio of such a triangle: stretches s >= t make 2 s t / (s^2 + t^2) of an equilateral one."""
MANY = 0.02
"""Share of stretched triangles that is meant: slivers that a generator leaves are under one in a hundred,
layers along a wall a tenth and more."""


def warn_of_stretched(mesh_file: MeshFile) -> None:
    """Warn where many triangles are stretched, as in boundary layers: plans and layouts are isotropic."""
    n_triangles = mesh_file.mesh.n_triangles
    share = np.count_nonzero(mesh_file.mesh.qualities < QUALITY) / n_triangles
    if share > MANY:
        logging.getLogger("bsgplan").warning(
            "%s: %.0f %% of %d triangles are stretched over %g times, isotropy is assumed and layers along "
            "walls are lost; leave them out with --region, or give the sizes wanted with --size-file",
            mesh_file.path, 100 * share, n_triangles, STRETCHED,
        )  # fmt: skip
