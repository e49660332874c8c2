"""Isotropic remeshing with a size function, by mmg through the package mmgpy, where it is installed.

mmg is no part of bsgplan: the extra `mmg` installs it, and it is used here only, for comparison.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable

import numpy as np

from ..arrays import Floats, Ints
from ..errors import BsgplanError
from ..mesh import Mesh

START = 0.1
"""Edge of the grid that remeshing starts from, length."""
ROUNDS = 3
"""Remeshing after remeshing: sizes are linear on triangles, so the first round has them on a coarse mesh."""


class NoRemesher(BsgplanError, ImportError):  # noqa: N818 - names the thing, as the house does
    """The remesher is not installed, or does not work here."""


def remeshed(length: float, size: Callable[[Floats], Floats]) -> Mesh:
    """Return a rectangle of height 1 remeshed to a size function of x; raises NoRemesher."""
    points, triangles = _grid(length)
    try:
        mmg = importlib.import_module("mmgpy")
        for _ in range(ROUNDS):
            mesh = mmg.MmgMesh2D()
            mesh.set_mesh_size(vertices=len(points), triangles=len(triangles))
            mesh.set_vertices(points)
            mesh.set_triangles(triangles.astype(np.int32))
            mesh.set_field("metric", size(points[:, 0])[:, None])
            mesh.remesh(verbose=-1, hgrad=-1.0)  # no gradation of its own
            points = np.array(mesh.get_vertices(), dtype=np.float64)
            triangles = np.array(mesh.get_triangles(), dtype=np.int64)
    except ImportError:
        raise NoRemesher("mmg is not installed; pip install 'bsgplan[mmg]' sets it beside ours") from None
    except (RuntimeError, AttributeError, TypeError, ValueError) as error:
        raise NoRemesher(f"mmg did not remesh ({error}); try mmgpy 0.17") from error
    return Mesh(points, triangles)


def irregular_vertices(mesh: Mesh) -> Ints:
    """Return the irregularity of each vertex of a rectangle, (n_points,), its corners left out."""
    extreme = (mesh.points == mesh.points.min(axis=0)) | (mesh.points == mesh.points.max(axis=0))
    return np.where(extreme.all(axis=1), 0, mesh.vertex_irregularity)


def _grid(length: float) -> tuple[Floats, Ints]:
    n, m = round(length / START), round(1 / START)
    x, y = np.meshgrid(np.linspace(0, length, n + 1), np.linspace(0, 1, m + 1))
    corner = np.arange((n + 1) * m).reshape(m, n + 1)[:, :-1].ravel()
    lower = np.column_stack([corner, corner + 1, corner + n + 2])
    upper = np.column_stack([corner, corner + n + 2, corner + n + 1])
    return np.column_stack([x.ravel(), y.ravel()]), np.concatenate([lower, upper])
