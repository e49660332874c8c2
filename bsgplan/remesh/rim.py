"""The noun Rim: the boundary of a part as the fine end, the coarse end and two sides of a transition.

Found from the size alone: an end is where the size leaves through the rim, a side where it runs along it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..blocks.outline import outline
from ..blocks.placed import PlacedMesh
from ..mesh import Mesh
from ..mesh.edges import loops_of
from ..regions.segmentation import PERSISTENCE
from ..sizing import SizeField
from ..sizing.charge import wide_slope

CLEAR = 0.6
"""A transition is clear where so much of what the size does at the rim is what ends and sides would have."""


CORNER, WINDOW = 0.1, 3
"""A square corner between end and side, over WINDOW rim sides each way, is worth this share of all of it:
noise in the size alone would put corners a few vertices beside."""


@dataclass(frozen=True, eq=False)
class Rim:
    """Ends and sides of a transition; vertices of the mesh, the fine end on the left."""

    fine: Ints
    """Vertices of the fine end, from below upwards, (m + 1,); of a ring (m,), round."""
    coarse: Ints
    """Vertices of the coarse end, likewise."""
    below: Ints
    """Vertices of the lower side from the fine to the coarse end, both included; none of a ring."""
    above: Ints
    """Vertices of the upper side, likewise."""

    @property
    def is_closed(self) -> bool:
        """True where the fronts are rings."""
        return not len(self.below)

    @property
    def n_fine(self) -> int:
        """Sides of the fine end."""
        return len(self.fine) - (not self.is_closed)

    @property
    def n_coarse(self) -> int:
        """Sides of the coarse end."""
        return len(self.coarse) - (not self.is_closed)


def rim_of(mesh: PlacedMesh, log_size: Floats) -> Rim | None:
    """Return ends and sides of a mesh of one piece; log_size is given at its vertices.

    None where there is no clear transition: sizes about equal, more than one hole, fronts neither open nor
    round.
    """
    loops = loops_of(outline(mesh))
    if not 1 <= len(loops) <= 2 or mesh.topology.n_components > 1:
        return None
    slope = wide_slope(SizeField(Mesh(mesh.points, mesh.triangles), np.exp(log_size)))
    if len(loops) == 2:
        return _ring(mesh, log_size, slope, loops)
    return _strip(mesh, log_size, slope, loops[0])


def _flows(mesh: PlacedMesh, slope: Floats, loop: Ints) -> tuple[Floats, Floats]:
    """Return by how much log size rises outwards and along each side of a loop, (n,) each."""
    after = np.roll(loop, -1)
    along = mesh.points[after] - mesh.points[loop]
    g = (slope[loop] + slope[after]) / 2
    return g[:, 0] * along[:, 1] - g[:, 1] * along[:, 0], (g * along).sum(axis=1)


def _ring(mesh: PlacedMesh, log_size: Floats, slope: Floats, loops: list[Ints]) -> Rim | None:
    flows = [_flows(mesh, slope, loop) for loop in loops]
    total = sum(float(np.hypot(*flow).sum()) for flow in flows)
    means = [float(log_size[loop].mean()) for loop in loops]
    fine, coarse = np.argsort(means)
    leaving = float(flows[coarse][0].sum() - flows[fine][0].sum())
    if leaving < CLEAR * total or means[coarse] - means[fine] < PERSISTENCE:
        return None
    none = np.empty(0, dtype=np.int64)
    return Rim(loops[fine][::-1], loops[coarse], none, none)  # both in one sense of rotation


def _strip(mesh: PlacedMesh, log_size: Floats, slope: Floats, loop: Ints) -> Rim | None:
    out, along = _flows(mesh, slope, loop)
    gains = np.stack([-out, along, out, -along])  # as fine end, lower side, coarse end, upper side
    total = float(np.hypot(out, along).sum())
    if total <= 0:
        return None
    worth = CORNER * total * _squareness(mesh.points[loop])
    _, kinds = max((_cut(gains, worth, first) for first in range(4)), key=lambda cut: cut[0])
    own = float(gains[kinds, np.arange(len(loop))].sum())
    if own < CLEAR * total or len(np.unique(kinds)) < 4:
        return None
    runs = [_run(loop, kinds == kind) for kind in range(4)]
    fine, below, coarse, above = runs
    if log_size[coarse].mean() - log_size[fine].mean() < PERSISTENCE:
        return None
    return Rim(fine[::-1], coarse, below, above[::-1])


def _squareness(points: Floats) -> Floats:
    """Return by how much a loop turns left at each vertex over a window, 1 for a square corner, 0 .. 1."""
    before, after = points - np.roll(points, WINDOW, axis=0), np.roll(points, -WINDOW, axis=0) - points
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turn = np.arctan2(cross, (before * after).sum(axis=1))
    return np.asarray(np.clip(turn / (np.pi / 2), 0.0, 1.0))


def _cut(gains: Floats, worth: Floats, first: int) -> tuple[float, Ints]:
    """Return the most gain of sides in five runs of kinds, first, first + 1, .., and their kinds, (n,).

    worth is what a change of kind gains at the vertex before each side, (n,).
    """
    order = [(first + k) % 4 for k in range(5)]
    sums = np.concatenate([np.zeros((4, 1)), np.cumsum(gains, axis=1)], axis=1)
    index = np.arange(sums.shape[1])
    at = np.append(worth, worth[0])
    reached, came_from = sums[first], []
    for kind in order[1:]:
        score = reached - sums[kind] + at
        peak = np.maximum.accumulate(score)
        came_from.append(np.maximum.accumulate(np.where(score == peak, index, 0)))
        reached = peak + sums[kind]
    stop = gains.shape[1]
    best = float(reached[stop])
    kinds = np.empty(stop, dtype=np.int64)
    for kind, back in zip(order[:0:-1], came_from[::-1], strict=True):
        start = int(back[stop])
        kinds[start:stop] = kind
        stop = start
    kinds[:stop] = order[0]
    return best, kinds


def _run(loop: Ints, is_own: Bools) -> Ints:
    """Return the vertices of the sides marked, which follow each other round the loop."""
    n = len(loop)
    start = int(np.flatnonzero(is_own & ~np.roll(is_own, 1))[0])
    return loop[(start + np.arange(int(is_own.sum()) + 1)) % n]
