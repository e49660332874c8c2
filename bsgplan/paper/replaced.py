"""Figure 8: a transition region of a Delaunay-refined mesh, replaced.

The paper's own mesh is not at hand; the case `transition` has such a region. The paper puts fronts of a
pattern there by hand, we the annealer. The case lies beside the sources, not in an installed package.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import TYPE_CHECKING

from ..io import read
from ..regions.selection import parse_region
from ..replace_pipeline import replace_in
from .item import Number, Section, items_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CASE = Path(__file__).parents[2] / "cases" / "transition"
"""The folder of the case."""


def figure_8(case: Path = CASE) -> Section:
    """Return triangles, irregular vertices inside and quality of the region before and after."""
    title = "Figure 8: a region of a mesh replaced"
    text = (
        "The paper's mesh is not at hand, so nothing is compared. Ours is the case `transition`, 28 elements "
        "to 4, meshed by Delaunay refinement; what is outside the region stays bit for bit."
    )
    if not (case / "case.toml").is_file():
        why = "not measured: the folder cases/transition is not there; run from the repository."
        return Section("figure_8", title, text, items_of("figure_8", {}), skipped=why)
    region = parse_region(tomllib.loads((case / "case.toml").read_text(encoding="utf-8"))["region"])
    result = replace_in(read(case / "mesh.msh"), region=region)
    part = result.replacement.parts[0]
    ours: dict[tuple[str, str], Number] = {}
    for row, measures in (("before", part.before), ("after", part.after)):
        ours[row, "triangles"] = measures.n_triangles
        ours[row, "irregular vertices"] = measures.irregular_interior
        ours[row, "q_min"] = measures.q_min

    def draw() -> Figure:
        drawn: Figure = result.figure()
        return drawn

    return Section("figure_8", title, text, items_of("figure_8", ours), draw)
