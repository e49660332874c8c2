"""The noun Weights: what counts how much in the energy of an annealing; a triangle's quality counts 1."""

from __future__ import annotations

from dataclasses import dataclass

SIZE_WEIGHT = 0.55
"""Weight of sizes in layouts at the default tolerance."""


@dataclass(frozen=True)
class Weights:
    """Weights of the energy."""

    size: float
    """Of the square of the log of a triangle's area over that wanted."""
    valence: float
    """Of a vertex that is off by one edge."""
    of_grid: float
    """Share of a boundary vertex's irregularity that is judged in the grid to be cut, not in the blocks.

    Blocks take the chord where the grid follows the curve: round an island of six blocks four triangles suit
    a vertex of the blocks, three that of the grid."""
    bend: float = 1.0
    """Of a bent side."""


BLOCKS = Weights(size=SIZE_WEIGHT, valence=0.8, of_grid=0.15)
"""Of layouts."""

TRIANGLES = Weights(size=0.5, valence=0.6, of_grid=0.0)
"""Of parts of meshes, which are no blocks to be cut."""
