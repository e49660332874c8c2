"""The noun Links: pairs of points over which a limit on the gradient of a size is handed on."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Floats, Ints, Wholes, by_row, joined
from ..mesh import Mesh
from ..mesh.quality import lengths as lengths_of

AT_ONCE = 1 << 15
"""Points of a wave that are handed on at a time: their links stay in a processor's cache."""


@dataclass(frozen=True, eq=False)
class Links:
    """Pairs of points linked by an edge or by the diagonal of a pair of triangles.

    Paths over links are at most 4 % longer than straight ones on regular meshes.
    """

    mesh: Mesh
    diagonals: Floats
    """Length of each diagonal, from tip to tip over an interior edge, (n_interior_edges,)."""

    @classmethod
    def of(cls, mesh: Mesh) -> Links:
        """Return the links of a mesh."""
        topology = mesh.topology
        inner = topology.edges.take(topology.inner_edges, axis=0)
        return cls(mesh, _across(mesh.points, topology.tips, inner))

    @cached_property
    def _around(self) -> tuple[Wholes, Floats, Wholes]:
        """The points linked to each, the lengths of the links, and where those begin, (n_points + 1,)."""
        (a, b), (start, end) = self.mesh.topology.edges.T, self.mesh.topology.tips.T
        rows = joined([a, b, start, end], self.mesh.n_points)
        columns = joined([b, a, end, start], self.mesh.n_points)
        lengths = np.concatenate([np.tile(self.mesh.edge_lengths, 2), np.tile(self.diagonals, 2)])
        return by_row(rows, columns, lengths, self.mesh.n_points)

    def limited(self, size: Floats, slope: float) -> Floats:
        """Return the largest field below size whose gradient nowhere exceeds slope, (n_points,), length.

        min over y of size(y) + slope * distance(x, y). Every link is asked once; what was lowered is handed
        on as a wave, which runs as many links as the limit reaches: a few block edges.

        >>> mesh = Mesh(np.array([[0.0, 0], [1, 0], [0, 1]]), np.array([[0, 1, 2]]))
        >>> Links.of(mesh).limited(np.array([1.0, 5.0, 1.2]), 0.5)
        array([1. , 1.5, 1.2])
        """
        result = np.array(size, dtype=np.float64)
        is_lowered = np.zeros(len(result), dtype=bool)
        topology = self.mesh.topology
        for ends, steps in ((topology.edges, self.mesh.edge_lengths), (topology.tips, self.diagonals)):
            is_lowered[_lowered(result, ends, slope * steps)] = True
        front = np.flatnonzero(is_lowered)
        if len(front):
            others, lengths, start = self._around
        while len(front):
            is_lowered = np.zeros(len(result), dtype=bool)
            for part in np.array_split(front, 1 + len(front) // AT_ONCE):
                count = start[part + 1] - start[part]
                link = np.repeat(start[part] - np.cumsum(count) + count, count) + np.arange(count.sum())
                reached, value = others[link], np.repeat(result[part], count) + slope * lengths[link]
                is_less = value < result[reached]
                reached = reached[is_less]
                np.minimum.at(result, reached, value[is_less])
                is_lowered[reached] = True
            front = np.flatnonzero(is_lowered)
        return result


def _lowered(values: Floats, ends: Ints, steps: Floats) -> Ints:
    """Lower values over links, once each way, and return the points that were lowered."""
    rise = values[ends[:, 1]] - values[ends[:, 0]]
    steep = np.flatnonzero(np.abs(rise) > steps)
    first, second = ends.take(steep, axis=0).T
    is_up = rise[steep] > 0
    low, high = np.where(is_up, first, second), np.where(is_up, second, first)
    np.minimum.at(values, high, values[low] + steps[steep])
    return high


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
