"""Carry the regions of a thinned mesh back to the whole one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import grouped
from ..mesh.thinned import Thinned
from ..sizing.thinned import whole_size_field
from .region import Regions, inner_irregularity


def carried(regions: Regions, thin: Thinned) -> Regions:
    """Return the regions of the thinned mesh as regions of the whole one.

    Triangles, q_min and irregularity are those of the whole mesh; what was measured by means of the size
    field stays as it is. A region of the thinned mesh that no triangle of the whole was left in cannot be:
    every triangle left is one of the whole.
    """
    label = regions.label[thin.triangle]
    n = len(regions)
    shown = np.where(label >= 0, label, n)
    order, start = grouped(shown, n + 1)
    irregularity = inner_irregularity(thin.whole, shown, n)
    parts = [order[start[k] : start[k + 1]] for k in range(n)]
    return Regions(
        whole_size_field(thin, regions.size),
        label,
        tuple(
            replace(
                region,
                triangles=own,
                q_min=float(thin.whole.qualities[own].min()),
                irregularity=irregularity[region.id],
            )
            for region, own in zip(regions, parts, strict=True)
        ),
    )
