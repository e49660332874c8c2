"""The price of a curved side: what snapping a block's boundary to its curve does to its triangles.

The row of triangles beside the side is laid out as the subdivision will lay it (four a side, nodes on the
curve, their displacement fading with the square of the distance), and each that is worse than the block
itself costs by how much.
"""

from __future__ import annotations

from ...compiled import inner
from ..kinds import JUNCTION
from .shape import inverse_quality
from .size_at import polyline_place
from .state import ARC, KIND, PARTS, State

STRAIGHT = 1e-3
"""A curve that leaves its chord by less than this share of it is straight."""


@inner
def side_arcs(state: State, t: int, side: int) -> tuple[int, float, float]:
    """Return the curve of a side and the arc lengths of its two ends, in the order of the triangle.

    Along a closed curve the later end in the direction of the curve has the larger arc, beyond the
    curve's length if need be.
    """
    code = state.triangle[t, 6 + side]
    c, is_against = code // 2, code % 2
    a, b = state.triangle[t, (side + 1) % 3], state.triangle[t, (side + 2) % 3]
    if is_against == 1:
        a, b = b, a
    length = state.curve_point[state.curve[c, 1] - 1, 2]
    start = 0.0 if state.vertex[a, KIND] == JUNCTION else state.value[a, ARC]
    end = length if state.vertex[b, KIND] == JUNCTION else state.value[b, ARC]
    if end <= start:
        end += length
    if is_against == 1:
        start, end = end, start
    return c, start, end


@inner
def bend(state: State, t: int, side: int, wanted: float) -> float:
    """Return the price of a side of triangle t, 0 where its curve is straight.

    The mean over the seven triangles beside it of max(0, (1/q) / (1/q of the block) - 1).
    """
    c, start, end = side_arcs(state, t, side)
    tip = state.triangle[t, side]
    a, b = state.triangle[t, (side + 1) % 3], state.triangle[t, (side + 2) % 3]
    ax, ay = state.point[a, 0], state.point[a, 1]
    ux, uy = state.point[b, 0] - ax, state.point[b, 1] - ay
    vx, vy = state.point[tip, 0] - ax, state.point[tip, 1] - ay
    square = ux * ux + uy * uy
    largest = 0.0
    moved = state.bow
    for i in range(1, PARTS):
        share = i / PARTS
        _, k, part = polyline_place(state, c, start + share * (end - start))
        x = state.curve_point[k, 0] + part * (state.curve_point[k + 1, 0] - state.curve_point[k, 0])
        y = state.curve_point[k, 1] + part * (state.curve_point[k + 1, 1] - state.curve_point[k, 1])
        moved[i, 0], moved[i, 1] = x - ax - share * ux, y - ay - share * uy
        largest = max(largest, moved[i, 0] ** 2 + moved[i, 1] ** 2)
    if largest <= STRAIGHT * STRAIGHT * square:
        return 0.0
    block = inverse_quality(ux, uy, vx, vy, wanted)
    fade = (1.0 - 1.0 / PARTS) ** 2
    total = 0.0
    lower_x, lower_y, upper_x, upper_y = 0.0, 0.0, vx / PARTS, vy / PARTS
    for i in range(PARTS):
        share = (i + 1) / PARTS
        next_x, next_y = share * ux + moved[i + 1, 0], share * uy + moved[i + 1, 1]
        ratio = inverse_quality(
            next_x - lower_x, next_y - lower_y, upper_x - lower_x, upper_y - lower_y, wanted / PARTS**2
        )
        total += max(0.0, ratio / block - 1.0)
        if i < PARTS - 1:
            # the row above has PARTS - 1 edges; its node i + 1 lies share (i + 1) / (PARTS - 1) along it
            along = (i + 1) / (PARTS - 1) * PARTS
            j = min(int(along), PARTS - 1)
            part = along - j
            dx = moved[j, 0] + part * (moved[j + 1, 0] - moved[j, 0])
            dy = moved[j, 1] + part * (moved[j + 1, 1] - moved[j, 1])
            above_x, above_y = vx / PARTS + share * ux + fade * dx, vy / PARTS + share * uy + fade * dy
            ratio = inverse_quality(
                next_x - above_x, next_y - above_y, upper_x - above_x, upper_y - above_y, -wanted / PARTS**2
            )
            total += max(0.0, ratio / block - 1.0)
            upper_x, upper_y = above_x, above_y
        lower_x, lower_y = next_x, next_y
    return total / (2 * PARTS - 1)
