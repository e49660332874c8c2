"""Reader of the sizes in a Medit solution file (.sol), as mmg and others write it beside a .mesh.

Grammar, free format, # begins a comment:

    MeshVersionFormatted 2
    Dimension 2
    SolAtVertices
    n_vertices
    n_solutions  type type ...       1 scalar, 2 vector, 3 symmetric tensor
    values                           for each vertex in the order of the mesh file, all its solutions
    End

Of several solutions the first scalar or tensor is taken. A tensor M, by rows of its lower triangle
(m11 m12 m22 m13 m23 m33), is a metric: an edge e has the wanted length where e . M e = 1.
"""

from __future__ import annotations

import logging
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints, frozen_floats, sums_by
from ..errors import InvalidSize, MeshReadError
from ..mesh import Mesh
from .number_table import shown
from .rows import all_numbers
from .text_records import TextRecords

STRETCH = 1.5
"""Ratio of the two sizes of a metric above which a warning says that blocks will not be stretched."""
COLUMNS = {2: {1: 1, 2: 2, 3: 3}, 3: {1: 1, 2: 3, 3: 6}}
"""Numbers a vertex by dimension and type of solution."""
SCALAR, TENSOR = 1, 3
DIMENSION, AT_VERTICES = re.compile(rb"\bDimension\s"), re.compile(rb"\bSolAtVertices\s")
MOST_SOLUTIONS = 64
"""Solutions at a vertex: more are a mistake in the header."""


@dataclass(frozen=True, eq=False)
class Solution:
    """Sizes or metrics at the vertices of a mesh file."""

    values: Floats
    """A size a vertex, (n_vertices, 1), or a metric by rows of its lower triangle, (n_vertices, 3 or 6)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", frozen_floats(self.values))

    def at(self, mesh: Mesh, kept_points: Ints) -> Floats:
        """Return the size at the points of a mesh, (n_points,), length; kept_points are their places here.

        Of a metric it is the size with the same area of a triangle: with M restricted to the plane of the
        mesh at the point, h = det(M)^(-1/4), the geometric mean of the two sizes of M.
        """
        values = self.values[kept_points]
        return values[:, 0] if values.shape[1] == 1 else isotropic(values, normals(mesh))


def read_sol(path: Path) -> Solution:
    """Return the first scalar or tensor at the vertices of an ASCII .sol file."""
    with TextRecords(path, comment=b"#") as records:
        records.skip_to(DIMENSION)
        dimension = records.word()
        records.skip_to(AT_VERTICES)
        n, n_solutions = _whole(records.word()), _whole(records.word())
        if dimension not in (b"2", b"3") or n is None or n_solutions is None:
            raise MeshReadError("no Dimension 2 or 3, or no SolAtVertices; give the sizes at the vertices")
        types = [_whole(records.word()) for _ in range(min(n_solutions, MOST_SOLUTIONS))]
        columns = COLUMNS[int(dimension)]
        widths = [columns[kind] for kind in types if kind in columns]
        if not types or len(widths) < n_solutions:
            raise MeshReadError(
                f"{n_solutions} solutions of types {types}; types are 1, 2 and 3, one a solution"
            )
        wanted = next((k for k, kind in enumerate(types) if kind in (SCALAR, TENSOR)), None)
        if wanted is None:
            raise MeshReadError("vectors only; give a scalar (type 1) or a metric (type 3)")
        numbers = records.numbers("a value", read=all_numbers)
        after, line_number = records.word(), records.line_number + 1
    if after and after != b"End" and not after.startswith(b"SolAt"):
        raise MeshReadError(f"line {line_number}: {shown(after)} is no number; repair the file")
    if len(numbers) != n * sum(widths):
        raise MeshReadError(
            f"{len(numbers)} numbers where {n} vertices need {sum(widths)} each; repair the file"
        )
    start = sum(widths[:wanted])
    return Solution(numbers.reshape(n, sum(widths))[:, start : start + widths[wanted]])


def _whole(word: bytes) -> int | None:
    """Return the whole number that a word is, None where it is none or one of more than 18 digits."""
    return int(word) if word.isdigit() and len(word) <= 18 else None


def isotropic(metrics: Floats, normal: Floats) -> Floats:
    """Return the isotropic sizes of metrics, (n,), length: (n . adj(M) n)^(-1/4) for the unit normal n.

    metrics (n, 3) of the plane or (n, 6) of space, normal (n, 3). Raises InvalidSize for a metric that is
    not positive definite.

    >>> isotropic(np.array([[4.0, 0.0, 0.25]]), np.array([[0.0, 0, 1]]))
    array([1.])
    """
    if metrics.shape[1] == 3:
        metrics = np.column_stack([metrics, np.zeros((len(metrics), 2)), np.ones(len(metrics))])
    m11, m12, m22, m13, m23, m33 = metrics.T
    x, y, z = normal.T
    determinant = (
        (m22 * m33 - m23**2) * x**2
        + (m11 * m33 - m13**2) * y**2
        + (m11 * m22 - m12**2) * z**2
        + 2 * (m13 * m23 - m12 * m33) * x * y
        + 2 * (m12 * m23 - m13 * m22) * x * z
        + 2 * (m12 * m13 - m11 * m23) * y * z
    )
    across = m11 * x**2 + m22 * y**2 + m33 * z**2 + 2 * (m12 * x * y + m13 * x * z + m23 * y * z)
    mean = (m11 + m22 + m33 - across) / 2
    is_bad = ~((determinant > 0) & (mean > 0) & np.isfinite(determinant))
    if is_bad.any():
        raise InvalidSize(
            f"the metric of point {np.flatnonzero(is_bad)[0]} is not positive definite "
            f"({np.count_nonzero(is_bad)} such points); repair the sizes"
        )
    largest = mean + np.sqrt(np.maximum(mean**2 - determinant, 0.0))
    stretch = float((largest / np.sqrt(determinant)).max())
    if stretch > STRETCH:
        logging.getLogger("bsgplan").warning(
            "metric stretched up to %.3g : 1; triangles are planned unstretched, of the same area", stretch
        )
    return np.asarray(determinant**-0.25)


def normals(mesh: Mesh) -> Floats:
    """Return the unit normal at each point of a mesh, (n_points, 3), weighted by area; z in the plane."""
    if mesh.is_planar:
        return np.tile([0.0, 0.0, 1.0], (mesh.n_points, 1))
    a, b, c = mesh.points[mesh.triangles].swapaxes(0, 1)
    cross = np.repeat(np.cross(b - a, c - a), 3, axis=0)
    total = np.column_stack([sums_by(mesh.triangles, part, mesh.n_points) for part in cross.T])
    length = np.linalg.norm(total, axis=1, keepdims=True)
    return np.asarray(np.where(length > 0, total / np.where(length > 0, length, 1.0), [0.0, 0.0, 1.0]))
