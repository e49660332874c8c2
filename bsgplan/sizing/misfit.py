"""How far edges are from the wanted size: one number."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints


def size_misfit(lengths: Floats, ends: Ints, log_size: Floats) -> float:
    """Return the rms of log(edge / wanted edge), the wanted density being the mean of that at its ends.

    lengths is (n_edges,), ends the points of each edge, (n_edges, 2), log_size one value a point.

    >>> size_misfit(np.array([2.0]), np.array([[0, 1]]), np.zeros(2)).__round__(4)
    0.6931
    """
    density = np.exp(-log_size)[ends].mean(axis=1)
    return float(np.sqrt((np.log(lengths * density) ** 2).mean()))
