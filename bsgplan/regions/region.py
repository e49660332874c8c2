"""The noun of this folder: the regions of a size field, each with its kind and its measured profile."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..arrays import Ints, frozen_ints
from ..mesh import Mesh
from ..mesh.irregularity import Irregularity, summed
from ..sizing import SizeField
from .profile import Profile

TRANSITION, UNIFORM = "transition", "uniform"


@dataclass(frozen=True, eq=False)
class Region:
    """One connected piece of a mesh: a monotone transition between two sizes, or a uniform zone."""

    id: int
    """Its number in `Regions.label`."""
    kind: str
    """"transition" or "uniform"."""
    triangles: Ints = field(repr=False)
    """Indices of its triangles in the mesh, (n_triangles,), increasing."""
    weight: float
    """Equilateral triangles of size h that cover it."""
    area: float
    """Its area, length**2."""
    h_min: float
    """Smallest size at its vertices, length."""
    h_max: float
    """Largest size at its vertices, length."""
    profile: Profile = field(repr=False)
    """Its front counts from the fine to the coarse end."""
    is_closed: bool
    """True where its fronts are closed rings."""
    is_monotone: bool
    """False where a merge left it with more than one fine or coarse spot."""
    charge: float
    """Irregularity that the size field demands inside it, in units of iota."""
    q_min: float
    """Least mean ratio of its triangles."""
    irregularity: Irregularity
    """Sums of the vertex irregularities strictly inside it."""

    @property
    def n_triangles(self) -> int:
        """Number of its triangles."""
        return len(self.triangles)


@dataclass(frozen=True, eq=False)
class Regions:
    """All regions of a mesh: every triangle is in exactly one."""

    size: SizeField = field(repr=False)
    """The size field that was cut."""
    label: Ints = field(repr=False)
    """Region of each triangle, (n_triangles,); -1 outside where the user drew a region."""
    regions: tuple[Region, ...]
    """The regions, region i has label i."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "label", frozen_ints(self.label))

    def __iter__(self) -> Iterator[Region]:
        return iter(self.regions)

    def __len__(self) -> int:
        return len(self.regions)

    def __getitem__(self, index: int) -> Region:
        return self.regions[index]

    @cached_property
    def charge(self) -> float:
        """Charge of all regions together, in units of iota: the sum over them."""
        return float(sum(region.charge for region in self.regions))


def inner_irregularity(mesh: Mesh, label: Ints, n_labels: int) -> list[Irregularity]:
    """Return the irregularity of the vertices whose triangles all have one label and that are no boundary."""
    low = np.full(mesh.n_points, np.iinfo(np.int64).max)
    high = np.full(mesh.n_points, -1)
    corner, repeated = mesh.triangles.ravel(), np.repeat(label, 3)
    np.minimum.at(low, corner, repeated)
    np.maximum.at(high, corner, repeated)
    is_inner = (low == high) & ~mesh.topology.is_boundary
    values = mesh.vertex_irregularity
    order = np.argsort(high[is_inner], kind="stable")
    owners, sorted_values = high[is_inner][order], values[is_inner][order]
    cuts = np.searchsorted(owners, np.arange(n_labels + 1))
    return [summed(sorted_values[cuts[k] : cuts[k + 1]]) for k in range(n_labels)]
