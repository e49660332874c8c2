"""Front counts of a transition region, measured without drawing a contour.

Produces a `Profile`: elements f on the front at depth T (in layers of elements) between the fine and the
coarse end. By the co-area formula, per bin of log size u: f = sum(A |grad u| / h) / du, and the layers in
the bin are dT = sum(A / (sqrt(3)/2 h^2)) / f. Each triangle is spread over the levels it really spans.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints, frozen_floats, sums_by
from ..mesh.quality import lengths as lengths_of
from ..sizing import SizeField
from .bins import bin_edges, sums_over_bins

LEAST_COUNT = 1e-3
"""A front is given this many elements at least: in a region of one size no contour has a length."""

TINY = 1e-100
"""The least length of a front: positive."""

NO_CONTOUR = 1e-9
"""A bin with this share of a region's contours has none: its triangles have one size at all corners."""

MOST_TREND = 0.3
"""The ends of a region are corrected by a factor of e^0.3 at most, in size and in the length of fronts."""


MOST_GROWTH = 1.15
"""The front at an end is at most this many times as long as the longer of the two bins there: noise may
hide so much of it, but a tip that is really pointed stays pointed."""

NEARLY_FULL = 0.8
"""A front with this share of the highest count ends the ragged part of a fine end."""


@dataclass(frozen=True, eq=False)
class Profile:
    """Front counts of one region from its fine end (depth 0) to its coarse end (depth `layers`)."""

    depths: Floats
    """Depth of each station in layers of elements, (n,), increasing from 0."""
    counts: Floats
    """Elements on the front through each station, (n,)."""
    levels: Floats
    """Log size whose contour is that front, (n,), increasing."""
    lengths: Floats
    """Length of that front, (n,), length."""
    positions: Floats
    """Distance of that front from the fine end, (n,), length."""

    def __post_init__(self) -> None:
        for name in ("depths", "counts", "levels", "lengths", "positions"):
            object.__setattr__(self, name, frozen_floats(getattr(self, name)))

    @property
    def layers(self) -> float:
        """Layers of elements from the fine to the coarse front."""
        return float(self.depths[-1])

    @property
    def fronts(self) -> float:
        """Fronts of elements: one more than layers."""
        return self.layers + 1

    @property
    def fine_elements(self) -> float:
        """Elements on the fine front."""
        return float(self.counts[0])

    @property
    def coarse_elements(self) -> float:
        """Elements on the coarse front."""
        return float(self.counts[-1])

    def counts_at(self, depths: Floats) -> Floats:
        """Return elements on the fronts at these depths, (n,), linear between stations."""
        return np.interp(depths, self.depths, self.counts)

    def depths_at(self, log_h: Floats) -> Floats:
        """Return the depths in layers of the contours of these log sizes, (n,), clipped to the ends."""
        return np.interp(log_h, self.levels, self.depths)

    def levels_at(self, depths: Floats) -> Floats:
        """Return the log sizes of the fronts at these depths, (n,)."""
        return np.interp(depths, self.depths, self.levels)


def profiles(size: SizeField, label: Ints) -> list[Profile]:
    """Return the profile of each label, fine end first; label is one integer a triangle, 0 to n - 1."""
    edges, first = bin_edges(size, label)
    slope = lengths_of(size.triangle_slope) * size.mesh.areas
    values = (size.triangle_weights, slope / size.triangle_h, slope, size.mesh.areas)
    weight, front, length, area = sums_over_bins(size, label, edges, first, values)
    result = []
    for k in range(len(first) - 1):
        inside = slice(first[k], first[k + 1])
        own_edges = edges[first[k] + k : first[k + 1] + k + 1]
        sums = (weight[inside], front[inside], length[inside], area[inside])
        result.append(_profile(own_edges, *sums))
    return result


def _profile(edges: Floats, weight: Floats, front: Floats, length: Floats, area: Floats) -> Profile:
    """Return the profile of one region from the sums over its bins of log size.

    The sums are integrals over a bin: weight of triangles, front of f du, length of L du, area. Noise smears
    the two ends of a region over levels that hardly occur; such an end bin is shortened, by e^0.3 in size
    at most, until its front is as long as the fronts beside it, which keeps its sums.
    """
    edges, weight, front, length, area = _without_empty_bins(edges, weight, front, length, area)
    lengths = length / np.diff(edges)
    ends = np.empty(2)
    for side, inner, inner_edge in ((0, slice(1, 7), edges[1]), (-1, slice(-7, -1), edges[-2])):
        ends[side] = _end_length(edges, lengths, side, inner)
        kept, span = length[side] / ends[side], abs(edges[side] - inner_edge)
        if kept < span <= kept + MOST_TREND:
            edges[side] = inner_edge - kept if side == 0 else inner_edge + kept
        else:
            ends[side] = lengths[side]
    step = np.diff(edges)
    counts = np.maximum(front / step, LEAST_COUNT)
    weight, counts, lengths = _absorb_ragged_end(weight, counts, np.maximum(length / step, TINY))
    n_absorbed = len(step) - len(counts)
    edges = np.concatenate([edges[:1], edges[1 + n_absorbed :]])
    area = np.concatenate([[area[: n_absorbed + 1].sum()], area[n_absorbed + 1 :]])
    layers = weight / (2 * counts)
    ends[0] = max(ends[0], lengths[0])
    end_counts = ends / np.exp(edges[[0, -1]])
    if n_absorbed:  # the fine end was ragged: its front is the first full one
        ends[0], end_counts[0] = lengths[0], counts[0]
    return Profile(
        depths=_stations(layers),
        counts=np.concatenate([end_counts[:1], counts, end_counts[1:]]),
        levels=np.concatenate([edges[:1], (edges[1:] + edges[:-1]) / 2, edges[-1:]]),
        lengths=np.concatenate([ends[:1], lengths, ends[1:]]),
        positions=_stations(area / lengths),
    )


def _without_empty_bins(
    edges: Floats, weight: Floats, front: Floats, length: Floats, area: Floats
) -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """Return the edges and sums of the bins, each one without a contour drawn into the one before it.

    Few triangles of much weight (a named size far below the edges) need not reach every bin.
    """
    is_full = (weight > 0) & (length > NO_CONTOUR * length.sum())
    owner = np.maximum(np.cumsum(is_full) - 1, 0)
    n = int(owner[-1]) + 1
    edges = np.concatenate([edges[:1], edges[np.flatnonzero(is_full)[1:]], edges[-1:]])
    length = np.maximum(sums_by(owner, length, n), TINY)
    return edges, sums_by(owner, weight, n), sums_by(owner, front, n), length, sums_by(owner, area, n)


def _absorb_ragged_end(weight: Floats, counts: Floats, lengths: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the bins with a ragged fine end drawn into the first full front.

    Along a coast the finest size varies, so the lowest contours are short pieces and the counts first rise.
    Those triangles lie along the fine front and not before it: they become part of the first layer whose
    count comes near the highest, if they then take up no more than a third of all layers.
    """
    full = int(np.argmax(counts >= NEARLY_FULL * counts.max()))
    drawn = weight[: full + 1].sum() / (2 * counts[full])
    rest = (weight[full + 1 :] / (2 * counts[full + 1 :])).sum()
    if full == 0 or drawn > (drawn + rest) / 3:
        return weight, counts, lengths
    weight = np.concatenate([[weight[: full + 1].sum()], weight[full + 1 :]])
    return weight, counts[full:], lengths[full:]


def _end_length(edges: Floats, lengths: Floats, side: int, inner: slice) -> float:
    """Return the length of the front at one end, continued from the six bins beside it in log length."""
    if len(lengths) < 4:
        return float(lengths.max())
    middle = ((edges[1:] + edges[:-1]) / 2)[inner]
    logs = np.log(np.maximum(lengths[inner], 1e-12 * lengths.max()))
    slope = np.polyfit(middle - middle.mean(), logs, 1)[0]
    level = np.median(logs - slope * (middle - middle.mean()))
    nearest, end = (middle[0], edges[1]) if side == 0 else (middle[-1], edges[-2])
    further = np.clip(slope * (end - nearest), -MOST_TREND, MOST_TREND)
    length = np.exp(level + slope * (nearest - middle.mean()) + further)
    beside = lengths[:2] if side == 0 else lengths[-2:]
    return float(min(length, MOST_GROWTH * beside.max()))


def _stations(thickness: Floats) -> Floats:
    ends = np.cumsum(thickness)
    return np.concatenate([[0.0], ends - thickness / 2, ends[-1:]])
