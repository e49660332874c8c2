"""Where region labels stand on a map, and colours that tell neighbours apart; no drawing in here.

Invariants: no two labels overlap; no two neighbouring regions have the same colour while the palette lasts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..mesh import Mesh

TRIED = 2000
"""Triangles of a region tried as the place of its label, at most."""

EM = 0.62
"""Width of a character in heights of the font."""

LINE = 1.25
"""Height of a line in heights of the font."""


@dataclass(frozen=True)
class Label:
    """A text at a place."""

    text: str
    anchor: tuple[float, float]
    """The spot it speaks of."""
    place: tuple[float, float]
    """Where its middle stands; away from the anchor where that is taken."""


def neighbour_pairs(mesh: Mesh, label: Ints) -> Ints:
    """Return pairs of regions with a common edge, (n, 2), each once."""
    pairs = label[mesh.topology.neighbours]
    pairs = np.sort(pairs[(pairs[:, 0] != pairs[:, 1]) & (pairs.min(axis=1) >= 0)], axis=1)
    return np.unique(pairs, axis=0)


def colour_indices(pairs: Ints, order: Sequence[int], n_colours: int) -> Ints:
    """Return a colour for each region, (n,), greedily in this order: the least used that no neighbour has.

    >>> colour_indices(np.array([[0, 1], [1, 2]]), [1, 0, 2], 2).tolist()
    [1, 0, 1]
    """
    colour = np.full(len(order), -1)
    n_used = np.zeros(n_colours, dtype=np.int64)
    beside: list[list[int]] = [[] for _ in order]
    for a, b in pairs.tolist():
        beside[a].append(b)
        beside[b].append(a)
    for region in order:
        taken = colour[beside[region]]
        cost = n_used + len(order) * np.bincount(taken[taken >= 0], minlength=n_colours).astype(bool)
        colour[region] = int(cost.argmin())
        n_used[colour[region]] += 1
    return colour


def anchors(centres: Floats, label: Ints, border: Floats, n: int) -> tuple[Floats, Floats]:
    """Return for each region its triangle centre farthest from any border, (n, 2), and that distance, (n,).

    centres are (n_triangles, 2), border points (n_border, 2); regions that are not seen get nan and 0.
    """
    from scipy.spatial import cKDTree  # 0.1 s that a plan without a figure need not spend

    tree = cKDTree(border) if len(border) else None
    spot, room = np.full((n, 2), np.nan), np.zeros(n)
    order = np.argsort(label, kind="stable")
    start = np.searchsorted(label[order], np.arange(n + 1))
    for k in range(n):
        own = centres[order[start[k] : start[k + 1]]]
        own = own[:: max(1, len(own) // TRIED)]
        if len(own):
            distance = np.ones(len(own)) if tree is None else tree.query(own)[0]
            spot[k], room[k] = own[distance.argmax()], distance.max()
    return spot, room


def place_labels(
    long: Sequence[str], short: Sequence[str], spots: Floats, room: Floats, font: float, box: Floats
) -> list[Label]:
    """Return labels that do not overlap, in the order given: the long text where it fits, else the short.

    spots (n, 2), room (n,), the height of the font and the box (2, 2) that holds them have one unit. A label
    without room at its spot moves away on a spiral, nearest free place first.
    """
    taken: list[tuple[float, float, float, float]] = []
    labels = []
    for texts, spot, free in zip(zip(long, short, strict=True), spots, room, strict=True):
        if not np.isfinite(spot).all():
            continue
        for text in texts:
            width, height = _extent(text, font)
            fits = np.hypot(width, height) / 2 < 1.15 * free
            if fits or text == texts[-1]:
                place = _free_place(spot, width, height, taken, box, stay=fits)
                if place is not None:
                    taken.append((*place, width, height))
                    labels.append(Label(text, (float(spot[0]), float(spot[1])), place))
                    break
    return labels


def _extent(text: str, font: float) -> tuple[float, float]:
    lines = text.split("\n")
    return EM * font * max(map(len, lines)), LINE * font * len(lines)


def _free_place(
    spot: Floats,
    width: float,
    height: float,
    taken: list[tuple[float, float, float, float]],
    box: Floats,
    *,
    stay: bool,
) -> tuple[float, float] | None:
    others = np.array(taken).reshape(-1, 4)
    low, high = box[0] + [width / 2, height / 2], box[1] - [width / 2, height / 2]
    for ring in range(1 if stay else 12):
        for angle in np.arange(max(1, 8 * ring)) * (2 * np.pi / max(1, 8 * ring)) + 0.4:
            place = spot + 0.75 * height * ring * np.array([np.cos(angle), np.sin(angle)])
            place = np.clip(place, low, np.maximum(low, high)) if ring == 0 else place
            inside = ((place >= low - 1e-9) & (place <= high + 1e-9)).all()
            gap = np.abs(others[:, :2] - place) - (others[:, 2:] + [width, height]) / 2
            if inside and not (gap < 0).all(axis=1).any():
                return float(place[0]), float(place[1])
    return None
