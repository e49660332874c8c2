"""The noun Wish: what the annealing of a part steers to."""

from __future__ import annotations

from dataclasses import dataclass

from ..arrays import Floats, Ints


@dataclass(frozen=True, eq=False)
class Wish:
    """What is asked of a part, by the regions of its domain."""

    n_triangles: float
    """Triangles wanted."""
    size_misfit: float
    """rms of log(edge / wanted edge) that the part has now."""
    label: Ints
    """Region of each triangle of the domain, from 0, (n_domain_triangles,)."""
    least: Floats
    """Mean ratio under which a triangle there is mended, (n_domain_triangles,)."""
    floor: Floats
    """Mean ratio under which a triangle there refuses the whole, (n_domain_triangles,)."""
    tolerance: float = 0.1
    """Share by which the number of triangles may differ."""
