"""The vertices of a realised pattern moved for a larger q_min: front positions are only a start.

Inner vertices move freely, those on straight walls along them where asked; the vertices of the first and the
last front stay, for they must meet their neighbours, but where asked the last front moves as a whole. Each
round linearises the mean ratio q = 4 sqrt(3) A / (a^2 + b^2 + c^2) of every block and solves the linear
programme for the moves, none beyond a radius, that raise the smallest most. Only moves that do raise it are
made, so q_min never falls; the radius grows after them and shrinks where there are none. Deterministic.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse import csr_array, hstack

from ..arrays import Floats, Ints
from ..errors import InvalidOption
from .realise import Realised

RADIUS = 0.25
"""First radius of a move, in shortest edges."""
NARROWEST = 1e-6
"""Radius, in shortest edges, below which rounds end."""
LEAST_GAIN = 1e-7
"""Promised gain of q_min below which rounds end."""
WORK = 6000
"""Blocks times rounds, at most; but FEWEST rounds at least and MOST at most."""
FEWEST, MOST = 6, 120
STRAIGHT = 1e-9
"""Share of the height by which the vertices of a straight wall may differ: rounding."""


def move_vertices(realised: Realised, *, slides: bool = True, stretches: bool = False) -> Realised:
    """Return a realised pattern with its inner vertices moved so that its worst block is no worse.

    slides: vertices on the walls move along them, else they stay. stretches: the last front moves as a whole,
    so the length changes. Raises InvalidOption in space, for walls that are not straight (slides), and for
    rings (stretches).

    >>> from .pattern import Pattern
    >>> from .realise import realise
    >>> from .shape import Shape
    >>> start = realise(Pattern.parse("4:2:1"), Shape.rectangle(0.9), np.array([0, 0.4, 0.9]))
    >>> each = [signed_qualities(r.points, r.triangles) for r in (start, move_vertices(start))]
    >>> [round(float(q.min()), 2) for q in each]
    [0.78, 0.86]
    """
    freedom = _freedom(realised, slides=slides, stretches=stretches)
    points, triangles = np.array(realised.points), realised.triangles
    if freedom.shape[1] == 0:
        return realised
    corners = points[triangles]
    edge = float(np.sqrt(((corners - np.roll(corners, 1, axis=1)) ** 2).sum(axis=2).min()))
    radius, reached = RADIUS * edge, float(signed_qualities(points, triangles).min())
    for _ in range(int(np.clip(WORK // len(triangles), FEWEST, MOST))):
        moves, promised = _best_moves(points, triangles, freedom, radius)
        if promised - reached < LEAST_GAIN or radius < NARROWEST * edge:
            break
        moved = points + moves
        found = float(signed_qualities(moved, triangles).min())
        gained = (found - reached) / (promised - reached)
        if gained > 0:
            points, reached = moved, found
        radius *= 2.0 if gained > 0.75 else 0.4 if gained < 0.25 else 1.0
    return replace(realised, points=points)


def signed_qualities(points: Floats, triangles: Ints) -> Floats:
    """Return the mean ratio of triangles in the plane, (n_triangles,), below 0 where clockwise."""
    return _quality_parts(points, triangles)[0]


def _quality_parts(points: Floats, triangles: Ints) -> tuple[Floats, Floats]:
    """Return the mean ratio, (n,), and its gradient by each corner, (n, 3, 2), 1 / length."""
    corners = points[triangles]
    opposite = np.roll(corners, 1, axis=1) - np.roll(corners, -1, axis=1)  # edge facing each corner
    (x, y), (u, v) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    double_area = x * v - y * u
    squares = (opposite**2).sum(axis=(1, 2))
    q = 2 * np.sqrt(3) * double_area / squares
    # d(2A) / dp is the facing edge turned by 90 degrees; d(sum of squares) / dp = 6 p - 2 (sum of corners)
    turned = np.stack([-opposite[..., 1], opposite[..., 0]], axis=-1)
    pull = 6 * corners - 2 * corners.sum(axis=1, keepdims=True)
    gradient = (2 * np.sqrt(3) * turned - q[:, None, None] * pull) / squares[:, None, None]
    return q, gradient


def _best_moves(points: Floats, triangles: Ints, freedom: csr_array, radius: float) -> tuple[Floats, float]:
    """Return the moves that raise the smallest linearised mean ratio most, (n, 2), and what it becomes."""
    from scipy.optimize import linprog  # 0.1 s that planning alone need not spend

    q, gradient = _quality_parts(points, triangles)
    n_blocks, n_free = len(triangles), freedom.shape[1]
    column = (2 * triangles[:, :, None] + np.arange(2)).reshape(n_blocks, 6)
    slope = csr_array(
        (gradient.reshape(-1), (np.repeat(np.arange(n_blocks), 6), column.ravel())),
        shape=(n_blocks, points.size),
    )
    above = hstack([-(slope @ freedom), np.ones((n_blocks, 1))], format="csr")  # t - slope z <= q
    limits = [(-radius, radius)] * n_free + [(None, 1.0)]
    aim = np.zeros(n_free + 1)
    aim[-1] = -1.0
    solved = linprog(aim, A_ub=above, b_ub=q, bounds=limits, method="highs")
    if solved.x is None:
        return np.zeros_like(points), float(q.min())
    return np.asarray((freedom @ solved.x[:-1]).reshape(points.shape)), float(solved.x[-1])


def _freedom(realised: Realised, *, slides: bool, stretches: bool) -> csr_array:
    """Return what each free number moves: flattened points over free numbers, (2 n, n_free)."""
    points, front = realised.points, realised.front
    if points.shape[1] != 2:
        raise InvalidOption("vertices of rings in space are not moved; give a region in the plane")
    is_end = (front == 0) | (front == front[-1])
    is_wall = np.zeros(len(points), dtype=bool)
    if not realised.is_closed:
        is_wall[:-1] |= np.diff(front) != 0
        is_wall[1:] |= np.diff(front) != 0
        if slides and not _has_straight_walls(points, front):
            raise InvalidOption("the walls are not straight; keep the vertices on them where they are")
    moves = np.stack([~is_end & (slides | ~is_wall), ~is_end & ~is_wall], axis=-1)
    rows = np.flatnonzero(moves.ravel())
    columns = np.arange(len(rows))
    if stretches:
        if realised.is_closed:
            raise InvalidOption("rings have no last front that moves as a whole; keep the length")
        last = 2 * np.flatnonzero(front == front[-1])
        rows, columns = np.concatenate([rows, last]), np.concatenate([columns, np.full(len(last), len(rows))])
    n_free = int(columns.max(initial=-1)) + 1
    return csr_array((np.ones(len(rows)), (rows, columns)), shape=(points.size, n_free))


def _has_straight_walls(points: Floats, front: Ints) -> bool:
    first, last = np.flatnonzero(np.diff(front, prepend=-1)), np.flatnonzero(np.diff(front, append=-1))
    height = float(np.ptp(points[:, 1]))
    return all(float(np.ptp(points[wall, 1])) < STRAIGHT * height for wall in (first, last))
