"""Hypothesis strategies: random valid triangulations, and the same mesh written in another way."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from bsgplan.arrays import Floats, Ints
from bsgplan.mesh import Mesh, clean


@st.composite
def meshes(draw: st.DrawFn, max_side: int = 9) -> Mesh:
    """Delaunay triangulations of jittered grids with some triangles taken out: holes, pinches, pieces."""
    n_x, n_y = draw(st.integers(2, max_side)), draw(st.integers(2, max_side))
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    x, y = np.meshgrid(np.arange(n_x), np.arange(n_y))
    points = np.column_stack([x.ravel(), y.ravel()]).astype(float)
    points += random.uniform(-0.3, 0.3, points.shape)
    triangles = Delaunay(points).simplices.astype(np.int64)
    flat = clean_enough(points, triangles)
    kept = triangles[flat & (random.random(len(triangles)) >= draw(st.sampled_from([0.0, 0.1, 0.4])))]
    return clean(points, kept if len(kept) else triangles[flat][:1]).mesh


def clean_enough(points: Floats, triangles: Ints) -> np.ndarray:
    """Return the triangles that are no slivers of the convex hull."""
    a, b, c = points[triangles].swapaxes(0, 1)
    area = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    return area > 1e-3


@st.composite
def rewritings(draw: st.DrawFn, mesh: Mesh) -> tuple[Floats, Ints]:
    """The raw arrays of a mesh with points and triangles permuted, corners turned, unused points added."""
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    n_unused = draw(st.integers(0, 3))
    order = random.permutation(mesh.n_points + n_unused)
    points = np.empty((len(order), 2))
    points[order] = np.vstack([mesh.points, random.uniform(-9, 9, (n_unused, 2))])
    triangles = order[mesh.triangles][random.permutation(mesh.n_triangles)]
    triangles = np.array([np.roll(t, random.integers(3)) for t in triangles])
    is_turned = random.random(len(triangles)) < draw(st.sampled_from([0.0, 0.5, 1.0]))
    return points, np.where(is_turned[:, None], triangles[:, ::-1], triangles)


def jittered(n_x: int, n_y: int, seed: int, *, jitter: float = 0.25) -> Mesh:
    """A rectangle (0, n_x - 1) x (0, n_y - 1) of spacing 1, Delaunay, points moved inside and along sides."""
    random = np.random.default_rng(seed)
    x, y = (values.ravel().astype(float) for values in np.meshgrid(np.arange(n_x), np.arange(n_y)))
    shift_x, shift_y = random.uniform(-jitter, jitter, (2, len(x)))
    x = x + np.where((x == 0) | (x == n_x - 1), 0.0, shift_x)
    y = y + np.where((y == 0) | (y == n_y - 1), 0.0, shift_y)
    points = np.column_stack([x, y])
    triangles = Delaunay(points).simplices.astype(np.int64)
    return clean(points, triangles[clean_enough(points, triangles)]).mesh


def disc(n_rings: int) -> Mesh:
    """The unit disc as rings of 6 k points, k = 0 .. n_rings: edges near 1 / n_rings everywhere."""
    radius = np.concatenate([[0.0], np.repeat(np.arange(1, n_rings + 1), 6 * np.arange(1, n_rings + 1))])
    angle = np.concatenate([[0.0], *(2 * np.pi * np.arange(6 * k) / (6 * k) for k in range(1, n_rings + 1))])
    points = (radius / n_rings)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    triangles = Delaunay(points).simplices.astype(np.int64)
    return clean(points, triangles[clean_enough(points * n_rings, triangles)]).mesh


def permuted(mesh: Mesh, seed: int) -> tuple[Mesh, Ints, Ints]:
    """The same mesh with points, triangles and corners in another order, half of the triangles turned over.

    With it the old index of each new point and of each new triangle.
    """
    random = np.random.default_rng(seed)
    points, cells = random.permutation(mesh.n_points), random.permutation(mesh.n_triangles)
    new_name = np.argsort(points)
    triangles = np.array([np.roll(t, random.integers(3)) for t in new_name[mesh.triangles[cells]]])
    is_turned = random.random(len(triangles)) < 0.5
    triangles = np.where(is_turned[:, None], triangles[:, ::-1], triangles)
    return clean(mesh.points[points], triangles).mesh, points, cells


@st.composite
def hilly(draw: st.DrawFn, max_side: int = 22) -> tuple[Mesh, Floats]:
    """A jittered rectangle and a smooth log size on it: a few fine spots on a slope."""
    n_x, n_y = draw(st.integers(4, max_side)), draw(st.integers(4, max_side))
    seed = draw(st.integers(0, 2**32 - 1))
    random = np.random.default_rng(seed)
    mesh = jittered(n_x, n_y, seed)
    x, y = mesh.points.T
    log_h = random.uniform(-0.04, 0.04) * x + random.uniform(-0.04, 0.04) * y
    for _ in range(draw(st.integers(0, 4))):
        at, width = random.uniform(0, [n_x - 1, n_y - 1]), random.uniform(1.5, 6)
        distance = np.hypot(x - at[0], y - at[1])
        log_h = log_h - random.uniform(0.1, 1.5) * np.exp(-((distance / width) ** 2))
    return mesh, log_h
