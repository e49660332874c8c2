"""Bins of log size, several a region: where each triangle's area lies between the levels it spans.

Produces bin edges of all regions in one array, bins of equal weight, and the bin of every sample level.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints
from ..sizing import SizeField

SAMPLES = 8
"""Levels by which the span of one triangle is represented: the share of its area below a level is then
right to a sixteenth of the triangle."""

TRIANGLES_PER_BIN = 24
"""A bin holds at least so many triangles: about 30 % noise each, 6 % in the mean."""

MOST_BINS = 48
"""More bins than this add noise and no shape: patterns have fewer fronts."""

LEAST_SPAN = 1e-9
"""A region of one size is given this span of log size, so that its bins are not empty."""


def bin_edges(size: SizeField, label: Ints) -> tuple[Floats, Ints]:
    """Return the bin edges of all regions in one array, and the first bin of each region, (n_labels + 1,)."""
    n_labels = int(label.max()) + 1
    log_h = size.log_h[size.mesh.triangles]
    middle = log_h.mean(axis=1)
    order = np.lexsort((middle, label))
    weight = size.triangle_weights[order]
    total = np.bincount(label, size.triangle_weights, n_labels)
    n_bins = np.clip(total / TRIANGLES_PER_BIN, 1, MOST_BINS).astype(np.int64)
    low, high = np.full(n_labels, np.inf), np.full(n_labels, -np.inf)
    np.minimum.at(low, label, log_h.min(axis=1))
    np.maximum.at(high, label, log_h.max(axis=1))
    high = np.maximum(high, low + LEAST_SPAN)
    start = np.concatenate([[0], np.cumsum(np.bincount(label, minlength=n_labels))])
    edges = []
    for k in range(n_labels):
        own = slice(start[k], start[k + 1])
        share = np.cumsum(weight[own]) - weight[own] / 2
        inner = np.interp(np.arange(1, n_bins[k]) * total[k] / n_bins[k], share, middle[order[own]])
        ladder = np.linspace(
            low[k], high[k], n_bins[k] + 1
        )  # keeps the edges apart where all sizes are equal
        edges.append(0.999 * np.concatenate([low[k : k + 1], inner, high[k : k + 1]]) + 0.001 * ladder)
    return np.concatenate(edges), np.concatenate([[0], np.cumsum(n_bins)])


def bins_of_samples(size: SizeField, label: Ints, edges: Floats, first: Ints) -> Ints:
    """Return the bin of each sample level of each triangle, (n_triangles, SAMPLES)."""
    corners = np.sort(size.log_h[size.mesh.triangles], axis=1)
    low, middle, high = corners[:, :1], corners[:, 1:2], corners[:, 2:]
    share = (np.arange(SAMPLES) + 0.5) / SAMPLES
    below = low + np.sqrt(share * (middle - low) * (high - low))
    above = high - np.sqrt((1 - share) * (high - middle) * (high - low))
    levels = np.where(share * (high - low) <= middle - low, below, above)
    bottom, top = edges[first[:-1] + np.arange(len(first) - 1)], edges[first[1:] + np.arange(len(first) - 1)]
    span = top - bottom
    owner = np.repeat(np.arange(len(first) - 1), np.diff(first) + 1)
    ladder = 2 * owner + (edges - bottom[owner]) / span[owner]  # one increasing sequence for all regions
    where = 2 * label[:, None] + (levels - bottom[label, None]) / span[label, None]
    found = np.searchsorted(ladder, where, side="right") - 1 - label[:, None]
    result: Ints = np.clip(found, first[label][:, None], first[label + 1][:, None] - 1)
    return result
