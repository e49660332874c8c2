"""Size fields that blocks can follow: limited in gradient, or capped at a multiple of the finest size."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np

from ..arrays import Bools, Floats, Ints, Wholes, by_row
from ..mesh import Mesh
from ..mesh.quality import lengths as lengths_of
from .field import SizeField, covering

AT_ONCE = 1 << 15
"""Points of a wave that are handed on at a time: their links stay in a processor's cache."""


def limit_gradient(mesh: Mesh, size: Floats, slope: float) -> Floats:
    """Return the largest field below size whose gradient nowhere exceeds slope, (n_points,), length.

    min over y of size(y) + slope * distance(x, y), handed on until nothing is lowered. Distances run along
    edges and across pairs of triangles, at most 4 % longer than straight ones on regular meshes.

    >>> mesh = Mesh(np.array([[0.0, 0], [1, 0], [0, 1]]), np.array([[0, 1, 2]]))
    >>> limit_gradient(mesh, np.array([1.0, 5.0, 1.2]), 0.5)
    array([1. , 1.5, 1.2])
    """
    links, result = _links(mesh), np.array(size, dtype=np.float64)
    front = _lowered(result, links.ends, slope * links.lengths)
    if len(front):
        others, lengths, start = links.around
        steps = slope * lengths
    while len(front):  # the wave runs once as many links as the limit reaches: a few block edges
        is_lowered = np.zeros(mesh.n_points, dtype=bool)
        for part in np.array_split(front, 1 + len(front) // AT_ONCE):
            count = start[part + 1] - start[part]
            link = np.repeat(start[part] - np.cumsum(count) + count, count) + np.arange(count.sum())
            reached, value = others[link], np.repeat(result[part], count) + steps[link]
            is_less = value < result[reached]
            reached = reached[is_less]
            np.minimum.at(result, reached, value[is_less])
            is_lowered[reached] = True
        front = np.flatnonzero(is_lowered)
    return result


def _lowered(values: Floats, ends: Ints, steps: Floats) -> Ints:
    """Lower values over links, once each way, and return the points that were lowered, in order."""
    rise = values[ends[:, 1]] - values[ends[:, 0]]
    steep = np.flatnonzero(np.abs(rise) > steps)
    first, second = ends.take(steep, axis=0).T
    is_up = rise[steep] > 0
    low, high = np.where(is_up, first, second), np.where(is_up, second, first)
    np.minimum.at(values, high, values[low] + steps[steep])
    is_lowered = np.zeros(len(values), dtype=bool)
    is_lowered[high] = True
    return np.flatnonzero(is_lowered)


def gradient_limited_blocks(size: SizeField, side: float, slope: float, inside: Bools) -> float:
    """Return the blocks of a layout whose block size s h is limited in gradient: integral of 1 / block area.

    side is s; H is s h where |grad H| <= slope allows it. Counted over the triangles inside, (n_triangles,).
    """
    return float(covering(size.mesh, limit_gradient(size.mesh, side * size.h, slope))[inside].sum())


def capped_triangles(size: SizeField, cap: Floats, inside: Bools) -> float:
    """Return the triangles of a mesh of size min(h, cap) inside; cap and inside are one value a triangle."""
    finer = np.maximum(size.triangle_h / cap, 1.0) ** 2
    return float((size.triangle_weights * finer)[inside].sum())


@dataclass(frozen=True, eq=False)
class _Links:
    """Pairs of points linked by an edge or the diagonal of a pair of triangles."""

    ends: Ints
    """Both points, (n, 2)."""
    lengths: Floats
    """Length of each link, (n,)."""
    n_points: int

    @classmethod
    def of(cls, mesh: Mesh) -> _Links:
        topology = mesh.topology
        inner = topology.edges.take(np.flatnonzero(~topology.is_boundary_edge), axis=0)
        across = _across(mesh.points, topology.tips, inner)
        return cls(
            np.concatenate([topology.edges, topology.tips]),
            np.concatenate([mesh.edge_lengths, across]),
            mesh.n_points,
        )

    @cached_property
    def around(self) -> tuple[Wholes, Floats, Wholes]:
        """The points linked to each, the lengths of the links, and where those begin, (n_points + 1,)."""
        first, second = self.ends.T
        return by_row(
            np.concatenate([first, second]),
            np.concatenate([second, first]),
            np.tile(self.lengths, 2),
            self.n_points,
        )


_KNOWN: WeakKeyDictionary[Mesh, _Links] = WeakKeyDictionary()
"""The links of the meshes that are alive: a domain is asked for several slopes, then both are let go."""


def _links(mesh: Mesh) -> _Links:
    if mesh not in _KNOWN:
        _KNOWN[mesh] = _Links.of(mesh)
    return _KNOWN[mesh]


def _across(points: Floats, tips: Ints, edges: Ints) -> Floats:
    """Return the lengths from tip to tip over edges, (n,); both are ends of lines, (n, 2).

    Straight where that crosses the edge itself; elsewhere the way round over an end of it is the shortest.
    """
    (a, b), (start, end) = edges.T, tips.T
    square, near, far, to_start, to_end, direct = np.zeros((6, len(edges)))
    for axis in points.T:
        origin = axis[a]
        along, u, v = axis[b] - origin, axis[start] - origin, axis[end] - origin
        square += along**2
        near += u * along
        far += v * along
        to_start += u**2
        to_end += v**2
        direct += (u - v) ** 2
    near /= square
    far /= square
    d_near, d_far = (
        np.sqrt(np.maximum(length - share**2 * square, 0.0))
        for length, share in ((to_start, near), (to_end, far))
    )
    where = near * d_far + far * d_near  # of the edge, times the sum of the two
    bent = np.flatnonzero((where <= 0) | (where >= d_near + d_far))
    result = np.sqrt(direct)
    first, last = points[start[bent]], points[end[bent]]
    over = [
        lengths_of(first - corner) + lengths_of(last - corner)
        for corner in (points[a[bent]], points[b[bent]])
    ]
    result[bent] = np.minimum(*over)
    return np.asarray(result)
