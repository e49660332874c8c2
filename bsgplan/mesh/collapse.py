"""Collapse vertices into neighbours, one after the other: the compiled loop of `thinned`.

Corner c of the flat triangles belongs to triangle c // 3; its side runs from its vertex to the next one, and
twin is the same side of the triangle beyond. A vertex whose star is closed is merged into the neighbour from
which the star looks best, if every new triangle is good enough and no new edge is too long.
"""

from __future__ import annotations

from typing import NamedTuple

from ..arrays import Bools, Floats, Ints, Wholes
from ..compiled import compiled, inner

LONGEST = 3.2
"""A new edge is at most so many times as long as the edges were at each of its ends. Five triangles become
one: a block of 16 still has three."""

LEAST_QUALITY = 0.3
"""Mean ratio of new triangles at least."""

MOST_BESIDE = 16
"""A vertex of more edges stays."""

PASSES = 3
"""Times that every vertex is tried: what is too long in one place gives way in another."""

TIE = 1e-6
"""Mean ratios closer than this are equal, and the first is taken: a turned mesh is rounded otherwise."""

MEAN_RATIO = 2 * 3**0.5
"""Mean ratio: this times twice the area over the sum of the squared edges."""


class Corners(NamedTuple):
    """A triangulation that is being thinned; every array is changed in place."""

    points: Floats
    """Coordinates, (n_points, 2)."""
    square: Floats
    """Mean squared edge at each point, (n_points,); 0 at pinches and folds, where no new edge may end."""
    stays: Bools
    """Points that are not merged, (n_points,)."""
    vertex: Wholes
    """Point of each corner, (3 n_triangles,)."""
    twin: Wholes
    """The side beyond that of each corner, (3 n_triangles,); -1 at the boundary."""
    first: Wholes
    """A corner of each point, (n_points,)."""
    point: Wholes
    """What each point is merged into, (n_points,): itself where it is kept."""
    triangle: Wholes
    """What each triangle is merged into, (n_triangles,): itself where it is kept."""
    ring: Wholes
    """Room for the neighbours of a point, (MOST_BESIDE,)."""
    corner: Wholes
    """Room for the corners of a point, (MOST_BESIDE,)."""


@inner
def following(c: int) -> int:
    """Return the next corner of the same triangle."""
    return c - 2 if c % 3 == 2 else c + 1


@inner
def previous(c: int) -> int:
    """Return the corner before in the same triangle."""
    return c + 2 if c % 3 == 0 else c - 1


@compiled
def prepare(mesh: Corners, edge_sides: Ints, count: Wholes, gaps: Wholes) -> None:
    """Fill twin, square and first; keep both ends of boundary edges and of sides that run alike.

    edge_sides is that of the topology, (n_edges, 2); count and gaps are room, zeros, (n_points,).
    """
    for k in range(len(edge_sides)):
        c, other = edge_sides[k, 0], edge_sides[k, 1]
        mesh.twin[c] = other
        if other >= 0:
            mesh.twin[other] = c
        a, b = mesh.vertex[c], mesh.vertex[following(c)]
        if other < 0:
            gaps[a] += 1
            mesh.stays[a] = mesh.stays[b] = True
        elif mesh.vertex[other] == a:
            gaps[a] = gaps[b] = 2
            mesh.stays[a] = mesh.stays[b] = True
    for c in range(len(mesh.vertex)):
        a, b = mesh.vertex[c], mesh.vertex[following(c)]
        x, y = mesh.points[b, 0] - mesh.points[a, 0], mesh.points[b, 1] - mesh.points[a, 1]
        mesh.square[a] += x * x + y * y
        mesh.square[b] += x * x + y * y
        count[a] += 1
        count[b] += 1
        mesh.first[a] = c
    for v in range(len(count)):
        mesh.square[v] = mesh.square[v] / max(count[v], 1) if gaps[v] < 2 else 0.0


@compiled
def collapse_all(mesh: Corners) -> None:
    """Merge every point that may be merged, pass after pass; then follow all merges to their ends."""
    for _ in range(PASSES):
        for v in range(len(mesh.points)):
            if mesh.stays[v] or mesh.point[v] != v:
                continue
            n = _gather(mesh, v)
            at = _best_place(mesh, n)
            if at >= 0 and (n == 3 or _common_neighbours(mesh, mesh.ring[at], n) == 2):
                _merge(mesh, v, at, n)
    for into in (mesh.point, mesh.triangle):
        for k in range(len(into)):
            end = into[k]
            while into[end] != end:
                end = into[end]
            into[k] = end


@inner
def _gather(mesh: Corners, v: int) -> int:
    """Fill ring and corner counter-clockwise around a closed star; return its size, 0 where too large."""
    c = start = mesh.first[v]
    n = 0
    while n < MOST_BESIDE:
        mesh.corner[n] = c
        mesh.ring[n] = mesh.vertex[following(c)]
        n += 1
        c = mesh.twin[previous(c)]
        if c == start:
            return n
    return 0


@inner
def _best_place(mesh: Corners, n: int) -> int:
    """Return the place in the ring from which the worst triangle of the star is best, -1 for none."""
    best, at = LEAST_QUALITY, -1
    for j in range(n):
        quality = _worst_from(mesh, j, n, best + TIE)
        if quality > best + TIE:
            best, at = quality, j
    return at


@inner
def _worst_from(mesh: Corners, j: int, n: int, enough: float) -> float:
    """Return the least mean ratio of the star as a fan from place j; -1 where an edge is not allowed.

    Ends early once it is not more than enough. An edge between two points that stay would part what is one.
    """
    u = mesh.ring[j]
    x0, y0 = mesh.points[u, 0], mesh.points[u, 1]
    i = j + 1 if j + 1 < n else 0
    px, py = mesh.points[mesh.ring[i], 0] - x0, mesh.points[mesh.ring[i], 1] - y0
    p2 = px * px + py * py
    worst = 1.0
    for k in range(n - 2):
        i = i + 1 if i + 1 < n else 0
        r = mesh.ring[i]
        qx, qy = mesh.points[r, 0] - x0, mesh.points[r, 1] - y0
        q2 = qx * qx + qy * qy
        is_new = k < n - 3
        if is_new and (mesh.stays[u] and mesh.stays[r]):
            return -1.0
        if is_new and q2 > LONGEST**2 * min(mesh.square[u], mesh.square[r]):
            return -1.0
        third = (qx - px) ** 2 + (qy - py) ** 2
        worst = min(worst, MEAN_RATIO * (px * qy - py * qx) / (p2 + q2 + third))
        if worst <= enough:
            return worst
        px, py, p2 = qx, qy, q2
    return worst


@inner
def _common_neighbours(mesh: Corners, u: int, n: int) -> int:
    """Return how many points of the ring are joined to u: two, unless a merge would glue edges together.

    u has one fan, for no new edge may end at another.
    """
    found = 0
    c = start = mesh.first[u]
    while True:
        found += _is_in_ring(mesh, mesh.vertex[following(c)], n)
        beyond = mesh.twin[previous(c)]
        if beyond < 0:
            found += _is_in_ring(mesh, mesh.vertex[previous(c)], n)
            break
        c = beyond
        if c == start:
            return found
    c = start
    while mesh.twin[c] >= 0:
        c = following(mesh.twin[c])
        found += _is_in_ring(mesh, mesh.vertex[following(c)], n)
    return found


@inner
def _is_in_ring(mesh: Corners, v: int, n: int) -> int:
    for i in range(n):
        if mesh.ring[i] == v:
            return 1
    return 0


@inner
def _merge(mesh: Corners, v: int, at: int, n: int) -> None:
    """Merge v into the ring's point at a place: its star becomes a fan from there, two triangles go."""
    u, ahead, behind = mesh.ring[at], mesh.corner[at], mesh.corner[at - 1 if at else n - 1]
    left, right = mesh.vertex[previous(ahead)], mesh.vertex[following(behind)]
    for i in range(n):
        mesh.vertex[mesh.corner[i]] = u
    inside, beyond = mesh.twin[previous(ahead)], mesh.twin[following(ahead)]
    mesh.twin[inside] = beyond
    if beyond >= 0:
        mesh.twin[beyond] = inside
    mesh.triangle[ahead // 3] = inside // 3
    mesh.first[u], mesh.first[left] = inside, following(inside)
    inside, beyond = mesh.twin[behind], mesh.twin[following(behind)]
    mesh.twin[inside] = beyond
    if beyond >= 0:
        mesh.twin[beyond] = inside
    mesh.triangle[behind // 3] = inside // 3
    mesh.first[right] = inside
    mesh.point[v] = u
