"""What keeps the number of blocks right, and triangles at corners: credit, and goals that are fractions."""

from __future__ import annotations

import domains
import numpy as np
import pytest
import shapely
from probes import probe

from bsgplan.blocks import lay_out
from bsgplan.blocks.domain import domain_of
from bsgplan.blocks.kernel import energy
from bsgplan.blocks.kernel.exchange import load
from bsgplan.blocks.kernel.schedule import give_credit
from bsgplan.blocks.kernel.state import CREDIT, GOAL, VALENCES
from bsgplan.blocks.kernel.sweeps import renew
from bsgplan.blocks.kinds import CORNER
from bsgplan.blocks.placed import place
from bsgplan.io import read
from bsgplan.sizing import SizeField, size_field

WEDGE = domain_of(domains.polygon_mesh(shapely.Polygon([(0, 0), (3, 0), (2.2, 2), (-0.7, 2)]), 0.2, 5))
off_goal, valence_energy = probe(energy.off_goal), probe(energy.valence_energy)


def test_credit_of_the_whole_mean_leaves_nothing() -> None:
    """The sum of all energies is 0, that of half of it half; giving it twice gives it once."""
    nowhere = np.zeros(WEDGE.n_points, dtype=bool)
    mesh = place(WEDGE, nowhere, np.zeros(WEDGE.n_points))
    state = load(WEDGE, mesh, np.full(WEDGE.n_points, np.log(0.1)))
    total = renew(state)
    assert total > 1
    for share in (0.5, 1.0, 1.0):
        give_credit(state, share)
        assert state.scalar[CREDIT] == pytest.approx(share * total / len(mesh.triangles))
        assert renew(state) == pytest.approx((1 - share) * total, abs=1e-9 * total)


@pytest.mark.parametrize(
    ("degrees", "fitting"), [(60, {2}), (90, {2, 3}), (104, {3}), (120, {3}), (150, {3, 4}), (40, {2})]
)
def test_a_corner_pays_for_every_triangle_off_its_angle(degrees: float, fitting: set[int]) -> None:
    """One triangle for 104 degrees costs what an irregular vertex costs anywhere: it is one."""
    is_corner = np.zeros(WEDGE.n_points, dtype=bool)
    v = int(WEDGE.curve_nodes[0])
    is_corner[v] = True
    state = load(WEDGE, place(WEDGE, is_corner, np.zeros(WEDGE.n_points)), np.zeros(WEDGE.n_points))
    assert state.vertex[v, 2] == CORNER
    state.value[v, GOAL] = 1 + degrees / 60
    for valence in range(2, 7):
        away = min(abs(valence - n) for n in fitting)
        assert off_goal(state, v, valence) == away
        state.vertex[v, 1] = valence
        if away == 1:
            assert valence_energy(state, v) == pytest.approx(state.scalar[VALENCES])


def test_a_steep_field_gets_the_blocks_that_it_wants() -> None:
    """Fine discs in a coarse square: without credit blocks step over them, 55 for 93."""
    mesh = domains.grid_mesh(36, 36)
    discs = np.array([[18, 18], [0, 0], [36, 36], [0, 36], [36, 0]])
    away = np.linalg.norm(mesh.points[:, None] - discs, axis=2).min(axis=1)
    grid = lay_out(SizeField(mesh, 0.4 + 0.3 * np.maximum(away - 2.5, 0.0)), effort=40, seed=4)
    assert grid.layout.n_blocks == pytest.approx(grid.layout.target.blocks["resolution"], rel=0.1)


def test_nothing_is_credited_where_there_are_plenty(meshes) -> None:
    """In the fjords of the North Sea the mean energy is that of few triangles: credit gave 10 000 blocks."""
    grid = lay_out(size_field(read(meshes / "north_sea.msh").mesh), tris_per_block=16, seed=7, effort=20)
    assert grid.layout.n_blocks < 1.3 * grid.layout.target.blocks["boundary"]


def test_the_bone_gets_the_blocks_that_it_wants(meshes) -> None:
    """Its fine discs were passed over: 97 blocks where s h asks for 143."""
    grid = lay_out(size_field(read(meshes / "osteonT1_11.mesh").mesh), tris_per_block=16, seed=7)
    assert grid.layout.n_blocks == pytest.approx(grid.layout.target.blocks["resolution"], rel=0.1)
