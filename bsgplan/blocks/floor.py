"""The floor under the number of irregular vertices: what topology and corners demand of any layout."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .kinds import CORNER, HALF_EDGE
from .layout import BlockLayout


@dataclass(frozen=True)
class Floor:
    """What no layout of a domain can go below, where vertices are off by one edge at most."""

    irregularity: int
    """iota_m = -6 chi, pinches split: the sum over all vertices of valence less 6, or less 4 at walls."""
    n_corners: int
    """Corners of the domain on its boundary."""
    corners: tuple[int, int]
    """Least and most of that sum that the corners carry when each fits its angle."""

    @property
    def irregular(self) -> int:
        """Fewest irregular vertices beside the corners: what these leave of iota_m."""
        least, most = self.corners
        return max(least - self.irregularity, self.irregularity - most, 0)


def floor_of(layout: BlockLayout) -> Floor:
    """Return the floor of the domain of a layout, with the corners that the layout has."""
    placed = layout.placed
    is_corner = (placed.kinds >= CORNER) & placed.topology.is_boundary
    goals = placed.goals[is_corner]
    least, most = (np.maximum(v, 2.0) - 4 for v in (np.ceil(goals - HALF_EDGE), np.floor(goals + HALF_EDGE)))
    return Floor(
        irregularity=-6 * placed.topology.euler_characteristic,
        n_corners=int(np.count_nonzero(is_corner)),
        corners=(int(least.sum()), int(most.sum())),
    )
