"""Random polygons with holes, sizes, interfaces and kept points: every grid that comes out verifies."""

from __future__ import annotations

import domains
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from bsgplan.blocks import lay_out
from bsgplan.blocks.lack import qualities
from bsgplan.blocks.verify import verify
from bsgplan.errors import LayoutRefused
from bsgplan.sizing import SizeField


@settings(max_examples=40)
@given(
    domains.random_domains(),
    st.sampled_from([1, 4, 16, 64]),
    st.sampled_from(["nothing", "kept", "regions", "sticks"]),
    st.booleans(),
)
def test_every_grid_verifies(size: SizeField, tris_per_block: int, features: str, is_straight: bool) -> None:
    """lay_out refuses or returns a grid of which every check holds, told by the arrays alone too."""
    mesh, random = size.mesh, np.random.default_rng(tris_per_block)
    interfaces, kept = None, None
    if features == "kept":
        kept = random.choice(mesh.n_points, size=min(3, mesh.n_points), replace=False)
    if features == "regions":
        is_right = np.append(mesh.centroids[:, 0] > 0.1, False)[mesh.topology.edge_cells]
        interfaces = (is_right[:, 0] != is_right[:, 1]) & ~mesh.topology.is_boundary_edge
    if features == "sticks":
        interfaces = ~mesh.topology.is_boundary_edge & (random.random(len(mesh.topology.edges)) < 0.05)
    try:
        grid = lay_out(size, tris_per_block=tris_per_block, effort=3, seed=1, is_straight=is_straight,
                       interfaces=interfaces, kept=kept)  # fmt: skip
    except LayoutRefused:
        return
    assert verify(grid).is_valid
    assert qualities(grid.placed).min() > 0
    assert grid.mesh.irregularity.total == -6 * grid.mesh.topology.euler_characteristic
