"""The verb `lay_out_file`: a mesh file to its LaidOut, features kept and barriers paired."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ..blocks import lay_out
from ..io import MeshFile
from ..sizing import SizeField
from .features import Features, find_features
from .laid_out import LaidOut

ROUNDS = 12
"""Layouts tried to get the pairs of barriers: each keeps the points where either side was cut before."""


def lay_out_file(
    mesh_file: MeshFile, size: SizeField, *, side: int, keep: Iterable[str | int] = (), **options: Any
) -> LaidOut:
    """Return the layout of a mesh file with side x side triangles a block; options are those of `lay_out`.

    A file with paired barriers is laid out up to ROUNDS times, until both sides of each are cut alike. Raises
    what `lay_out` and `find_features` raise.
    """
    features = find_features(mesh_file, size, side=side, keep=keep)
    return lay_out_with(features, mesh_file, size, side=side, **options)


def lay_out_with(
    features: Features, mesh_file: MeshFile, size: SizeField, *, side: int, **options: Any
) -> LaidOut:
    """Return the layout of a mesh file whose features are known; see `lay_out_file`."""
    kept = features.kept
    for _ in range(ROUNDS):
        grid = lay_out(size, tris_per_block=side**2, interfaces=features.interfaces, kept=kept, **options)
        result = LaidOut(grid, mesh_file)
        if not len(result.unpaired_nodes):
            break
        kept = np.union1d(kept, result.unpaired_nodes)
    return result
