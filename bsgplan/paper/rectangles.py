"""Figures 6 and 7: a rectangle filled by isotropic remeshing, and by the optimal transition."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..arrays import Floats
from ..patterns import Pattern, Shape, best_spacing, paper_spacing
from .item import Number, Section, items_of
from .remesher import NoRemesher, irregular_vertices, remeshed
from .sketch import Drawing, drawing, sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class _Case:
    key: str
    title: str
    pattern: Pattern
    name: str
    length: float
    height: float
    """Of a panel, inches."""
    has_best: bool
    text: str


def figure_6() -> Section:
    """Return the transition from 40 to 10 elements."""
    counts = tuple(range(40, 9, -1))
    text = (
        "A rectangle of 2 x 1, layers as wide as the edges of their coarser front; that setting, found by "
        "trying, gives all three of the paper's numbers. With the fronts at their best positions q_min is "
        "higher. Remeshing (a): ours is mmg with h linear from 1/40 to 1/10; the paper's remesher is another "
        "one."
    )
    return _section(
        _Case(
            "figure_6",
            "Figure 6: from 40 elements to 10",
            Pattern(counts),
            "40:39:..:10",
            2.0,
            2.6,
            True,
            text,
        )
    )


def figure_7() -> Section:
    """Return the transition from 128 elements to 1, halving."""
    counts = tuple(2**k for k in range(7, -1, -1))
    text = (
        "The unit square, same rule; counts that halve from front to front are h linear in x. "
        "Remeshing (a): ours is mmg with h linear from 1/128 to 1; the paper's remesher is another one."
    )
    return _section(
        _Case(
            "figure_7",
            "Figure 7: from 128 elements to 1",
            Pattern(counts),
            "128:64:..:1",
            1.0,
            3.4,
            False,
            text,
        )
    )


def _section(case: _Case) -> Section:
    shape = Shape.rectangle(case.length)
    panels = [
        (
            f"b, {case.name}",
            drawing(f"(b) {case.name}", case.pattern, paper_spacing(case.pattern, shape).positions),
        )
    ]
    if case.has_best:
        best = drawing(
            "(b) fronts at best positions", case.pattern, best_spacing(case.pattern, shape).positions
        )
        panels.append(("b, fronts at best positions", best))
    skipped = ""
    try:
        fine, coarse = 1 / case.pattern.counts[0], 1 / case.pattern.counts[-1]

        def size(x: Floats) -> Floats:
            return fine + (coarse - fine) * x / case.length

        mesh = remeshed(case.length, size)
        other = Drawing("(a) isotropic remeshing, mmg", mesh.points, mesh.triangles, irregular_vertices(mesh))
        panels.insert(0, ("a, isotropic remeshing", other))
    except NoRemesher as error:
        skipped = f"(a) shows the paper's numbers alone: {error}."
    ours: dict[tuple[str, str], Number] = {}
    drawings = []
    for row, drawn in panels:
        q, irregular = drawn.mesh.qualities, drawn.irregular
        ours[row, "triangles"] = len(drawn.triangles)
        ours[row, "q_min"], ours[row, "q_mean"] = float(q.min()), float(q.mean())
        ours[row, "irregular vertices"] = int((irregular != 0).sum())
        title = f"{drawn.title}\n{len(q)} triangles, q_min {q.min():.3f}, mean {q.mean():.3f}"
        drawings.append(Drawing(title, drawn.points, drawn.triangles, irregular))

    def draw() -> Figure:
        return sheet(drawings, columns=2, height=case.height)

    return Section(case.key, case.title, case.text, items_of(case.key, ours), draw, skipped)
