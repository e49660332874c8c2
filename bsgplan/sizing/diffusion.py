"""Diffusion of vertex values over a local length: any response to waves, as a polynomial of the stiffness.

A function of x, the eigenvalues of M^-1 K with the squared length as conductivity, is a low pass where it
falls from 1 at x = 0. Its Chebyshev series up to the largest eigenvalue, a few dozen products with an
edge-weighted matrix, replaces solving: all components at once, nothing assembled or compared on the way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev
from scipy.sparse import csr_array

from ..arrays import Floats, sums_by
from ..mesh import Mesh
from ..mesh.operators import between_ends, cotangents, edge_weights, vertex_areas

SLIVER = 0.3
"""Mean ratio below which a triangle's stiffness is damped: cotangents of slivers grow without bound and
would tie their corners together. Real meshes have a mean ratio of .9; this touches under 1 % of them."""

RESPONSE_ERROR = 2e-3
"""Error of the response at any wave length: a tenth of the noise of a mesh generator after smoothing."""

MOST_STIFF = 3.0
"""Vertices stiffer than so many times the median, by Gershgorin's bound, are damped to it: one needle would
else set the number of products for the whole mesh."""

LARGEST_DEGREE = 200
"""Products at most; the error then grows with the length, the mean is still kept."""


def once(x: Floats) -> Floats:
    """Return the response 1 / (1 + x) to waves: (M + K_{length^2}) v = M values.

    Keeps the mean; flattens at the wall.
    """
    return 1 / (1 + x)


def gently(x: Floats) -> Floats:
    """Return the response 2 S - S^2 to waves, S that of `once`.

    What diffusion loses is diffused once more and added: long waves pass, and one-sided means at the wall
    cost less.
    """
    return 2 * once(x) - once(x) ** 2


@dataclass(frozen=True, eq=False)
class Diffusion:
    """M^-1 K over a local length, moved and scaled to a spectrum in -1 .. 1."""

    matrix: csr_array
    """Off the diagonal, (n_points, n_points)."""
    diagonal: Floats
    """On the diagonal, (n_points,)."""
    bound: float
    """Largest eigenvalue x of M^-1 K."""

    @classmethod
    def over(cls, mesh: Mesh, length: Floats) -> Diffusion:
        """Return the diffusion over a length a triangle, (n_triangles,)."""
        mass = vertex_areas(mesh)
        conductivity, bound = _bounded(mesh, length**2 * np.minimum(mesh.qualities / SLIVER, 1.0), mass)
        weights = edge_weights(mesh, conductivity) / (bound / 2)
        around = sum(sums_by(end, weights, mesh.n_points) for end in mesh.topology.edges.T)
        matrix = between_ends(mesh, -weights)
        matrix.data /= np.repeat(mass, np.diff(matrix.indptr))
        return cls(matrix, around / mass - 1.0, bound)

    def filtered(self, values: Floats, response: Callable[[Floats], Floats], reach: float = 1.0) -> Floats:
        """Return the vertex values with each wave weighed by the response to its x, (n_points, ...).

        reach multiplies the length, and so its square x. response(0) = 1: constants and the integral are kept
        to rounding.
        """
        series = _series(lambda x: response(reach**2 * x), self.bound)
        columns = np.ascontiguousarray(values.reshape(len(values), -1).T)
        results = [_chebyshev_sum(self.matrix, self.diagonal, series, column) for column in columns]
        return np.column_stack(results).reshape(values.shape)


def _series(response: Callable[[Floats], Floats], bound: float) -> Floats:
    """Return the shortest Chebyshev series of the response on 0 .. bound, exact at 0."""
    nodes = chebyshev.chebpts1(LARGEST_DEGREE + 1)
    full = chebyshev.chebfit(nodes, response((nodes + 1) * bound / 2), LARGEST_DEGREE)
    missed = np.cumsum(np.abs(full)[::-1])[::-1]
    degree = int(np.argmax(np.append(missed[1:], 0.0) < RESPONSE_ERROR))
    kept = full[: max(degree, 1) + 1]
    return np.asarray(kept / chebyshev.chebval(-1.0, kept))


def _chebyshev_sum(matrix: csr_array, diagonal: Floats, coefficients: Floats, values: Floats) -> Floats:
    """Return the sum of c_k T_k(B) values, (n,), B = the matrix + D with its spectrum in -1 .. 1."""
    before, now = values, np.asarray(matrix @ values) + diagonal * values
    result = coefficients[0] * before + coefficients[1] * now
    matrix, diagonal = 2 * matrix, 2 * diagonal
    for c in coefficients[2:]:
        after = np.asarray(matrix @ now)
        after += diagonal * now
        after -= before
        before, now = now, after
        result += c * now
    return np.asarray(result)


def _bounded(mesh: Mesh, conductivity: Floats, mass: Floats) -> tuple[Floats, float]:
    """Return the conductivity, damped around the stiffest vertices, and a bound on the eigenvalues of M^-1 K.

    Gershgorin: twice the sum of the positive weights of a vertex over its mass.
    """
    positive = np.maximum(cotangents(mesh), 0.0) * conductivity[:, None]
    stiff = np.zeros(mesh.n_points)
    for corner, others in ((0, (1, 2)), (1, (2, 0)), (2, (0, 1))):
        both = positive[:, others[0]] + positive[:, others[1]]
        stiff += np.bincount(mesh.triangles[:, corner], both, mesh.n_points)
    stiff /= mass
    bound = min(float(stiff.max()), MOST_STIFF * float(np.median(stiff)))
    if bound <= 0:
        return conductivity, 1.0
    worst = np.maximum.reduce([stiff[corner] for corner in mesh.triangles.T])
    return conductivity * np.minimum(1.0, bound / np.maximum(worst, bound)), bound
