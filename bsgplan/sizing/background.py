"""The noun Background: sizes on triangles of their own, read off at the points of another mesh.

Triangles are a heap, each with its own corners: they need not meet, and may lie in the plane or in space.
Between corners the logarithm of the size is linear. `Background.at` finds the triangle of every point at
once: a tree of boxes (shapely) proposes, barycentric coordinates decide.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ..arrays import Bools, Floats, Ints, frozen_floats
from ..errors import InvalidSize

ROUNDING = 1e-6
"""A point in the plane is covered up to this share of the background's extent beyond it: coordinates written
with seven digits, on a straight boundary."""
SAG = 0.1
"""A point in space is covered up to this share of a triangle's longest edge away from it: two meshes of one
curved surface differ by h^2 / 8 r, which is less wherever edges are under 0.8 of the radius r."""
BATCH = 250_000
"""Points looked up at a time, which bounds the memory at a few hundred bytes for each."""
TILT = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0]])
"""Two directions that no axis of a model is likely to share: seen along them, walls do not stack."""


@dataclass(frozen=True, eq=False)
class Background:
    """A size at each corner of a heap of triangles; raises InvalidSize on a wrong shape or no triangle."""

    corners: Floats
    """Corner coordinates, (n_triangles, 3, 2 or 3), length or degrees."""
    sizes: Floats
    """Edge length at each corner, (n_triangles, 3), length; only those that are used need be positive."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "corners", frozen_floats(self.corners))
        object.__setattr__(self, "sizes", frozen_floats(self.sizes))
        n = len(self.corners)
        if self.corners.shape not in {(n, 3, 2), (n, 3, 3)} or self.sizes.shape != (n, 3):
            raise InvalidSize(
                f"a background has corners {self.corners.shape} and sizes {self.sizes.shape}; "
                "give (n, 3, 2 or 3) and (n, 3)"
            )
        if not n:
            raise InvalidSize("a background of no triangle; give sizes on triangles")

    def at(self, points: Floats) -> Floats:
        """Return the size at points, (n_points,), length; see `check_covered` for what it raises.

        >>> one = Background(np.array([[[0.0, 0], [2, 0], [0, 2]]]), np.array([[1.0, 1, 4]]))
        >>> one.at(np.array([[0.0, 1.0], [1.0, 0.0]]))
        array([2., 1.])
        """
        corners = self.corners
        if points.shape[1] == 2:
            corners = corners[..., :2]
        elif corners.shape[2] == 2:
            raise InvalidSize("the sizes lie in the plane, the mesh in space; give sizes on the surface")
        triangle, weight, is_covered = locate(corners, points)
        check_covered(points, is_covered)
        sizes = self.sizes[triangle]
        with np.errstate(divide="ignore", invalid="ignore"):
            terms = weight * np.log(np.where(sizes > 0, sizes, np.nan))
        result = np.exp(np.where(weight > 0, terms, 0.0).sum(axis=1))
        check_positive(points, result)
        return np.asarray(result)


def locate(corners: Floats, points: Floats) -> tuple[Ints, Floats, Bools]:
    """Return the nearest triangle of each point, the weights of its corners (n_points, 3), and if it is near.

    corners (n_triangles, 3, 2 or 3), points (n_points, 2 or 3). Near is within `ROUNDING` of the extent in
    the plane, within `SAG` of the longest edge in space. Where none is near the triangle is 0.
    """
    flat, flat_points = (corners, points) if points.shape[1] == 2 else (corners @ TILT.T, points @ TILT.T)
    if points.shape[1] == 2:
        low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
        slack = np.full(len(corners), ROUNDING * float((high - low).max()))
    else:
        slack = SAG * np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    low, high = flat.min(axis=1) - slack[:, None], flat.max(axis=1) + slack[:, None]
    is_wanted = ((low <= flat_points.max(axis=0)) & (high >= flat_points.min(axis=0)) & np.isfinite(low)).all(
        axis=1
    )
    wanted = np.flatnonzero(is_wanted)
    tree = shapely.STRtree(shapely.linestrings(np.stack([low[wanted], high[wanted]], axis=1)))
    triangle = np.zeros(len(points), dtype=np.int64)
    weight = np.zeros((len(points), 3))
    is_near = np.zeros(len(points), dtype=bool)
    for start in range(0, len(points), BATCH):
        batch = slice(start, start + BATCH)
        point, found = tree.query(shapely.points(flat_points[batch]))
        candidate = wanted[found]
        weights, distance = _nearest(corners[candidate], points[batch][point])
        is_hit = distance <= slack[candidate]
        point, candidate, weights, distance = (a[is_hit] for a in (point, candidate, weights, distance))
        if len(point):  # the tree gives them point by point
            group = np.flatnonzero(np.diff(point, prepend=-1))
            least = np.repeat(np.minimum.reduceat(distance, group), np.diff(group, append=len(point)))
            nearest = np.flatnonzero(distance == least)
            at = start + point[nearest]
            triangle[at], weight[at], is_near[at] = candidate[nearest], weights[nearest], True
    return triangle, weight, is_near


def check_covered(points: Floats, is_covered: Bools) -> None:
    """Raise InvalidSize where points are not covered by a background, saying where and how many."""
    if is_covered.all():
        return
    lost = points[~is_covered]
    low, high = lost.min(axis=0), lost.max(axis=0)
    box = " x ".join(f"{a:.6g} .. {b:.6g}" for a, b in zip(low, high, strict=True))
    raise InvalidSize(
        f"no size at {len(lost)} of {len(points)} points, the first at {_place(lost[0])}, all within {box}; "
        "give sizes that cover the whole mesh"
    )


def check_positive(points: Floats, sizes: Floats) -> None:
    """Raise InvalidSize where the sizes found at points are no lengths, saying where and how many."""
    is_bad = ~(np.isfinite(sizes) & (sizes > 0))
    if is_bad.any():
        first = int(np.flatnonzero(is_bad)[0])
        raise InvalidSize(
            f"the size at {_place(points[first])} is no length ({np.count_nonzero(is_bad)} such points of "
            f"{len(points)}); an edge length is positive and finite"
        )


def _nearest(corners: Floats, points: Floats) -> tuple[Floats, Floats]:
    """Return corner weights of a point of each triangle next to a given one, (n, 3), and its distance, (n,).

    The weights are those of the foot of the perpendicular, cut off at 0: exact inside, near enough beside.
    """
    a = corners[:, 0]
    u, v, w = corners[:, 1] - a, corners[:, 2] - a, points - a
    uu, uv, vv, wu, wv = (np.einsum("ni,ni->n", x, y) for x, y in ((u, u), (u, v), (v, v), (w, u), (w, v)))
    with np.errstate(divide="ignore", invalid="ignore"):
        determinant = uu * vv - uv**2
        second, third = (vv * wu - uv * wv) / determinant, (uu * wv - uv * wu) / determinant
    weights = np.maximum(np.column_stack([1 - second - third, second, third]), 0.0)
    weights /= weights.sum(axis=1, keepdims=True)
    away = points - np.einsum("nc,nci->ni", weights, corners)
    distance = np.sqrt(np.einsum("ni,ni->n", away, away))
    return weights, np.where(np.isfinite(distance), distance, np.inf)


def _place(point: Floats) -> str:
    return "(" + ", ".join(f"{x:.8g}" for x in point) + ")"
