"""How many blocks or triangles there are where the size is limited in gradient, or capped."""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats
from .field import SizeField, covering


def gradient_limited_blocks(size: SizeField, side: float, slope: float, inside: Bools) -> float:
    """Return the blocks of a layout whose block size s h is limited in gradient: integral of 1 / block area.

    side is s; H is s h where |grad H| <= slope allows it. Counted over the triangles inside, (n_triangles,).
    """
    return float(covering(size.mesh, size.limited(side, slope))[inside].sum())


def capped_triangles(size: SizeField, cap: Floats, inside: Bools) -> float:
    """Return the triangles of a mesh of size min(h, cap) inside; cap and inside are one value a triangle."""
    finer = np.maximum(size.triangle_h / cap, 1.0) ** 2
    return float((size.triangle_weights * finer)[inside].sum())
