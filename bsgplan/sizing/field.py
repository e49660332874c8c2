"""The size field: the wanted edge length at every vertex of a mesh.

Produces a `SizeField` from the mesh's own edges or from values the user names. Invariant: a field read
off a mesh is calibrated, the triangles it expects are the triangles there are.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..arrays import Floats, Ints, frozen_floats
from ..errors import InvalidSize
from ..mesh import Mesh
from ..mesh.operators import corner_means, gradient, to_vertices
from .charge import edge_fluxes
from .diffusion import Diffusion, once
from .limits import Links

EQUILATERAL = np.sqrt(3) / 4
"""Area of an equilateral triangle of edge 1."""


def covering(mesh: Mesh, h: Floats) -> Floats:
    """Return how many equilateral triangles of size h cover each triangle, (n_triangles,).

    A / (sqrt(3)/4 h^2). h is one length a point; that of a triangle is the geometric mean of its corners.
    """
    share = h ** (-2 / 3)
    a, b, c = (share[corner] for corner in mesh.triangles.T)
    return mesh.areas / EQUILATERAL * (a * b * c)


@dataclass(frozen=True, eq=False)
class SizeField:
    """Edge length h at each vertex of a mesh; raises InvalidSize unless positive and finite."""

    mesh: Mesh = field(repr=False)
    """The mesh that carries the field."""
    h: Floats = field(repr=False)
    """Edge length, (n_points,), length."""
    source: str = "edges"
    """Where the sizes come from: "edges" or the name of an array."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "h", frozen_floats(self.h))
        if self.h.shape != (self.mesh.n_points,):
            raise InvalidSize(
                f"size has shape {self.h.shape}; give one value a point, ({self.mesh.n_points},)"
            )
        is_bad = ~(np.isfinite(self.h) & (self.h > 0))
        if is_bad.any():
            first = int(np.flatnonzero(is_bad)[0])
            raise InvalidSize(
                f"size {self.source!r} is {self.h[first]:g} at point {first} "
                f"({np.count_nonzero(is_bad)} such points); "
                "an edge length is positive and finite"
            )

    @cached_property
    def log_h(self) -> Floats:
        """Natural logarithm of h, (n_points,)."""
        return np.log(self.h)

    @cached_property
    def triangle_log_h(self) -> Floats:
        """Mean logarithm of h at the corners of each triangle, (n_triangles,)."""
        return corner_means(self.mesh.triangles, self.log_h)

    @cached_property
    def finest_first(self) -> Ints:
        """The triangles by their size, (n_triangles,)."""
        return np.argsort(self.triangle_log_h)

    @cached_property
    def triangle_slope(self) -> Floats:
        """grad(log h) of each triangle, (n_triangles, 2 or 3), 1/length."""
        return gradient(self.mesh, self.log_h)

    @cached_property
    def triangle_h(self) -> Floats:
        """Size of each triangle, (n_triangles,), length: the geometric mean of its corners."""
        return np.exp(self.triangle_log_h)

    @cached_property
    def triangle_weights(self) -> Floats:
        """Equilateral triangles of size h that cover each triangle, (n_triangles,)."""
        return covering(self.mesh, self.h)

    @cached_property
    def slope(self) -> Floats:
        """grad(log h) at the vertices, averaged over one local size, (n_points, 2 or 3), 1/length."""
        slope = to_vertices(self.mesh, self.triangle_slope)
        return frozen_floats(self.diffusion.filtered(slope, once))

    @cached_property
    def diffusion(self) -> Diffusion:
        """Diffusion over one local size."""
        return Diffusion.over(self.mesh, self.triangle_h)

    def limited(self, side: float, slope: float, links: Links | None = None) -> Floats:
        """Return side times h limited in gradient to slope, (n_points,), length.

        Known from the first time on; links are those of the mesh, from who has them.
        """
        key = (float(side), float(slope))
        if key not in self._limited:
            self._limited[key] = frozen_floats((links or Links.of(self.mesh)).limited(side * self.h, slope))
        return self._limited[key]

    @cached_property
    def _limited(self) -> dict[tuple[float, float], Floats]:
        return {}

    @cached_property
    def fluxes(self) -> Floats:
        """Charge out of each triangle through its edges, (n_triangles, 3), in units of iota."""
        return frozen_floats(edge_fluxes(self))

    @property
    def expected_triangles(self) -> float:
        """Number of triangles that the field asks for: integral of dA / (sqrt(3)/4 h^2)."""
        return float(self.triangle_weights.sum())
