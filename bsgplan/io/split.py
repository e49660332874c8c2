"""The quads of a file split into triangles, before anything else is made of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..mesh.quads import split_quads
from .file import RawMesh, check_quads


def split(raw: RawMesh) -> RawMesh:
    """Return what a reader found with its quads split into triangles, which stand after the others.

    Cell data that the quads lack are left out.
    """
    if not len(raw.quads):
        return raw
    check_quads(raw)
    triangles, quad = split_quads(raw.points, raw.quads)
    both = [name for name in raw.cell_data if name in raw.quad_data] if len(raw.triangles) else raw.quad_data
    lost = sorted(set(raw.cell_data) - set(both))
    notes = [f"{len(raw.quads)} quad{'s' if len(raw.quads) > 1 else ''} split along the better diagonal"]
    if lost:
        notes.append(f"cell data {', '.join(lost)} left out, the quads have none")
    empty = np.empty((0,))
    return replace(
        raw,
        triangles=np.concatenate([raw.triangles, triangles]),
        quads=np.empty((0, 4), dtype=np.int64),
        cell_data={
            name: np.concatenate([raw.cell_data.get(name, empty), raw.quad_data[name][quad]]) for name in both
        },
        quad_data={},
        ignored={name: count for name, count in raw.ignored.items() if name != "quad"},
        notes=(*raw.notes, *notes),
    )
