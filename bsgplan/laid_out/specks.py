"""Specks: components too small for a single block, hung on a point of the others or on nothing.

Coastal meshes have them: one or two triangles cut off by the digitised shore. No block of the wanted size
fits, so they are left out of a layout, and that is said.
"""

from __future__ import annotations

import logging

import numpy as np

from ..arrays import sums_by
from ..io import MeshFile
from ..io.part import part_of
from ..sizing import SizeField

log = logging.getLogger("bsgplan")


def without_specks(mesh_file: MeshFile, size: SizeField, *, side: int) -> tuple[MeshFile, SizeField]:
    """Return the mesh file and its sizes without the components that want less than one block.

    A block has side x side triangles. Nothing is left out where no component wants a whole one.
    """
    component = mesh_file.mesh.topology.component
    blocks = sums_by(component, size.triangle_weights, int(component.max()) + 1) / side**2
    is_speck = blocks < 1
    if not is_speck.any() or is_speck.all():
        return mesh_file, size
    inside = ~is_speck[component]
    mesh = mesh_file.mesh
    log.warning(
        "%s: %d components of less than one block left out, %d triangles and %.2g of the area in all; "
        "give fewer triangles a block to keep them",
        mesh_file.path, np.count_nonzero(is_speck), np.count_nonzero(~inside),
        float(mesh.areas[~inside].sum() / mesh.area),
    )  # fmt: skip
    cut, kept = part_of(mesh_file, inside)
    return cut, SizeField(cut.mesh, size.h[kept], size.source)
