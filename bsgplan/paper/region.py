"""Figure 9: a transition region inside an unstructured mesh, measured on the case `rectangle`.

The paper's own mesh is not at hand; the case has its numbers by construction, 28 elements to 4 over the
length of 10 to 11 fronts. The case lies beside the sources, not in an installed package.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..io import read
from ..mesh import Mesh
from ..pipeline import cut_out, plan_blocks
from ..regions.selection import parse_region
from .item import Number, Section, items_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CASE = Path(__file__).parents[2] / "cases" / "rectangle"
"""The folder of the case."""
SHOWN = 0.3
"""Of the mesh on either side of the region, in heights."""


def figure_9(case: Path = CASE) -> Section:
    """Return the region's elements at both ends, fronts, triangles, quality and irregularity."""
    title = "Figure 9: a region of an unstructured mesh"
    text = (
        "The paper's mesh is not at hand. Ours is the case `rectangle`, another mesh with such a region in "
        "its middle, so only the fronts are compared. iota+ counts vertices strictly inside."
    )
    if not (case / "case.toml").is_file():
        why = "not measured: the folder cases/rectangle is not there; run from the repository."
        return Section("figure_9", title, text, items_of("figure_9", {}), skipped=why)
    polygon = parse_region(tomllib.loads((case / "case.toml").read_text(encoding="utf-8"))["region"])
    whole = read(case / "mesh.msh")
    region = plan_blocks(whole, region=polygon).plan.regions[0]
    column = "paper"
    ours: dict[tuple[str, str], Number] = {
        ("fine end, elements", column): region.profile.fine_elements,
        ("coarse end, elements", column): region.profile.coarse_elements,
        ("fronts", column): region.profile.fronts,
        ("triangles", column): region.n_triangles,
        ("q_min", column): region.q_min,
        ("iota+", column): region.irregularity.positive,
    }
    inside = cut_out(whole, polygon).mesh

    def draw() -> Figure:
        return _draw(whole.mesh, inside)

    return Section("figure_9", title, text, items_of("figure_9", ours), draw)


def _draw(whole: Mesh, inside: Mesh) -> Figure:
    from matplotlib.collections import PolyCollection
    from matplotlib.figure import Figure

    from .sketch import BLUE, LINE, RED

    left, right = inside.points[:, 0].min() - SHOWN, inside.points[:, 0].max() + SHOWN
    figure = Figure(figsize=(5.4, 3.4), dpi=150, layout="constrained")
    axes = figure.add_subplot()
    for mesh, fill in ((whole, "white"), (inside, "#f6e3b4")):
        corners: Any = mesh.points[mesh.triangles]
        axes.add_collection(PolyCollection(corners, facecolors=fill, edgecolors=LINE, linewidths=0.4))
    irregular = np.where(whole.topology.is_boundary, 0, whole.vertex_irregularity)
    for sign, colour in ((1, RED), (-1, BLUE)):
        x, y = whole.points[sign * irregular > 0].T
        axes.scatter(x, y, s=9, color=colour, linewidths=0, zorder=3)
    axes.autoscale_view()
    axes.set_xlim(left, right)
    axes.set_aspect("equal")
    axes.axis("off")
    return figure
