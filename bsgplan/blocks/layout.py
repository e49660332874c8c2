"""The noun BlockLayout: a conforming mesh of blocks on a domain. The noun BlockGrid: the same, subdivided.

Invariants, held by `verify`: positive areas, conforming, the domain's Euler number and loops, corners
present; every block of a grid has exactly side^2 triangles.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..mesh import Mesh
from ..sizing import SizeField
from .domain import Domain
from .placed import PlacedMesh
from .target import Target


@dataclass(frozen=True, eq=False)
class BlockLayout:
    """Blocks: a coarse conforming mesh whose vertices on the boundary lie on the true boundary."""

    size: SizeField = field(repr=False)
    """The size field of the input, on the input's mesh."""
    domain: Domain = field(repr=False)
    """Where the blocks lie: curves, corners, coordinates."""
    target: Target = field(repr=False)
    """The block size that was wanted, and what limited it."""
    placed: PlacedMesh = field(repr=False)
    """The blocks in the domain's own coordinates."""

    @property
    def side(self) -> int:
        """Triangles along one side of a block: s."""
        return self.target.side

    @property
    def n_blocks(self) -> int:
        """Number of blocks."""
        return len(self.placed.triangles)

    @cached_property
    def mesh(self) -> Mesh:
        """The blocks as a mesh in the coordinates of the input."""
        return Mesh(self.domain.to_mesh(self.placed.points), self.placed.triangles)

    @property
    def is_irregular(self) -> Bools:
        """Vertices whose valence is off: 6 inside, 4 on the boundary, at corners what their angle wants."""
        return self.placed.is_irregular

    def __repr__(self) -> str:
        return f"BlockLayout({self.n_blocks} blocks of {self.side**2} triangles)"


@dataclass(frozen=True, eq=False)
class BlockGrid:
    """A layout whose blocks are cut into side x side triangles each."""

    layout: BlockLayout
    """The blocks."""
    placed: PlacedMesh = field(repr=False)
    """The triangles in the domain's own coordinates."""
    block: Ints = field(repr=False)
    """Block of each triangle, (n_triangles,)."""
    i: Ints = field(repr=False)
    """Steps from the block's corner 0 towards its corner 1, (n_triangles,)."""
    j: Ints = field(repr=False)
    """Steps from the block's corner 0 towards its corner 2, (n_triangles,)."""
    is_straight: bool
    """True where blocks have straight sides; else nodes follow the boundary and the grid is smoothed."""

    @property
    def n_triangles(self) -> int:
        """Number of triangles."""
        return len(self.placed.triangles)

    @cached_property
    def mesh(self) -> Mesh:
        """The triangles as a mesh in the coordinates of the input."""
        return Mesh(self.layout.domain.to_mesh(self.placed.points), self.placed.triangles)

    def at_points(self, values: Floats) -> Floats:
        """Return values at the input's points interpolated to the grid's points, (n_points, ...)."""
        return interpolated(self.layout.domain, self.placed, values)

    def __repr__(self) -> str:
        return f"BlockGrid({self.n_triangles} triangles in {self.layout.n_blocks} blocks)"


def interpolated(domain: Domain, placed: PlacedMesh, values: Floats) -> Floats:
    """Return values at the points of the input mesh, (n, ...), interpolated linearly to those of placed."""
    from .kernel.walk import locate

    triangle, shares = locate(domain.points, domain.triangles, placed.points, placed.hints)
    own = np.asarray(values, dtype=np.float64)[domain.source[domain.triangles[triangle, :3]]]
    return np.asarray(np.einsum("pc,pc...->p...", shares, own))
