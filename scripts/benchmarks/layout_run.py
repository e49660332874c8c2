"""A process of its own: one layout of a stored mesh, so that its peak of memory is its own.

    python layout_run.py mesh.npz side effort cost.json

The mesh has the arrays points and triangles. Stores blocks, triangles and CPU seconds of blocks and grid,
compilation aside.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import numpy as np

import bsgplan
from bsgplan.blocks import lay_out
from bsgplan.mesh import Mesh
from bsgplan.sizing import size_field

SMALL = Path(__file__).parents[2] / "cases" / "plate" / "mesh.msh"
"""Laid out first, so that everything is compiled."""


def main(mesh: str, side: int, effort: int, result: str) -> None:
    """Lay out the mesh and store what it cost."""
    lay_out(size_field(bsgplan.read(SMALL).mesh), tris_per_block=side**2, effort=1)
    arrays = np.load(mesh)
    size = size_field(Mesh(arrays["points"], arrays["triangles"]))
    start = time.process_time()
    ends: list[float] = []  # of stages; the first one that is done ends the blocks

    def hear(_: str, share: float) -> None:
        if share >= 1 and not ends:
            ends.append(time.process_time())

    grid = lay_out(size, tris_per_block=side**2, effort=effort, progress=hear)
    cost = {
        "n_blocks": grid.layout.n_blocks,
        "n_triangles": grid.n_triangles,
        "blocks": ends[0] - start,
        "grid": time.process_time() - ends[0],
    }
    Path(result).write_text(json.dumps(cost))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4])
