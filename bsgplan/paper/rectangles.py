"""Figures 6 and 7: a rectangle filled by isotropic remeshing, and by the optimal transition."""

from __future__ import annotations

from fractions import Fraction
from math import sqrt
from typing import TYPE_CHECKING

from ..arrays import Floats
from ..patterns import Pattern, Shape, Spacing, best_spacing, paper_spacing
from .item import Number, Section, items_of
from .remesher import NoRemesher, irregular_vertices, remeshed
from .sketch import Drawing, drawing, sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BEST = "fronts at best positions"


def figure_6() -> Section:
    """Return the transition from 40 to 10 elements, one less from front to front."""
    pattern, shape = Pattern(tuple(range(40, 9, -1))), Shape.rectangle(2.0)
    spacings = {"40:39:..:10": paper_spacing(pattern, shape), BEST: best_spacing(pattern, shape)}
    text = (
        "A rectangle of 2 x 1, layers as wide as the edges of their coarser front; that setting, found by "
        "trying, gives all three of the paper's numbers. With the fronts at their best positions q_min is "
        "higher."
    )
    title = "Figure 6: from 40 elements to 10"
    return _section("figure_6", title, text, pattern, shape, spacings, height=2.6)


def figure_7() -> Section:
    """Return the transition from 128 elements to 1, halving from front to front."""
    pattern, shape = Pattern(tuple(2**k for k in range(7, -1, -1))), Shape.rectangle(1.0)
    spacings = {"128:64:..:1": paper_spacing(pattern, shape)}
    text = "The unit square, same rule; counts that halve from front to front are h linear in x."
    title = "Figure 7: from 128 elements to 1"
    return _section("figure_7", title, text, pattern, shape, spacings, height=3.4)


def _section(
    key: str,
    title: str,
    text: str,
    pattern: Pattern,
    shape: Shape,
    spacings: dict[str, Spacing],
    *,
    height: float,
) -> Section:
    """Return the section; spacings are the front positions of (b) by name, height is a panel's, inches."""
    panels = {
        f"b, {name}": drawing(f"(b) {name}", pattern, spacing.positions) for name, spacing in spacings.items()
    }
    skipped = ""
    try:
        panels = {"a, isotropic remeshing": _remeshed(pattern, shape.length), **panels}
    except NoRemesher as error:
        skipped = f"(a) shows the paper's numbers alone: {error}."
    ours: dict[tuple[str, str], Number] = {}
    for row, drawn in panels.items():
        q = drawn.mesh.qualities
        ours[row, "triangles"] = len(q)
        ours[row, "q_min"], ours[row, "q_mean"] = float(q.min()), float(q.mean())
        ours[row, "irregular vertices"] = int((drawn.irregular != 0).sum())

    def draw() -> Figure:
        return sheet([_measured(drawn) for drawn in panels.values()], columns=2, height=height)

    fine, coarse = pattern.counts[0], pattern.counts[-1]
    equilateral = 4 / sqrt(3) * shape.length * fine * coarse  # integral of 4 / (sqrt(3) h^2), h linear
    text += (
        f" Remeshing (a): the paper's remesher is another one; ours, mmg, is given h linear from 1/{fine} to "
        f"{Fraction(1, coarse)}, which {equilateral:.0f} equilateral triangles would fill; its irregular "
        "vertices are counted without the corners."
    )
    return Section(key, title, text, items_of(key, ours), draw, skipped)


def _remeshed(pattern: Pattern, length: float) -> Drawing:
    """Draw a rectangle remeshed with h linear from the edges of the first front to those of the last."""
    fine, coarse = 1 / pattern.counts[0], 1 / pattern.counts[-1]

    def size(x: Floats) -> Floats:
        return fine + (coarse - fine) * x / length

    mesh = remeshed(length, size)
    return Drawing("(a) isotropic remeshing, mmg", mesh.points, mesh.triangles, irregular_vertices(mesh))


def _measured(drawn: Drawing) -> Drawing:
    q = drawn.mesh.qualities
    title = f"{drawn.title}\n{len(q)} triangles, q_min {q.min():.3f}, mean {q.mean():.3f}"
    return Drawing(title, drawn.points, drawn.triangles, drawn.irregular)
