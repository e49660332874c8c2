"""Straighten the borders of region labels, one integer a triangle.

Threshold dynamics [Merriman, Bence & Osher]: the indicator of each label is averaged over the triangles
around the vertices, four times, and each triangle takes the label that is strongest there; ties go to the
smaller label. All work is done within a few rings of the borders, and again only where something changed.
Where two labels meet, the average of the label itself tells the share of each; only around junctions of
three are there indicators of all.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from ..arrays import Bools, Floats, Ints, grouped, sums_by
from ..mesh import Mesh
from ..mesh.quality import angles

AVERAGES = 4
"""Averages, and so rings, over which a label is felt."""

THIRD = 1e-14
"""Share of the square of the largest label by which rounding may hide a third label."""

TIE = 1e-9
"""Shares that differ by less are equal: rounding, whatever the numbering."""

MOST_TURNS = 20
"""Turns of pulling teeth: a long comb may leave some."""


def smooth_borders(mesh: Mesh, label: Ints, corner_shares: Floats, *, rounds: int) -> Ints:
    """Return labels with their borders straightened, (n_triangles,); corner_shares as below.

    Threshold dynamics rounds times. Last, teeth are pulled: a triangle with two neighbours in one other
    region joins them.
    """
    first, second = mesh.topology.neighbours.T
    is_cut = np.flatnonzero(label[first] != label[second])
    changed = np.concatenate([first[is_cut], second[is_cut]])
    for _ in range(rounds):
        if not len(changed):
            break
        near = grown(mesh, changed, AVERAGES)
        strongest = _strongest(mesh, label, near, corner_shares)
        is_changed = strongest != label[near]
        changed = near[is_changed]
        label = label.copy()
        label[changed] = strongest[is_changed]
    return _pull_teeth(mesh, label)


def corner_shares(mesh: Mesh) -> Floats:
    """Return the weight of each triangle in the averages around its corners, (n_triangles, 3).

    By its angles: by number, a border would creep from the fine side, with its many triangles, to the coarse.
    """
    angle = angles(mesh.corner_edge_lengths)
    around = sums_by(mesh.triangles, angle, mesh.n_points)
    return np.column_stack(
        [a / (3 * around[corner]) for a, corner in zip(angle.T, mesh.triangles.T, strict=True)]
    )


def grown(mesh: Mesh, triangles: Ints, rings: int) -> Ints:
    """Return the triangles and those within so many rings of vertices around them, sorted."""
    around, start = mesh.topology.cells_around
    is_in, is_reached = np.zeros(mesh.n_triangles, dtype=bool), np.zeros(mesh.n_points, dtype=bool)
    is_in[triangles] = True
    front = np.flatnonzero(is_in)
    for _ in range(rings):
        corners = mesh.triangles[front].ravel()
        fresh = np.zeros_like(is_reached)
        fresh[corners[~is_reached[corners]]] = True
        is_reached |= fresh
        vertices = np.flatnonzero(fresh)
        count = start[vertices + 1] - start[vertices]
        offset = np.repeat(start[vertices] - np.cumsum(count) + count, count)
        found = around[offset + np.arange(len(offset))]
        front = found[~is_in[found]]
        is_in[front] = True
    return np.flatnonzero(is_in)


@dataclass(frozen=True, eq=False)
class _Patch:
    """Triangles around those to be decided, with an average over them as two matrices."""

    triangles: Ints
    corners: Ints
    """Local number of each corner, (n, 3)."""
    gather: csr_array
    """From triangles to vertices, weighed."""

    @classmethod
    def around(cls, mesh: Mesh, triangles: Ints, corner_shares: Floats) -> _Patch:
        wide = grown(mesh, triangles, AVERAGES)
        corners = mesh.triangles[wide]
        is_used = np.zeros(mesh.n_points, dtype=bool)
        is_used[corners.ravel()] = True
        corners = (np.cumsum(is_used) - 1)[corners]
        n_vertices = int(np.count_nonzero(is_used))
        order, start = grouped(corners, n_vertices)
        entries = (corner_shares[wide].ravel()[order], order // 3, start)
        return cls(wide, corners, csr_array(entries, shape=(n_vertices, len(wide))))

    def averaged(self, values: Floats) -> Floats:
        a, b, c = self.corners.T
        for _ in range(AVERAGES):
            at_vertices = self.gather @ values
            values = at_vertices[a] + at_vertices[b] + at_vertices[c]
        return values

    def extremes(self, label: Ints) -> tuple[Ints, Ints]:
        low, high, start = label, label, self.gather.indptr[:-1]
        a, b, c = self.corners.T
        for _ in range(AVERAGES):
            least = np.minimum.reduceat(low[self.gather.indices], start)
            most = np.maximum.reduceat(high[self.gather.indices], start)
            low = np.minimum(np.minimum(least[a], least[b]), least[c])
            high = np.maximum(np.maximum(most[a], most[b]), most[c])
        return low, high


def _strongest(mesh: Mesh, label: Ints, near: Ints, shares: Floats) -> Ints:
    """Return the label that is strongest at each triangle of near, (n_near,)."""
    patch = _Patch.around(mesh, near, shares)
    own = label[patch.triangles]
    low, high = patch.extremes(own)
    mean, square = patch.averaged(own.astype(np.float64)), patch.averaged(own.astype(np.float64) ** 2)
    at = np.searchsorted(patch.triangles, near)
    low, high, mean, square = low[at], high[at], mean[at], square[at]
    of_high = (mean - low) / np.maximum(high - low, 1)
    result = np.where(of_high > 0.5 + TIE, high, low)
    third = square - (low + high) * mean + low * high
    is_junction = np.abs(third) > THIRD * max(1.0, float(own.max())) ** 2
    some = near[is_junction]
    if len(some):
        result[is_junction] = _strongest_of_many(_Patch.around(mesh, some, shares), label, some)
    return result


def _strongest_of_many(patch: _Patch, label: Ints, near: Ints) -> Ints:
    names, local = np.unique(label[patch.triangles], return_inverse=True)
    n = len(patch.triangles)
    share = csr_array((np.ones(n), local, np.arange(n + 1)), shape=(n, len(names)))
    spread = csr_array((np.ones(3 * n), patch.corners.ravel(), np.arange(0, 3 * n + 1, 3)))
    for _ in range(AVERAGES):
        share = csr_array(spread @ csr_array(patch.gather @ share))
    return names[_row_argmax(csr_array(share[np.searchsorted(patch.triangles, near)]))]


def _row_argmax(matrix: csr_array) -> Ints:
    """Return the column of the largest value of each row, to 9 digits, the first of equal ones."""
    data = np.round(matrix.data, 9)
    row = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    is_largest = data == np.maximum.reduceat(data, matrix.indptr[:-1])[row]
    column = np.where(is_largest, matrix.indices, np.iinfo(np.int64).max)
    return np.minimum.reduceat(column, matrix.indptr[:-1])


def _pull_teeth(mesh: Mesh, label: Ints) -> Ints:
    across, label = mesh.topology.across, label.copy()
    first, second = mesh.topology.neighbours.T
    is_cut = np.flatnonzero(label[first] != label[second])
    some = np.unique(np.concatenate([first[is_cut], second[is_cut]]))
    idle = 0
    for turn in range(MOST_TURNS):
        beside = across[some]
        a, b, c = (np.where(column >= 0, label[column], -1) for column in beside.T)
        twin = np.where(a == b, a, c)
        is_tooth: Bools = ((a == twin).astype(np.int8) + (b == twin) + (c == twin) == 2) & (twin >= 0)
        # one direction a turn, so that two teeth side by side cannot swap for ever
        is_tooth &= (twin < label[some]) if turn % 2 else (twin > label[some])
        pulled = some[is_tooth]
        idle = 0 if len(pulled) else idle + 1
        if idle == 2:  # neither direction finds any
            break
        label[pulled] = twin[is_tooth]
        further = across[pulled].ravel()
        some = np.concatenate([some, np.setdiff1d(further[further >= 0], some)])
    return label
