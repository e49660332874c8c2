"""The noun Boundary: a list of points that a file calls an open, a land or a named boundary."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..arrays import Floats, Ints, frozen_floats, frozen_ints

Kind = Literal["open", "land", "named"]


@dataclass(frozen=True, eq=False)
class Boundary:
    """Points of one boundary segment, with what the file says at each of them."""

    kind: Kind
    """"open" and "land" as ADCIRC and SCHISM mean them; "named" for a physical group or marker."""
    nodes: Ints
    """Indices into the points of the mesh, (n_nodes,), in the order of the file."""
    code: int | None = None
    """IBTYPE of an ADCIRC segment, tag of a named one; None where the file gives none."""
    name: str = ""
    """Name of a physical group or marker."""
    partners: Ints | None = None
    """The point across the barrier at each node, (n_nodes,); None unless the segment is a pair of sides."""
    columns: Floats | None = None
    """Further numbers at each node (crest height, coefficients), (n_nodes, k); None where there are none."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "nodes", frozen_ints(self.nodes))
        if self.partners is not None:
            object.__setattr__(self, "partners", frozen_ints(self.partners))
        if self.columns is not None:
            object.__setattr__(self, "columns", frozen_floats(self.columns))

    @property
    def n_nodes(self) -> int:
        """Number of points in the segment (pairs of points at a barrier)."""
        return len(self.nodes)

    def renumbered(self, new_index: Ints) -> Boundary:
        """Return the segment with nodes new_index[node], without those where that is negative."""
        nodes = new_index[self.nodes]
        is_kept = nodes >= 0
        partners, columns = self.partners, self.columns
        if partners is not None:
            is_kept = is_kept & (new_index[partners] >= 0)
            partners = new_index[partners][is_kept]
        if columns is not None:
            columns = columns[is_kept]
        return replace(self, nodes=nodes[is_kept], partners=partners, columns=columns)


def n_nodes(boundaries: tuple[Boundary, ...]) -> int:
    """Return the number of nodes of all segments, shared ones counted in each.

    >>> n_nodes((Boundary("open", np.array([0, 1])), Boundary("land", np.array([1, 2, 0]))))
    5
    """
    return int(np.sum([boundary.n_nodes for boundary in boundaries], dtype=np.int64))
