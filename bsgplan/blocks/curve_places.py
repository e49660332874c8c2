"""Places on the curves of a domain, for many at once: points and metric lengths by arc length."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints
from .domain import Domain
from .kinds import JUNCTION
from .placed import PlacedMesh


class CurvePlaces:
    """The curves of a domain end to end on one axis, so that one interpolation serves all of them."""

    def __init__(self, domain: Domain, log_size: Floats) -> None:
        rows = domain.curve_points
        first = domain.lines.first
        self.lengths = domain.curve_lengths
        self.is_closed = domain.lines.is_closed
        self._base = np.concatenate([[0.0], np.cumsum(self.lengths + 1.0)[:-1]])
        curve = np.repeat(np.arange(len(self.lengths)), np.diff(first))
        self._axis = self._base[curve] + rows[:, 2]
        self._xy = rows[:, :2]
        density = np.exp(-log_size[domain.curve_nodes])
        step = 0.5 * (density[1:] + density[:-1]) * np.diff(rows[:, 2], append=rows[-1:, 2])[:-1]
        step[first[1:-1] - 1] = 0.0
        self._metric = np.concatenate([[0.0], np.cumsum(step)])
        self._metric -= np.repeat(self._metric[first[:-1]], np.diff(first))
        self.metric_lengths = self._metric[first[1:] - 1]
        self._metric_base = np.concatenate([[0.0], np.cumsum(self.metric_lengths + 1.0)[:-1]])
        self._metric_axis = self._metric_base[curve] + self._metric

    def points(self, curve: Ints, arc: Floats) -> Floats:
        """Return the points at arc lengths on curves, (..., 2); closed curves go round."""
        where = self._base[curve] + self._wrapped(curve, arc, self.lengths)
        return np.stack([np.interp(where, self._axis, self._xy[:, i]) for i in range(2)], axis=-1)

    def metric(self, curve: Ints, arc: Floats) -> Floats:
        """Return the length of curves up to arc lengths in wanted edges, counting rounds."""
        rounds = np.floor(arc / self.lengths[curve]) * self.is_closed[curve]
        inside = np.clip(arc - rounds * self.lengths[curve], 0.0, self.lengths[curve])
        part = np.interp(self._base[curve] + inside, self._axis, self._metric)
        return np.asarray(part + rounds * self.metric_lengths[curve])

    def arc_at(self, curve: Ints, metric: Floats) -> Floats:
        """Return the arc lengths at lengths in wanted edges: the inverse of `metric`."""
        rounds = np.floor(metric / self.metric_lengths[curve]) * self.is_closed[curve]
        inside = np.clip(metric - rounds * self.metric_lengths[curve], 0.0, self.metric_lengths[curve])
        axis = np.interp(self._metric_base[curve] + inside, self._metric_axis, self._axis)
        return np.asarray(np.clip(axis - self._base[curve], 0.0, self.lengths[curve])
                          + rounds * self.lengths[curve])  # fmt: skip

    def _wrapped(self, curve: Ints, arc: Floats, lengths: Floats) -> Floats:
        length = lengths[curve]
        return np.where(self.is_closed[curve], np.mod(arc, length), np.clip(arc, 0.0, length))


def side_arcs(domain: Domain, mesh: PlacedMesh, triangle: Ints, side: Ints) -> tuple[Ints, Floats, Floats]:
    """Return curve and the arc lengths at both ends of sides that lie on curves, each (n,).

    The ends are in the triangle's order, corner side + 1 first; on closed curves arcs may exceed the length.
    """
    code = mesh.codes[triangle, side]
    curve, is_against = code // 2, code % 2 == 1
    a, b = mesh.triangles[triangle, (side + 1) % 3], mesh.triangles[triangle, (side + 2) % 3]
    a, b = np.where(is_against, b, a), np.where(is_against, a, b)
    length = domain.curve_lengths[curve]
    start = np.where(mesh.kinds[a] == JUNCTION, 0.0, mesh.arcs[a])
    end = np.where(mesh.kinds[b] == JUNCTION, length, mesh.arcs[b])
    end = np.where(end <= start, end + length, end)
    return curve, np.where(is_against, end, start), np.where(is_against, start, end)
