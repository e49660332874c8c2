"""Vertex and mesh irregularity of triangles and quads, and the identity that ties them to topology.

[Zint & Grosso], Definitions 1 to 3 and Eq. 2 to 5. Invariant, checked on every mesh:
iota_m = -6 chi - 2 p for triangles and -4 chi - p for quads, p the number of pinches.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..errors import InvalidMesh
from .topology import Topology

HALFWAY = 1e-6
"""A boundary angle so near to halfway between two numbers of triangles, in 60 degrees, fits both: whether a
right angle has one triangle or two is not for the rounding of its coordinates to judge."""

OPTIMAL_VALENCE = {3: (6, 4), 4: (4, 3)}
"""Optimal valence of an interior and of a boundary vertex, by the number of corners (Definition 1)."""


@dataclass(frozen=True)
class Irregularity:
    """Sums of the positive and of the negative vertex irregularities (Definition 3)."""

    positive: int
    negative: int

    @property
    def total(self) -> int:
        """The mesh irregularity iota_m, Eq. 5."""
        return self.positive + self.negative


def vertex_irregularity(topology: Topology) -> Ints:
    """Return valence minus optimal valence of each vertex, (n_points,) (Definition 1)."""
    interior, boundary = OPTIMAL_VALENCE[topology.cells.shape[1]]
    optimal = np.where(topology.is_boundary, boundary, interior)
    return np.where(topology.n_cells_at > 0, topology.valence - optimal, 0)


def summed(vertex_values: Ints) -> Irregularity:
    """Return the positive and the negative sum of vertex irregularities.

    >>> summed(np.array([1, -2, 0, 3]))
    Irregularity(positive=4, negative=-2)
    """
    values = np.asarray(vertex_values)
    return Irregularity(int(values[values > 0].sum()), int(values[values < 0].sum()))


def mesh_irregularity(topology: Topology) -> Irregularity:
    """Return the irregularity of a mesh, checked against its Euler characteristic.

    Raises InvalidMesh when the identity fails, which no conforming mesh does.
    """
    result = summed(vertex_irregularity(topology))
    chi, pinches = topology.euler_characteristic, topology.n_pinches
    expected = -6 * chi - 2 * pinches if topology.cells.shape[1] == 3 else -4 * chi - pinches
    if result.total != expected:
        raise InvalidMesh(
            f"mesh irregularity {result.total} is not the {expected} that Euler characteristic {chi} and "
            f"{pinches} pinches demand; the cells are not a manifold mesh, clean it first"
        )
    return result


def genus(topology: Topology) -> Ints:
    """Return the genus of each edge-connected component, pinches split, (n_components,).

    chi = 2 - 2 g - b, [Zint & Grosso], Eq. 1.
    """
    n = topology.n_components
    n_fans = int(topology.corner_fan.max()) + 1
    component_of_fan = np.empty(n_fans, dtype=np.int64)
    component_of_fan[topology.corner_fan.ravel()] = np.repeat(topology.component, topology.cells.shape[1])
    edge_component = topology.component[topology.edge_cells[:, 0]]
    chi = (
        np.bincount(component_of_fan, minlength=n)
        - np.bincount(edge_component, minlength=n)
        + np.bincount(topology.component, minlength=n)
    )
    boundary_component = edge_component[topology.is_boundary_edge]
    loops = np.unique(np.column_stack([boundary_component, topology.edge_loop]), axis=0)
    n_loops = np.bincount(loops[:, 0], minlength=n)
    return (2 - chi - n_loops) // 2


def fitted_boundary_irregularity(topology: Topology, corner_angles: Floats) -> Ints:
    """Return triangles minus max(1, round(angle / 60 degrees)) of each boundary vertex, (n_points,).

    Fair to corners; 0 at interior vertices. An angle halfway fits both numbers. corner_angles as
    `quality.angles` gives them.
    """
    angle = np.bincount(topology.cells.ravel(), weights=corner_angles.ravel(), minlength=topology.n_points)
    share = angle / (np.pi / 3)
    least, most = np.ceil(share - 0.5 - HALFWAY), np.floor(share + 0.5 + HALFWAY)
    fitting = np.clip(topology.n_cells_at, np.maximum(least, 1), np.maximum(most, 1)).astype(np.int64)
    return np.where(topology.is_boundary, topology.n_cells_at - fitting, 0)
