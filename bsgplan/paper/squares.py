"""Figure 1: three triangulations of the unit square, irregularity by Definition 1."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..mesh import Mesh
from ..patterns import subdivide
from .item import Section, items_of
from .sketch import Drawing, sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def figure_1() -> Section:
    """Return the unit square, the same refined, and the same with one edge flipped."""
    drawings = _squares()
    ours = {}
    for row, drawn in drawings.items():
        measured = drawn.mesh.irregularity
        ours[row, "iota"] = measured.total
        ours[row, "iota+"] = measured.positive
        ours[row, "iota-"] = measured.negative

    def draw() -> Figure:
        return sheet(list(drawings.values()), columns=3, height=1.9)

    text = "Topology fixes the sum of irregularity; an edge flip adds as much to either sign."
    return Section("figure_1", "Figure 1: the unit square", text, items_of("figure_1", ours), draw)


def _squares() -> dict[str, Drawing]:
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    triangles = np.array([[0, 1, 3], [1, 2, 3]])  # the diagonal runs from upper left to lower right
    fine, children, _ = subdivide(points, triangles, 2)
    flipped = np.array(children)
    corner = int(np.flatnonzero((flipped == 0).any(axis=1))[0])  # the child at the lower left corner
    (a, b) = (int(v) for v in np.roll(flipped[corner], -int(np.argmax(flipped[corner] == 0)))[1:])
    other = next(t for t in range(len(flipped)) if t != corner and {a, b} <= set(flipped[t].tolist()))
    (apex,) = set(flipped[other].tolist()) - {a, b}
    flipped[corner], flipped[other] = (0, a, apex), (0, apex, b)
    meshes = {"a, unit square": Mesh(points, triangles), "b, refined": Mesh(fine, children)}
    meshes["c, edge flipped"] = Mesh(fine, flipped)
    return {
        name: Drawing(
            f"({name[0]}){name[2:]}\niota {i.total}: +{i.positive} / {i.negative}",
            m.points,
            m.triangles,
            m.vertex_irregularity,
        )
        for name, m in meshes.items()
        for i in [m.irregularity]
    }
