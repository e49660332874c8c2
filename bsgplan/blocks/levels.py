"""What a multigrid user plans by: triangles, unknowns, interfaces and memory on each level of refinement."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

from ..mesh.topology import Topology

VECTORS = 5
"""Vectors a rank stores: solution, right side, residual and two helpers; stencils are not stored."""

BYTES_PER_UNKNOWN = 8
"""Bytes of an unknown in one vector: double precision."""


@dataclass(frozen=True)
class Level:
    """Blocks cut into side x side triangles each."""

    side: int
    n_triangles: int
    p1: int
    """Unknowns of linear elements: the points."""
    p2: int
    """Unknowns of quadratic elements: points and edges."""
    interface_edges: int
    """Edges on interfaces between two blocks: what neighbours exchange."""


@dataclass(frozen=True)
class Ranks:
    """Blocks handed out evenly."""

    n_ranks: int
    blocks_least: int
    blocks_most: int
    imbalance: float
    """Most blocks of a rank over the mean."""

    def memory(self, sides: tuple[int, ...]) -> int:
        """Return bytes of P1 vectors on the fullest rank, for all levels given; a block stores its own rim.

        >>> Ranks(2, 1, 1, 1.0).memory((1,))
        120
        """
        unknowns = sum((s + 1) * (s + 2) // 2 for s in sides)
        return self.blocks_most * unknowns * VECTORS * BYTES_PER_UNKNOWN


def levels(blocks: Topology, side: int) -> tuple[Level, ...]:
    """Return the levels from blocks to triangles: each halves edges while side allows, else one step."""
    return tuple(level(blocks, s) for s in sides(side))


def sides(side: int) -> tuple[int, ...]:
    """Return triangles along a block's side on each level, coarsest first.

    >>> sides(8), sides(6)
    ((1, 2, 4, 8), (1, 3, 6))
    """
    result = [side]
    while result[0] % 2 == 0:
        result.insert(0, result[0] // 2)
    return tuple(result if result[0] == 1 else [1, *result])


def level(blocks: Topology, side: int) -> Level:
    """Return what blocks make when each is cut into side x side triangles."""
    n_points, n_edges, n_blocks = blocks.n_points, len(blocks.edges), len(blocks.cells)

    def points(s: int) -> int:
        return n_points + n_edges * (s - 1) + n_blocks * (s - 1) * (s - 2) // 2

    n_interfaces = n_edges - int(blocks.is_boundary_edge.sum())
    return Level(side, n_blocks * side**2, points(side), points(2 * side), n_interfaces * side)


def ranks(n_blocks: int, n_ranks: int) -> Ranks:
    """Return how blocks of equal work spread over ranks.

    >>> ranks(10, 4)
    Ranks(n_ranks=4, blocks_least=2, blocks_most=3, imbalance=1.2)
    """
    most = ceil(n_blocks / n_ranks)
    return Ranks(n_ranks, n_blocks // n_ranks, most, most * n_ranks / n_blocks)
