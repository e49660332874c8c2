"""Bins of log size, several a region: where each triangle's area lies between the levels it spans.

Produces bin edges of all regions in one array, bins of equal weight, and sums over the bins.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Floats, Ints, grouped, sums_by
from ..sizing import SizeField

TRIANGLES_PER_BIN = 24
"""A bin holds at least so many triangles: about 30 % noise each, 6 % in the mean."""

MOST_BINS = 48
"""More bins than this add noise and no shape: patterns have fewer fronts."""

LEAST_SPAN = 1e-9
"""A region of one size is given this span of log size, so that its bins are not empty."""


def bin_edges(size: SizeField, label: Ints) -> tuple[Floats, Ints]:
    """Return the bin edges of all regions in one array, and the first bin of each region, (n_labels + 1,)."""
    n_labels = int(label.max()) + 1
    a, b, c = (size.log_h[corner] for corner in size.mesh.triangles.T)
    lowest, highest = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    order, start = by_level(size, label)
    weight = size.triangle_weights[order]
    total = np.bincount(label, size.triangle_weights, n_labels)
    n_bins = np.clip(total / TRIANGLES_PER_BIN, 1, MOST_BINS).astype(np.int64)
    low, high = np.full(n_labels, np.inf), np.full(n_labels, -np.inf)
    np.minimum.at(low, label, lowest)
    np.maximum.at(high, label, highest)
    high = np.maximum(high, low + LEAST_SPAN)
    edges = []
    for k in range(n_labels):
        own = slice(start[k], start[k + 1])
        share = np.cumsum(weight[own]) - weight[own] / 2
        inner = np.arange(1, n_bins[k]) * total[k] / n_bins[k]
        inner = np.interp(inner, share, size.triangle_log_h[order[own]])
        ladder = np.linspace(
            low[k], high[k], n_bins[k] + 1
        )  # keeps the edges apart where all sizes are equal
        edges.append(0.999 * np.concatenate([low[k : k + 1], inner, high[k : k + 1]]) + 0.001 * ladder)
    return np.concatenate(edges), np.concatenate([[0], np.cumsum(n_bins)])


def by_level(size: SizeField, label: Ints) -> tuple[Ints, Ints]:
    """Return the triangles by label, each label's by their log size, and where those of each label begin."""
    order = size.finest_first
    by_label, start = grouped(label[order], int(label.max()) + 1)
    return order[by_label], start


def sums_over_bins(
    size: SizeField, label: Ints, edges: Floats, first: Ints, values: Sequence[Floats]
) -> list[Floats]:
    """Return the sums over the bins of values of the triangles, each spread over the levels it spans.

    By the area between the edges of a bin: log size is linear in a triangle. Bin by bin for all triangles at
    once, from that of its lowest corner on.
    """
    low, middle, high = _sorted_levels(size)
    bins = _bins(low, label, edges, first)
    sums = [np.zeros(int(first[-1])) for _ in values]
    rest, below = np.arange(len(label)), np.zeros(len(label))
    while len(rest):
        top = edges[bins + label[rest] + 1]
        goes_on = (high[rest] > top) & (bins + 1 < first[label[rest] + 1])
        share = np.ones(len(rest))
        further = np.flatnonzero(goes_on)
        at = rest[further]
        share[further] = _area_below(top[further], low[at], middle[at], high[at])
        for total, value in zip(sums, values, strict=True):
            total += sums_by(bins, (share - below) * value[rest], len(total))
        rest, below, bins = at, share[further], bins[further] + 1
    return sums


def _sorted_levels(size: SizeField) -> tuple[Floats, Floats, Floats]:
    a, b, c = (size.log_h[corner] for corner in size.mesh.triangles.T)
    low, high = np.minimum(a, b), np.maximum(a, b)
    middle = np.maximum(low, np.minimum(high, c))
    return np.minimum(low, c), middle, np.maximum(high, c)


def _area_below(level: Floats, low: Floats, middle: Floats, high: Floats) -> Floats:
    """Return the share of each triangle's area below a level between its lowest and its highest corner, (n,).

    >>> _area_below(np.array([1.0, 2.0]), *np.array([[0.0, 0], [1, 1], [2, 2]]))
    array([0.5, 1. ])
    """
    is_lower = level < middle
    tip = np.where(is_lower, low, high)
    with np.errstate(divide="ignore", invalid="ignore"):
        beside = (level - tip) ** 2 / (np.abs(middle - tip) * (high - low))
    return np.asarray(np.where(is_lower, beside, np.where(level < high, 1 - beside, 1.0)))


def _bins(levels: Floats, label: Ints, edges: Floats, first: Ints) -> Ints:
    """Return the bin of each level in the region of its label, (n,)."""
    regions = np.arange(len(first) - 1)
    bottom, top = edges[first[:-1] + regions], edges[first[1:] + regions]
    span = top - bottom
    owner = np.repeat(regions, np.diff(first) + 1)
    ladder = 2 * owner + (edges - bottom[owner]) / span[owner]  # one increasing sequence for all regions
    where = 2 * label + (levels - bottom[label]) / span[label]
    found = np.searchsorted(ladder, where, side="right") - 1 - label
    return np.asarray(np.clip(found, first[label], first[label + 1] - 1))
