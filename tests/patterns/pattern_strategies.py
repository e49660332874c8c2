"""Hypothesis strategies: counts of fronts, and shapes of regions."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from bsgplan.patterns import Shape

COUNTS = st.lists(st.integers(1, 12), min_size=2, max_size=7).map(tuple)
RINGS = st.lists(st.integers(3, 14), min_size=2, max_size=6).map(tuple)


@st.composite
def shapes(draw, *, is_closed):
    n = draw(st.integers(2, 6))
    steps = draw(st.lists(st.floats(0.1, 2), min_size=n - 1, max_size=n - 1))
    lengths = draw(st.lists(st.floats(0.3, 4), min_size=n, max_size=n))
    return Shape(np.cumsum([0.0, *steps]), np.array(lengths) * (6 if is_closed else 1), is_closed)
