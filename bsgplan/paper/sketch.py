"""Pictures of triangulations with their irregular vertices, red where positive and blue where negative.

Produces matplotlib Figures without a window (no pyplot).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from string import ascii_lowercase
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import Floats, Ints
from ..mesh import Mesh
from ..patterns import Pattern, Realised, Shape, realise, relative_irregularity

if TYPE_CHECKING:
    from matplotlib.figure import Figure

RED, BLUE = "#c8102e", "#1f4fbf"
"""Irregular vertices of positive and of negative irregularity."""
FILL, LINE = "#fbfaf3", "#404040"
GAP, HEADING, MARGIN = 0.35, 0.5, 0.2
"""Between panels, above each and around all, inches."""
FEW = 30
"""Irregular vertices that are drawn large, however small their triangles."""
NUMBERED = 6.5
"""Diameter in points from which a disc carries its number."""


@dataclass(frozen=True, eq=False)
class Drawing:
    """A triangulation to draw."""

    title: str
    points: Floats
    """Corners, (n, 2), length."""
    triangles: Ints
    """Corner indices, (n_triangles, 3)."""
    irregular: Ints
    """Irregularity of each corner, (n,)."""

    @property
    def mesh(self) -> Mesh:
        """The same as a mesh."""
        return Mesh(self.points, self.triangles)


def drawing(title: str, pattern: Pattern, positions: Floats, *, title_has_quality: bool = False) -> Drawing:
    """Return the drawing of a straight pattern, height 1, irregularity relative to the unit square."""
    realised = realise(pattern, Shape.rectangle(float(positions[-1])), positions)
    if title_has_quality:
        q = Mesh(realised.points, realised.triangles).qualities
        title = f"{title}\nq_min {q.min():.3f}, mean {q.mean():.3f}"
    return drawing_of(title, realised)


def drawing_of(title: str, realised: Realised) -> Drawing:
    """Return the drawing of realised blocks, irregularity relative to the unit square."""
    return Drawing(title, realised.points, realised.triangles, relative_irregularity(realised))


def pattern_sheet(
    patterns: Sequence[str],
    positions: Callable[[Pattern], Floats],
    *,
    columns: int,
    height: float,
    title: Callable[[Pattern], str] | None = None,
    has_quality: bool = False,
) -> Figure:
    """Return a figure of straight patterns with their fronts where positions puts them.

    Titles are (a) 4:3:2:1, (b) .. where none is given, with the quality below if asked.
    """
    drawings = []
    for letter, text in zip(ascii_lowercase, patterns, strict=False):
        pattern = Pattern.parse(text)
        heading = f"({letter}) {pattern}" if title is None else title(pattern)
        drawings.append(drawing(heading, pattern, positions(pattern), title_has_quality=has_quality))
    return sheet(drawings, columns=columns, height=height)


def sheet(drawings: Sequence[Drawing], *, columns: int, height: float) -> Figure:
    """Return a figure with the drawings in rows of so many, each so many inches high."""
    from matplotlib.figure import Figure

    wide = [max(1.1, height * float(np.ptp(d.points[:, 0]) / np.ptp(d.points[:, 1]))) for d in drawings]
    rows = [range(i, min(i + columns, len(drawings))) for i in range(0, len(drawings), columns)]
    width = max(sum(wide[k] + GAP for k in row) for row in rows) - GAP + 2 * MARGIN
    tall = len(rows) * (height + HEADING) + 2 * MARGIN
    figure = Figure(figsize=(width, tall), dpi=150)
    for r, row in enumerate(rows):
        left = MARGIN
        for k in row:
            bottom = tall - MARGIN - (r + 1) * (height + HEADING)
            axes = figure.add_axes((left / width, bottom / tall, wide[k] / width, height / tall))
            _draw(axes, drawings[k], height)
            left += wide[k] + GAP
    return figure


def _draw(axes: Any, drawn: Drawing, height: float) -> None:
    from matplotlib.collections import PolyCollection

    points = drawn.points
    corners: Any = points[drawn.triangles]
    scale = 72 * height / float(np.ptp(points[:, 1]))
    lengths: Floats = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean(axis=1)
    thin = float(np.clip(0.05 * scale * np.median(lengths), 0.2, 0.9))
    axes.add_collection(
        PolyCollection(corners, facecolors=FILL, edgecolors=LINE, linewidths=thin, clip_on=False)
    )
    local = np.full(len(points), np.inf)
    np.minimum.at(local, drawn.triangles, lengths[:, None])
    smallest = 1.6 if np.count_nonzero(drawn.irregular) > FEW else 5.0
    sizes = np.clip(0.3 * scale * local, smallest, 10.0)
    for sign, colour in ((1, RED), (-1, BLUE)):
        at = sign * drawn.irregular > 0
        style: dict[str, Any] = {"color": colour, "linewidths": 0, "clip_on": False, "zorder": 4}
        axes.scatter(*points[at].T, s=sizes[at] ** 2, **style)
    for p in np.flatnonzero((drawn.irregular != 0) & (sizes >= NUMBERED)):
        text = f"{drawn.irregular[p]:+d}".replace("-", "\N{MINUS SIGN}")
        middle = {"ha": "center", "va": "center_baseline"}
        axes.text(*points[p], text, fontsize=0.6 * sizes[p], color="white", zorder=5, **middle)
    axes.set_xlim(points[:, 0].min(), points[:, 0].max())
    axes.set_ylim(points[:, 1].min(), points[:, 1].max())
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(drawn.title, fontsize=8)
