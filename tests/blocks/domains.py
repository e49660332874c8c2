"""Small domains made by hand and at random, without a mesh generator."""

from __future__ import annotations

import numpy as np
import shapely
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from bsgplan.arrays import Bools
from bsgplan.mesh import Mesh, clean
from bsgplan.sizing import SizeField

Edge = tuple[int, int]


def grid_mesh(n_x: int, n_y: int, keep: np.ndarray | None = None) -> Mesh:
    """Unit squares, each cut in two; keep picks squares, (n_x, n_y)."""
    squares = np.argwhere(np.ones((n_x, n_y), bool) if keep is None else keep)
    i, j = squares.T
    a, b, c, d = (
        i * (n_y + 1) + j,
        (i + 1) * (n_y + 1) + j,
        (i + 1) * (n_y + 1) + j + 1,
        i * (n_y + 1) + j + 1,
    )
    is_even = ((i + j) % 2 == 0)[:, None]
    first = np.where(is_even, np.column_stack([a, b, c]), np.column_stack([a, b, d]))
    second = np.where(is_even, np.column_stack([a, c, d]), np.column_stack([b, c, d]))
    x, y = np.meshgrid(np.arange(n_x + 1.0), np.arange(n_y + 1.0), indexing="ij")
    return clean(np.column_stack([x.ravel(), y.ravel()]), np.concatenate([first, second])).mesh


def edges_where(mesh: Mesh, is_on: Bools) -> Bools:
    """Interior edges whose both ends are on, (n_edges,)."""
    return is_on[mesh.topology.edges].all(axis=1) & ~mesh.topology.is_boundary_edge


def polygon_mesh(polygon: shapely.Polygon, step: float, seed: int) -> Mesh:
    """Triangles inside a polygon: its boundary cut into steps, a jittered lattice inside, Delaunay."""
    random = np.random.default_rng(seed)
    rings = [polygon.exterior, *polygon.interiors]
    fine = shapely.segmentize(polygon, step)
    rings = [np.asarray(r.coords)[:-1] for r in (fine.exterior, *fine.interiors)]
    low_x, low_y, high_x, high_y = polygon.bounds
    x, y = np.meshgrid(np.arange(low_x, high_x, step), np.arange(low_y, high_y, step))
    inside = np.column_stack([x.ravel(), y.ravel()]) + random.uniform(-0.2, 0.2, (x.size, 2)) * step
    inside = inside[shapely.contains_xy(polygon.buffer(-0.4 * step), inside)]
    points = np.concatenate([*rings, inside])
    triangles = Delaunay(points).simplices.astype(np.int64)
    middles = points[triangles].mean(axis=1)
    a, b, c = points[triangles].swapaxes(0, 1)
    area = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    chosen = shapely.contains_xy(polygon, middles) & (area > 1e-6 * step**2)
    return clean(points, triangles[chosen]).mesh


@st.composite
def random_domains(draw: st.DrawFn) -> SizeField:
    """A star-shaped polygon with up to three holes, meshed by Delaunay, and a size field with a slope."""
    seed = draw(st.integers(0, 2**32 - 1))
    random = np.random.default_rng(seed)
    n = draw(st.integers(3, 14))
    angle = np.sort(random.uniform(0, 2 * np.pi, n))
    radius = random.uniform(0.35, 1.0, n)
    shape = shapely.Polygon(radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]))
    shape = shape.union(shapely.Point(0, 0).buffer(0.3, quad_segs=3))
    for _ in range(draw(st.integers(0, 3))):
        at = random.uniform(-0.5, 0.5, 2)
        shape = shape.difference(
            shapely.Point(at).buffer(random.uniform(0.04, 0.2), quad_segs=random.integers(1, 4))
        )
    if shape.geom_type != "Polygon":
        shape = max(shape.geoms, key=lambda part: part.area)
    mesh = polygon_mesh(shape, draw(st.sampled_from([0.06, 0.1, 0.2])), seed)
    slope = draw(st.sampled_from([0.0, 0.4, 1.0]))
    h = 0.08 * np.exp(slope * mesh.points @ random.uniform(-1, 1, 2))
    return SizeField(mesh, h)


def on_rectangle(mesh: Mesh, low: float, high: float) -> Bools:
    """Edges of a mesh of unit squares that lie on the square from (low, low) to (high, high), (n_edges,)."""
    is_on = np.abs(mesh.points - (low + high) / 2).max(axis=1) == (high - low) / 2
    a, b = mesh.points[mesh.topology.edges].swapaxes(0, 1)
    return is_on[mesh.topology.edges].all(axis=1) & (a == b).any(axis=1)
