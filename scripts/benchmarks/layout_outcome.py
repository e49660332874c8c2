"""What one layout gave, and what it is judged by: the same functions for it and for its rivals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from statistics import median

import numpy as np

from bsgplan.arrays import Ints
from bsgplan.blocks import BlockGrid
from bsgplan.blocks.measures import Measures
from bsgplan.mesh import Mesh, quality
from bsgplan.mesh.irregularity import fitted_boundary_irregularity

POOR = 0.3
"""Mean ratio under which a triangle is poor."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """What one seed gave."""

    grid: BlockGrid
    blocks: Measures
    fine: Measures
    deviation: float
    cpu: float
    """Seconds, compilation aside."""


def medians(outcomes: list[Outcome], of: Callable[[Outcome], Measures]) -> dict[str, float]:
    """Return the medians over outcomes of numbers of their blocks, or of their grids."""
    return medians_of([of(outcome) for outcome in outcomes])


def medians_of(every: list[Measures]) -> dict[str, float]:
    """Return the medians of numbers of some meshes."""
    return {
        "blocks": median(m.n_blocks or 0 for m in every),
        "interior": median(m.irregular_interior for m in every),
        "irregular": median(map(n_irregular, every)),
        "q_min": median(m.q_min for m in every),
        "q_p01": median(m.q_p01 for m in every),
        "rms": median(m.edge_ratio.rms_log for m in every),
        "triangles": median(m.n_triangles for m in every),
    }


def n_irregular(m: Measures) -> int:
    """Return the number of irregular vertices, boundary ones held against their angle."""
    return m.irregular_interior + m.irregular_boundary_fitted


def n_off(mesh: Mesh) -> int:
    """Return the number of vertices with two edges or more too many or too few."""
    inside = np.where(mesh.topology.is_boundary, 0, mesh.vertex_irregularity)
    fitted: Ints = fitted_boundary_irregularity(mesh.topology, quality.angles(mesh.corner_edge_lengths))
    return int(np.count_nonzero(np.abs(inside + fitted) >= 2))


def n_poor(mesh: Mesh) -> int:
    """Return the number of poor triangles."""
    return int(np.count_nonzero(mesh.qualities < POOR))
