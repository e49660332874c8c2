"""What a vertex may do and what a side lies on: the small numbers that meshes and kernels share."""

from __future__ import annotations

INTERIOR, SLIDING, CORNER, JUNCTION, FROZEN = 0, 1, 2, 3, 4
"""Kinds of vertices: free; on a curve; fixed, on one curve or none; fixed where curves meet or end; fixed,
its goal exact."""

NO_CURVE, FROZEN_SIDE = -1, -2
"""Codes of sides on no curve: free; never split, collapsed or flipped, both its ends being FROZEN."""

HALF_EDGE = 0.51
"""A fixed vertex takes any whole number of edges no farther from its goal than this: 90 degrees 2 or 3."""
