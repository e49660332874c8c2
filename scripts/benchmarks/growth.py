"""How the cost of planning grows from 20 thousand to 5 million triangles."""

from __future__ import annotations

from collections.abc import Iterator
from math import log

from bsgplan.pipeline import plan_blocks

from .cost import cpu_of
from .meshes import stripes
from .planning import fresh
from .row import Row

TITLE = "Growth"

SIZES = (20_000, 320_000, 5_000_000)

TOLERANCE = 1.5
"""Beyond n log n: caches hold 20 thousand triangles, and no mesh of five million."""


def rows() -> Iterator[Row]:
    """Measure one mesh of each size; a few long transitions, the same number whatever the size."""
    first: float | None = None
    for n in SIZES:
        mesh = stripes(n)
        mesh_file = fresh(mesh)
        _, cpu = cpu_of(lambda mesh_file=mesh_file: plan_blocks(mesh_file))
        share = cpu / (mesh.n_triangles * log(mesh.n_triangles))
        yield Row(f"{mesh.n_triangles} triangles", cpu / mesh.n_triangles * 1e6, "s CPU a million")
        if first is None:
            first = share
        else:
            yield Row(
                f"the same over n log n, against {SIZES[0]} triangles", share / first, "x", below=TOLERANCE
            )
