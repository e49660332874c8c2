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
