"""The nouns Part and Replacement: what was tried in a mesh, and the mesh that came of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from ..arrays import Floats, Ints
from ..mesh import Mesh
from ..sizing import SizeField
from ..sizing.charge import region_charges
from .by_strips import Tries
from .floor import floor_of
from .graft import Graft
from .measures import Measures, measured


@dataclass(frozen=True)
class Part:
    """A part of the mesh that was tried."""

    name: str
    """What it is, in a word or two."""
    before: Measures
    after: Measures
    """As it is now: `before` where it was left alone."""
    reason: str
    """Why it was left alone; "" where it was replaced."""
    strips: Tries = Tries()  # noqa: RUF009 - frozen
    """In how many of its regions strips of fronts were tried, and in how many they are what it has now."""
    offenders: tuple[int, ...] = ()
    """Regions whose quality alone stands in the way."""
    could_gain: bool = False
    """True where it was left alone for something else than its gain."""


@dataclass(frozen=True, eq=False)
class Replacement:
    """A mesh with parts of it replaced."""

    size: SizeField = field(repr=False)
    """The wanted edge lengths, on the mesh as it was."""
    graft: Graft = field(repr=False)
    """The mesh as it is, and where it comes from."""
    label: Ints = field(repr=False)
    """Region of each old triangle, (n_old_triangles,), -1 outside."""
    parts: tuple[Part, ...]
    """What was tried, in order."""
    is_interrupted: bool = False
    """True where the annealing was ended early."""

    @property
    def mesh(self) -> Mesh:
        """The mesh as it is."""
        return self.graft.mesh

    @property
    def new_label(self) -> Ints:
        """Region of each triangle, (n_triangles,), -1 outside."""
        return self.label[self.graft.source]

    @property
    def log_size(self) -> Floats:
        """Log of the wanted edge length at each point, (n_points,)."""
        return self.graft.at_points(self.size.log_h)

    def totals(self) -> tuple[Measures, Measures]:
        """Return the measures of the whole mesh before and after."""
        return measured(self.size.mesh, self.size.log_h), measured(self.mesh, self.log_size)

    def charges(self) -> Floats:
        """Return the irregularity that the curvature of the size demands inside each region, (n_labels,).

        The budget: the sum of iota over its interior vertices, see `sizing.charge`.
        """
        n = int(self.label.max(initial=-1)) + 1
        return region_charges(np.where(self.label < 0, n, self.label), self.size.fluxes)[:n]

    def floor(self) -> int:
        """Return the fewest irregular vertices inside that the boundary allows, see `floor_of`."""
        return floor_of(self.size.mesh)

    def regions(self) -> Iterator[tuple[int, Measures, Measures]]:
        """Give each region with its measures before and after; a vertex counts with its last region."""
        sides = [(self.size.mesh, self.size.log_h, self.label), (self.mesh, self.log_size, self.new_label)]
        at = [_last_label(mesh, label) for mesh, _, label in sides]
        for k in range(int(self.label.max()) + 1):
            if all((label == k).any() for _, _, label in sides):
                before, after = (
                    measured(mesh, log_size, label == k, own == k)
                    for (mesh, log_size, label), own in zip(sides, at, strict=True)
                )
                yield k, before, after


def _last_label(mesh: Mesh, label: Ints) -> Ints:
    """Return the largest label round each vertex, (n_points,)."""
    result = np.full(mesh.n_points, -1, dtype=np.int64)
    np.maximum.at(result, mesh.triangles.ravel(), np.repeat(label, 3))
    return result
