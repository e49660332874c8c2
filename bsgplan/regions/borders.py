"""Straighten the borders of region labels, one integer a triangle.

Threshold dynamics [Merriman, Bence & Osher]: the indicator of each label is averaged over the triangles
around the vertices, a few times, and each triangle takes the label that is strongest there; ties go to the
smaller label. All work is done within a few rings of the borders, and again only where something changed.
Where two labels meet, the averages of a number for each label and of its square tell which the other is
and its share; only around junctions of three are there indicators of all.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ..arrays import Bools, Floats, Ints, Wholes, sums_by
from ..mesh import Mesh
from ..mesh.operators import cotangents

AVERAGES = 4
"""Averages, and so rings, over which a label is felt in a mesh whose edges are its sizes.

Triangles may change sides in one ring fewer: beyond, less than half of all so long walks come to the other
side, as each step would have to lead straight towards it."""

GOLDEN = (np.sqrt(5) - 1) / 2
"""Label k has the number k + (k GOLDEN mod 1) / 2: no mean of some is one more, and all are .5 apart."""

FELT = 0.1
"""A spread below this, of at most .4 of others .5 apart, leaves a triangle its own label."""

CLEAR = 1e-6
"""The other label is known where its number is met to this; else there are three."""

TIE = 1e-9
"""Shares that differ by less are equal: rounding, whatever the numbering."""

MOST_TURNS = 20
"""Turns of pulling teeth: a long comb may leave some."""


def smooth_borders(
    mesh: Mesh,
    label: Ints,
    corner_shares: Floats,
    *,
    rounds: int,
    averages: int = AVERAGES,
    settled: Ints | None = None,
) -> Ints:
    """Return labels with their borders straightened, (n_triangles,); corner_shares as below.

    Threshold dynamics rounds times, beginning at the borders, or at those alone that are new or gone since
    the labels were settled. Last, teeth are pulled: a triangle with two neighbours in one other region joins
    them.
    """
    is_stirred = _is_cut(mesh, label)
    if settled is not None:
        is_stirred ^= _is_cut(mesh, settled)
    changed = mesh.topology.neighbours[np.flatnonzero(is_stirred)].ravel()
    for _ in range(rounds):
        if not len(changed):
            break
        patch = _Patch.around(mesh, changed, averages - 1, corner_shares, averages)
        near = patch.triangles[patch.near]
        strongest = _strongest(mesh, label, patch, corner_shares)
        changed = near[strongest != label[near]]
        label = label.copy()
        label[near] = strongest
    return _pull_teeth(mesh, label)


def _is_cut(mesh: Mesh, label: Ints) -> Bools:
    """Return the interior edges between two labels, (n_interior_edges,)."""
    first, second = mesh.topology.neighbours.T
    return np.asarray(label[first] != label[second])


def corner_shares(mesh: Mesh) -> Floats:
    """Return the weight of each triangle in the averages around its corners, (n_triangles, 3).

    By its angles: by number, a border would creep from the fine side, with its many triangles, to the coarse.
    """
    angle = np.pi / 2 - np.arctan(cotangents(mesh))
    around = sums_by(mesh.triangles, angle, mesh.n_points)
    return np.column_stack(
        [a / (3 * around[corner]) for a, corner in zip(angle.T, mesh.triangles.T, strict=True)]
    )


def _rings(mesh: Mesh, triangles: Ints, most: int) -> NDArray[np.int8]:
    """Return the ring of vertices around some in which a triangle lies, (n_triangles,); most + 1 beyond."""
    around, start = mesh.topology.cells_around
    ring = np.full(mesh.n_triangles, most + 1, dtype=np.int8)
    is_reached = np.zeros(mesh.n_points, dtype=bool)
    ring[triangles] = 0
    front: Wholes = np.flatnonzero(ring == 0)
    for k in range(1, most + 1):
        is_fresh = np.zeros_like(is_reached)
        is_fresh[mesh.triangles.take(front, axis=0)] = True
        is_fresh &= ~is_reached
        is_reached |= is_fresh
        vertices = np.flatnonzero(is_fresh)
        count = start[vertices + 1] - start[vertices]
        offset = np.repeat(start[vertices] - np.cumsum(count) + count, count)
        found = around[offset + np.arange(len(offset))]
        front = found[ring[found] > most]
        ring[front] = k
    return ring


@dataclass(frozen=True, eq=False)
class _Patch:
    """Some triangles and all that lie within as many rings of vertices around them as are averaged."""

    triangles: Ints
    near: Ints
    """Which of the triangles are the ones that were asked for."""
    corners: Ints
    """Local number of each corner, (3, n)."""
    shares: Floats
    """Weight of the triangle in the average around each corner, (3, n)."""
    averages: int
    """How many averages are taken."""

    @classmethod
    def around(cls, mesh: Mesh, triangles: Ints, rings: int, shares: Floats, averages: int) -> _Patch:
        """Return the patch of the triangles within so many rings around some."""
        ring = _rings(mesh, triangles, rings + averages)
        wide = np.flatnonzero(ring <= rings + averages)
        corners = mesh.triangles.take(wide, axis=0).T
        is_used = np.zeros(mesh.n_points, dtype=bool)
        is_used[corners] = True
        number = np.cumsum(is_used) - 1
        near = np.flatnonzero(ring[wide] <= rings)
        return cls(wide, near, number[corners], np.ascontiguousarray(shares.take(wide, axis=0).T), averages)

    @property
    def n_vertices(self) -> int:
        return int(self.corners.max()) + 1

    def averaged(self, values: Floats) -> Floats:
        """Return the averages of one value a triangle, (n,)."""
        n, (a, b, c) = self.n_vertices, self.corners
        for _ in range(self.averages):
            at_vertices = sums_by(self.corners, self.shares * values, n)
            values = at_vertices[a] + at_vertices[b] + at_vertices[c]
        return values


def _strongest(mesh: Mesh, label: Ints, patch: _Patch, shares: Floats) -> Ints:
    """Return the label that is strongest at each triangle of the patch that is near, (n_near,)."""
    own = label[patch.triangles]
    numbers = np.arange(own.max() + 1.0)
    numbers += numbers * GOLDEN % 1 / 2
    value = numbers[own]
    mean, square = (patch.averaged(field)[patch.near] for field in (value, value**2))
    own, value = own[patch.near], value[patch.near]
    shift, spread = mean - value, square - (2 * mean - value) * value
    felt = np.flatnonzero(spread > FELT)
    shift, spread, value = shift[felt], spread[felt], value[felt]
    with np.errstate(divide="ignore", invalid="ignore"):
        met = value + spread / shift  # the number of the other label, if there is one
        other = np.where((met >= 0) & (met < len(numbers)), met, 0).astype(np.int64)
        share = shift / (numbers[other] - value)
    is_clear = np.abs(numbers[other] - met) < CLEAR
    of_larger = np.where(other > own[felt], share, 1 - share)
    smaller, larger = np.minimum(other, own[felt]), np.maximum(other, own[felt])
    result = own.copy()
    result[felt] = np.where(of_larger > 0.5 + TIE, larger, smaller)
    many = felt[~is_clear]
    if len(many):
        some = patch.triangles[patch.near[many]]
        result[many] = _strongest_of_many(label, _Patch.around(mesh, some, 0, shares, patch.averages))
    return result


def _strongest_of_many(label: Ints, patch: _Patch) -> Ints:
    """Return the label that is strongest at the near triangles of a patch, by indicators of all labels."""
    names, local = np.unique(label[patch.triangles], return_inverse=True)
    n = len(patch.triangles)
    share = csr_array((np.ones(n), local, np.arange(n + 1)), shape=(n, len(names)))
    start = np.arange(0, 3 * n + 1, 3)
    spread = csr_array((np.ones(3 * n), patch.corners.T.ravel(), start), shape=(n, patch.n_vertices))
    gather = csr_array((patch.shares.T.ravel(), spread.indices, start), shape=spread.shape).T.tocsr()
    for _ in range(patch.averages):
        share = csr_array(spread @ csr_array(gather @ share))
    return names[_row_argmax(csr_array(share[patch.near]))]


def _row_argmax(matrix: csr_array) -> Ints:
    """Return the column of the largest value of each row, to 9 digits, the first of equal ones."""
    data = np.round(matrix.data, 9)
    row = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    is_largest = data == np.maximum.reduceat(data, matrix.indptr[:-1])[row]
    column = np.where(is_largest, matrix.indices, np.iinfo(np.int64).max)
    return np.minimum.reduceat(column, matrix.indptr[:-1])


def _pull_teeth(mesh: Mesh, label: Ints) -> Ints:
    across, label = mesh.topology.across, label.copy()
    is_some = np.zeros(mesh.n_triangles, dtype=bool)
    is_some[mesh.topology.neighbours[np.flatnonzero(_is_cut(mesh, label))]] = True
    some = np.flatnonzero(is_some)
    idle = 0
    for turn in range(MOST_TURNS):
        beside = across.take(some, axis=0)
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
        further = further[further >= 0]
        fresh = np.unique(further[~is_some[further]])
        is_some[fresh] = True
        some = np.concatenate([some, fresh])
    return label
