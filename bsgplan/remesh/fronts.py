"""The noun Fronts: where the fronts of a transition run, from one coordinate across and one along them.

The coordinate across is harmonic, 0 at the fine and 1 at the coarse end, stretched level by level until a
front is one layer of wanted triangles from the next, and shifted until fronts meet the vertices of the sides
where these are near. Along a front places are told by its length in wanted edges.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order
from scipy.sparse.linalg import spsolve

from ..arrays import Floats, Ints
from ..blocks.placed import PlacedMesh
from ..mesh import Mesh
from ..mesh.operators import gradient, stiffness
from ..regions import Profile
from .rim import Rim

LAYER = np.sqrt(3) / 2
"""Height of a layer of wanted triangles, in wanted edges."""

SAMPLES = np.array([[4, 1, 1], [1, 4, 1], [1, 1, 4], [2, 2, 0], [0, 2, 2], [2, 0, 2]]) / np.array(
    [[6], [6], [6], [4], [4], [4]]
)
"""Places in a triangle that stand for its area, barycentric, (6, 3)."""

NEAR = 0.35
"""A front meets a vertex of a side that is no farther from it than this, in layers."""

BESIDE = 0.5
"""Layers from a ragged end at which its front is measured."""

FEWEST_BINS = 8
"""Levels by which the coordinate is stretched: this many, or one a layer."""


@dataclass(frozen=True, eq=False)
class Fronts:
    """A transition with its coordinate across."""

    mesh: Mesh
    """The part, in its own coordinates."""
    log_size: Floats
    """Log of the wanted edge at its vertices, (n_points,)."""
    rim: Rim
    """Its ends and sides."""
    depth: Floats
    """Coordinate across in layers, 0 at the fine end, (n_points,)."""

    @property
    def layers(self) -> float:
        """Layers of wanted triangles from end to end."""
        return float(self.depth[self.rim.coarse[0]])

    def imposed(self) -> tuple[float, float]:
        """Return the elements of the two ends as the rim has them."""
        return float(self.rim.n_fine), float(self.rim.n_coarse)

    def unimposed(self) -> tuple[float, float]:
        """Return the elements that the size wants on fronts beside the two ends: a ragged rim has more."""
        beside = min(BESIDE, self.layers / 4)
        found = [self.front(self.depth, level) for level in (beside, self.layers - beside)]
        fine, coarse = (
            n if front is None else front.edges for n, front in zip(self.imposed(), found, strict=True)
        )
        return fine, coarse

    def profile(self, ends: tuple[float, float]) -> Profile:
        """Return front counts by depth, with these elements at the ends."""
        n = max(2, round(self.layers))
        depths = np.linspace(0.0, self.layers, n + 1)
        inner = [self.front(self.depth, level) for level in depths[1:-1]]
        counts = [ends[0], *(1.0 if f is None else f.edges for f in inner), ends[1]]
        size = [float(self.log_size[end].mean()) for end in (self.rim.fine, self.rim.coarse)]
        levels = np.linspace(size[0], size[1], n + 1)
        lengths = np.asarray(counts, dtype=np.float64) * np.exp(levels)
        positions = np.concatenate([[0.0], np.cumsum(np.diff(depths) * LAYER * np.exp(levels)[1:])])
        return Profile(depths, np.asarray(counts, dtype=np.float64), levels, lengths, positions)

    def met(self, n_layers: int) -> tuple[Floats, Ints, Ints]:
        """Return the coordinate across in n_layers, and the vertex of each side that each front meets.

        (n_points,), (n_layers + 1,) for the lower and the upper side; -1 where a front meets none.
        """
        depth = self.depth * (n_layers / self.layers)
        ends = np.concatenate([self.rim.fine, self.rim.coarse])
        fixed, shift, meets = [ends], [np.zeros(len(ends))], []
        for side in (self.rim.below, self.rim.above):
            found = np.full(n_layers + 1, -1, dtype=np.int64)
            if len(side):
                found[0], found[-1] = side[0], side[-1]
                inner = side[1:-1]
                level = np.rint(depth[inner]).astype(np.int64)
                off = depth[inner] - level
                order = np.argsort(-np.abs(off), kind="stable")
                is_near = (np.abs(off[order]) < NEAR) & (level[order] > 0) & (level[order] < n_layers)
                found[level[order][is_near]] = inner[order][is_near]  # the nearest comes last
                own = found[1:-1]
                fixed.append(own[own >= 0])
                shift.append((np.arange(1, n_layers) - depth[own])[own >= 0])
            meets.append(found)
        at, by = np.concatenate(fixed), np.concatenate(shift)
        return depth + harmonic(self.mesh, at, by), meets[0], meets[1]

    def front(self, depth: Floats, level: float) -> Front | None:
        """Return the contour of a coordinate across; None where it is neither from side to side nor round."""
        return _front(self, depth, level)


@dataclass(frozen=True, eq=False)
class Front:
    """One front as a polyline."""

    points: Floats
    """Its points, upwards or round, a closed one with its first again, (n, 2)."""
    place: Floats
    """Length up to each of them in wanted edges, (n,)."""

    @property
    def edges(self) -> float:
        """Its length in wanted edges."""
        return float(self.place[-1])

    def at(self, place: Floats) -> Floats:
        """Return the points at these lengths in wanted edges, (k, 2)."""
        return np.column_stack([np.interp(place, self.place, column) for column in self.points.T])


def fronts_of(part: PlacedMesh, log_size: Floats, rim: Rim) -> Fronts:
    """Return a part with its coordinate across; log_size is given at its vertices, in its own unit."""
    mesh = Mesh(part.points, part.triangles)
    ends = np.concatenate([rim.fine, rim.coarse])
    share = harmonic(mesh, ends, np.repeat([0.0, 1.0], [len(rim.fine), len(rim.coarse)]))
    return Fronts(mesh, log_size, rim, _stretched(mesh, log_size, np.clip(share, 0.0, 1.0)))


def harmonic(mesh: Mesh, fixed: Ints, values: Floats) -> Floats:
    """Return the harmonic function with these values at these vertices, flat at the rest of the rim."""
    matrix = stiffness(mesh)
    is_free = np.ones(mesh.n_points, dtype=bool)
    is_free[fixed] = False
    result = np.zeros(mesh.n_points)
    result[fixed] = values
    free = np.flatnonzero(is_free)
    if len(free):
        rows = matrix[free]
        result[free] = spsolve(csr_array(rows[:, free]).tocsc(), -(rows @ result))
    return result


def _stretched(mesh: Mesh, log_size: Floats, share: Floats) -> Floats:
    """Return the depth in layers, a function of the share: dT = sum(A / (LAYER h^2)) / f in each bin."""
    h = np.exp(log_size[mesh.triangles].mean(axis=1))
    weight = mesh.areas / (LAYER * h**2)
    n_bins = max(FEWEST_BINS, round(float(np.sqrt(weight.sum()))))
    edges = mesh.areas * np.linalg.norm(gradient(mesh, share), axis=1) / h
    level = np.clip((share[mesh.triangles] @ SAMPLES.T * n_bins).astype(np.int64), 0, n_bins - 1)
    sums = [
        np.bincount(level.ravel(), np.repeat(value / len(SAMPLES), len(SAMPLES)), n_bins)
        for value in (weight, edges)
    ]
    step = sums[0] / np.maximum(sums[1], 1e-12) / n_bins
    return np.interp(share, np.linspace(0.0, 1.0, n_bins + 1), np.concatenate([[0.0], np.cumsum(step)]))


def _front(fronts: Fronts, depth: Floats, level: float) -> Front | None:
    mesh = fronts.mesh
    is_over = depth >= level
    edge_of = mesh.topology.cell_edges
    ends = mesh.topology.edges
    is_cut = is_over[ends[:, 0]] != is_over[ends[:, 1]]
    crossed = np.flatnonzero(is_cut)
    if not len(crossed):
        return None
    low, high = ends[crossed].T
    share = (level - depth[low]) / (depth[high] - depth[low])
    points = mesh.points[low] + share[:, None] * (mesh.points[high] - mesh.points[low])
    h = np.exp(fronts.log_size[low] + share * (fronts.log_size[high] - fronts.log_size[low]))
    number = np.full(len(ends), -1)
    number[crossed] = np.arange(len(crossed))
    pairs = number[edge_of[is_cut[edge_of].sum(axis=1) == 2]]
    pairs = np.sort(pairs, axis=1)[:, 1:]  # the edge that is not cut has -1
    path = _longest_path(pairs, len(crossed), is_closed=fronts.rim.is_closed)
    if path is None:
        return None
    if not fronts.rim.is_closed:
        path = _upwards(fronts, crossed, path)
        if path is None:
            return None
    points, h = points[path], h[path]
    step = np.linalg.norm(np.diff(points, axis=0), axis=1) * (1 / h[1:] + 1 / h[:-1]) / 2
    return Front(points, np.concatenate([[0.0], np.cumsum(step)]))


def _longest_path(pairs: Ints, n: int, *, is_closed: bool) -> Ints | None:
    """Return the nodes of the longest path or, with its first again, cycle of a graph of such; or None."""
    degree = np.bincount(pairs.ravel(), minlength=n)
    best: Ints | None = None
    if is_closed:
        is_left = np.ones(n, dtype=bool)
        while is_left.any():
            start = int(np.argmax(is_left))
            links = pairs[~(pairs == start).any(axis=1) | (np.cumsum((pairs == start).any(axis=1)) > 1)]
            path = _walked(links, n, start)
            is_left[path] = False
            is_round = degree[path].min() == 2
            if is_round and (best is None or len(path) >= len(best)):
                best = np.append(path, path[0])
        return best
    for end in np.flatnonzero(degree == 1).tolist():
        path = _walked(pairs, n, end)
        if best is None or len(path) > len(best):
            best = path
    return best


def _walked(pairs: Ints, n: int, start: int) -> Ints:
    graph = csr_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(n, n))
    return breadth_first_order(graph, start, directed=False, return_predecessors=False).astype(np.int64)


def _upwards(fronts: Fronts, crossed: Ints, path: Ints) -> Ints | None:
    """Return an open path from the lower to the upper side; None where it does not run so."""
    ends = fronts.mesh.topology.edges[crossed[path[[0, -1]]]]
    rim = fronts.rim
    first, last = (
        [bool(np.isin(end, side).all()) for side in (rim.below, rim.above)] for end in (ends[0], ends[1])
    )
    if first[0] and last[1]:
        return path
    return path[::-1] if last[0] and first[1] else None
