"""One vertex moved to where the energy of its triangles is lower: never uphill, never inverting a triangle.

Free vertices take a Newton step with the analytic Hessian, made positive definite; sliding vertices the
step of a parabola through three places on their curve, on the full energy.
"""

from __future__ import annotations

import numpy as np

from ...compiled import inner
from ..kinds import INTERIOR, JUNCTION, SLIDING
from .energy import WANTED, refresh_triangle, triangle_energy, twice_area
from .fan import corner_of, fan_of
from .journal import keep_vertex
from .shape import SHAPE, SOFT, soft
from .size_at import look_up, place_on_curve
from .state import ARC, CURVE, KIND, POWER, QUALITY, SIZE, STAR, State, U, W

LONGEST = 0.35
"""Longest step, in wanted edge lengths."""

SHORTER, TRIES = 0.4, 4
"""A step that does not help is shortened by this factor, so many times."""

SLIDE = 0.12
"""Distance of the parabola's places on the curve, in wanted edge lengths."""

GAIN = 1e-9
"""A step must lower the energy by more than this."""


@inner
def relax_vertex(state: State, v: int) -> None:
    """Move a vertex to lower energy, inside a transaction; fixed vertices stay."""
    kind = state.vertex[v, KIND]
    if kind == INTERIOR:
        _relax_free(state, v)
    elif kind == SLIDING:
        _relax_sliding(state, v)


@inner
def _star(state: State, n: int) -> tuple[float, int]:
    """Return the energy of the fan in row STAR and how many of its triangles are inverted."""
    total, n_inverted = 0.0, 0
    for i in range(n):
        t = state.fan[STAR, i]
        total += triangle_energy(state, t)
        if twice_area(state, t) <= 0.0:
            n_inverted += 1
    return total, n_inverted


@inner
def _accept(state: State, n: int) -> None:
    for i in range(n):
        refresh_triangle(state, state.fan[STAR, i])


@inner
def _before(state: State, n: int) -> tuple[float, int]:
    total, n_inverted = 0.0, 0
    for i in range(n):
        t = state.fan[STAR, i]
        total += state.energy[t]
        if twice_area(state, t) <= 0.0:
            n_inverted += 1
    return total, n_inverted


@inner
def _relax_free(state: State, v: int) -> None:
    n, _ = fan_of(state, v, STAR)
    if n == 0:
        return
    gx, gy, hxx, hxy, hyy = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        dx, dy, dxx, dxy, dyy = _derivatives(state, state.fan[STAR, i], v)
        gx += dx
        gy += dy
        hxx += dxx
        hxy += dxy
        hyy += dyy
    step_x, step_y = _newton(gx, gy, hxx, hxy, hyy, np.exp(2.0 * state.value[v, U]))
    h = np.exp(state.value[v, U])
    length = np.sqrt(step_x * step_x + step_y * step_y)
    if not length > 1e-7 * h:
        return
    if length > LONGEST * h:
        step_x, step_y = step_x * LONGEST * h / length, step_y * LONGEST * h / length
    old_energy, old_inverted = _before(state, n)
    keep_vertex(state, v)
    x, y, u, w, hint = (
        state.point[v, 0],
        state.point[v, 1],
        state.value[v, U],
        state.value[v, W],
        state.vertex[v, 4],
    )
    for _ in range(TRIES):
        state.point[v, 0], state.point[v, 1] = x + step_x, y + step_y
        look_up(state, v)
        energy, n_inverted = _star(state, n)
        if energy < old_energy - GAIN and n_inverted <= old_inverted:
            _accept(state, n)
            return
        step_x, step_y = step_x * SHORTER, step_y * SHORTER
    state.point[v, 0], state.point[v, 1] = x, y
    state.value[v, U], state.value[v, W], state.vertex[v, 4] = u, w, hint


@inner
def _newton(gx: float, gy: float, hxx: float, hxy: float, hyy: float, area: float) -> tuple[float, float]:
    """Return the step -H^-1 g, H shifted until both its eigenvalues are positive."""
    mean, half = 0.5 * (hxx + hyy), 0.5 * (hxx - hyy)
    radius = np.sqrt(half * half + hxy * hxy)
    least = max(1e-3 * (abs(mean) + radius), 1e-6 / area)
    shift = max(0.0, least - (mean - radius))
    hxx += shift
    hyy += shift
    determinant = hxx * hyy - hxy * hxy
    return -(hyy * gx - hxy * gy) / determinant, -(hxx * gy - hxy * gx) / determinant


@inner
def _derivatives(state: State, t: int, v: int) -> tuple[float, float, float, float, float]:
    """Return gradient and Hessian of a triangle's quality and size energy in the place of vertex v.

    With Q = 1/q = k L / chi(r), L the sum of squared edges and r linear in the place: d^2 L = 4 I.
    """
    i = corner_of(state, t, v)
    a, b = state.triangle[t, (i + 1) % 3], state.triangle[t, (i + 2) % 3]
    ux, uy = state.point[a, 0] - state.point[v, 0], state.point[a, 1] - state.point[v, 1]
    vx, vy = state.point[b, 0] - state.point[v, 0], state.point[b, 1] - state.point[v, 1]
    wanted = WANTED / (state.value[v, W] + state.value[a, W] + state.value[b, W])
    r = (ux * vy - uy * vx) / wanted
    rx, ry = (uy - vy) / wanted, (vx - ux) / wanted
    squares = ux * ux + uy * uy + vx * vx + vy * vy + (vx - ux) ** 2 + (vy - uy) ** 2
    lx, ly = -2.0 * (ux + vx), -2.0 * (uy + vy)
    root = np.sqrt(r * r + 4.0 * SOFT * SOFT)
    chi = soft(r)
    slope = chi / root  # chi'
    curvature = 2.0 * SOFT * SOFT / (root * root * root)  # chi''
    k = SHAPE / wanted
    inverse = k * squares / chi
    first = slope / chi
    qx, qy = k * lx / chi - inverse * first * rx, k * ly / chi - inverse * first * ry
    second = inverse * (2.0 * first * first - curvature / chi)
    cross = k * first / chi
    qxx = 4.0 * k / chi - 2.0 * cross * lx * rx + second * rx * rx
    qyy = 4.0 * k / chi - 2.0 * cross * ly * ry + second * ry * ry
    qxy = -cross * (lx * ry + ly * rx) + second * rx * ry
    power = state.scalar[POWER]
    weight = state.scalar[QUALITY]
    outer = 0.0
    if power != 1.0:
        outer = weight * (power - 1.0) * inverse ** (power - 2.0)
        weight *= inverse ** (power - 1.0)
    log = np.log(chi)
    size_first = 2.0 * state.scalar[SIZE] * log * first
    size_second = 2.0 * state.scalar[SIZE] * (first * first + log * (curvature / chi - first * first))
    return (
        weight * qx + size_first * rx,
        weight * qy + size_first * ry,
        weight * qxx + outer * qx * qx + size_second * rx * rx,
        weight * qxy + outer * qx * qy + size_second * rx * ry,
        weight * qyy + outer * qy * qy + size_second * ry * ry,
    )


@inner
def room_on_curve(state: State, v: int, n: int) -> tuple[float, float]:
    """Return how far a sliding vertex is from its neighbours on the curve, behind and ahead.

    The fan of v is in row STAR.
    """
    c = state.vertex[v, CURVE]
    stop = state.curve[c, 1]
    length = state.curve_point[stop - 1, 2]
    arc = state.value[v, ARC]
    behind, ahead = arc, length - arc
    for i in range(n):
        t = state.fan[STAR, i]
        k = corner_of(state, t, v)
        for side, other in (((k + 2) % 3, (k + 1) % 3), ((k + 1) % 3, (k + 2) % 3)):
            code = state.triangle[t, 6 + side]
            if code < 0 or code // 2 != c:
                continue
            w = state.triangle[t, other]
            # v is the first end of the side in the triangle's order where the other end is the next corner
            is_ahead = (other == (k + 1) % 3) == (code % 2 == 0)
            if is_ahead:
                place = length if state.vertex[w, KIND] == JUNCTION else state.value[w, ARC]
                ahead = place - arc if place > arc else place + length - arc
            else:
                place = 0.0 if state.vertex[w, KIND] == JUNCTION else state.value[w, ARC]
                behind = arc - place if place < arc else arc - place + length
    return behind, ahead


@inner
def _relax_sliding(state: State, v: int) -> None:
    n, _ = fan_of(state, v, STAR)
    if n == 0:
        return
    behind, ahead = room_on_curve(state, v, n)
    c, arc = state.vertex[v, CURVE], state.value[v, ARC]
    h = np.exp(state.value[v, U])
    step = min(SLIDE * h, 0.3 * behind, 0.3 * ahead)
    if not step > 1e-7 * h:
        return
    middle, n_inverted = _before(state, n)
    keep_vertex(state, v)
    place_on_curve(state, v, c, arc - step)
    left, left_inverted = _star(state, n)
    place_on_curve(state, v, c, arc + step)
    right, right_inverted = _star(state, n)
    bow = left + right - 2.0 * middle
    if bow > 0.0:
        move = 0.5 * step * (left - right) / bow
        move = min(max(move, -LONGEST * h, -0.6 * behind), LONGEST * h, 0.6 * ahead)
        place_on_curve(state, v, c, arc + move)
        energy, inverted = _star(state, n)
        if energy < min(middle, left, right) - GAIN and inverted <= n_inverted:
            _accept(state, n)
            return
    if min(left, right) < middle - GAIN:
        is_left = left < right
        if (left_inverted if is_left else right_inverted) <= n_inverted:
            place_on_curve(state, v, c, arc - step if is_left else arc + step)
            _accept(state, n)
            return
    place_on_curve(state, v, c, arc)
