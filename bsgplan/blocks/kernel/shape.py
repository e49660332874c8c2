"""The shape of one triangle, finite also where it is inverted."""

from __future__ import annotations

import numpy as np

from ...compiled import inner

SOFT = 0.02
"""d of chi(r) = (r + sqrt(r^2 + 4 d^2)) / 2: areas under a fiftieth of the wanted one count as that."""

SHAPE = 1.0 / (2.0 * np.sqrt(3.0))
"""1 / q is this times the sum of squared edges over twice the area."""


@inner
def soft(r: float) -> float:
    """Return chi(r), positive, close to r where r is well above SOFT."""
    w = np.sqrt(r * r + 4.0 * SOFT * SOFT)
    if r >= 0.0:
        return 0.5 * (r + w)
    return 2.0 * SOFT * SOFT / (w - r)  # the other form underflows


@inner
def inverse_quality(ux: float, uy: float, vx: float, vy: float, wanted: float) -> float:
    """Return 1/q of the triangle 0, u, v; wanted is twice its wanted area, negative if it runs clockwise."""
    chi = soft((ux * vy - uy * vx) / wanted)
    squares = ux * ux + uy * uy + vx * vx + vy * vy + (vx - ux) ** 2 + (vy - uy) ** 2
    return SHAPE * squares / (abs(wanted) * chi)
