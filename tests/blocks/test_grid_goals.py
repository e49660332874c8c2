"""What a vertex on the boundary should have in the grid: triangles for the curve's angle, not the blocks'."""

from __future__ import annotations

import domains
import numpy as np
import pytest
import shapely
from probes import probe

from bsgplan.blocks.corners import find_corners
from bsgplan.blocks.domain import Domain, domain_of
from bsgplan.blocks.kernel import energy, size_at
from bsgplan.blocks.kernel.exchange import load
from bsgplan.blocks.kernel.state import (
    ENERGY,
    GOAL,
    GRID_GOAL,
    KIND,
    N_VERTICES,
    OF_GRID,
    PARTS,
    VALENCE,
    VALENCES,
    State,
)
from bsgplan.blocks.kernel.sweeps import renew
from bsgplan.blocks.kinds import CORNER, INTERIOR, SLIDING
from bsgplan.blocks.placed import place
from bsgplan.blocks.weights import BLOCKS, TRIANGLES

RADIUS = 1.0
HOLE = shapely.Point(2.5, 2.0).buffer(RADIUS, quad_segs=48)
HOLED = domain_of(domains.polygon_mesh(shapely.box(0, 0, 5, 4).difference(HOLE), 0.5, 5))

goal_on_curve, grid_goal_on_curve = probe(size_at.goal_on_curve), probe(size_at.grid_goal_on_curve)
valence_cost = probe(energy.valence_cost)


def loaded(domain: Domain, size: float) -> tuple[State, np.ndarray]:
    """A state that wants edges of one size, and its sliding vertices on the hole."""
    sizes = np.full(domain.n_points, size / domain.scale)
    state = load(domain, place(domain, *find_corners(domain, sizes)), np.log(sizes))
    slides = state.vertex[: state.counter[N_VERTICES], KIND] == SLIDING
    return state, np.flatnonzero(slides & (from_middle(domain, state) < 1.01 * RADIUS))


def from_middle(domain: Domain, state: State) -> np.ndarray:
    """Distances of the vertices from the middle of the hole."""
    return np.hypot(*(domain.to_mesh(state.point[: state.counter[N_VERTICES]]) - [2.5, 2.0]).T)


@pytest.mark.parametrize("edge", [0.3, 0.45, 0.7, 1.0, 1.3, 3.0])
def test_round_a_hole_both_goals_are_those_of_chords(edge: float) -> None:
    """Chords over an arc a before and after turn by a / R: blocks have the edge for a, the grid a quarter."""

    def fitting(arc: float) -> float:
        return np.rint(1 + (np.pi + arc / RADIUS) / (np.pi / 3))

    state, there = loaded(HOLED, edge)
    assert len(there) > 100
    round_it = 2 * np.pi * RADIUS / 3  # a window takes no more than a third of the loop
    for v in there[::7].tolist():
        assert goal_on_curve(state, v) == fitting(min(edge, round_it))
        assert grid_goal_on_curve(state, v) == fitting(edge / PARTS) == state.value[v, GRID_GOAL]


def test_goals_in_the_grid_are_the_others_where_nothing_slides() -> None:
    """Inside and at corners the blocks' own; on straight sides four."""
    state, _ = loaded(HOLED, 0.5)
    used = np.arange(state.counter[N_VERTICES])
    kinds = state.vertex[used, KIND]
    fixed = (kinds == INTERIOR) | (kinds == CORNER)
    assert np.array_equal(state.value[used, GRID_GOAL][fixed], state.value[used, GOAL][fixed])
    straight = (kinds == SLIDING) & (from_middle(HOLED, state) > 1.2 * RADIUS)
    assert straight.sum() > 5
    assert (state.value[used, GRID_GOAL][straight] == 4).all()


def test_a_vertex_pays_for_both_by_share() -> None:
    """Five edges suit the blocks and four the grid: each costs the other's share, six both."""
    state, there = loaded(HOLED, 1.0)
    v = int(there[0])
    state.value[v, GOAL], state.value[v, GRID_GOAL] = 5.0, 4.0
    share = BLOCKS.of_grid
    for valence, cost in {4: 1 - share, 5: share, 6: 1 - share + 2.8 * share}.items():
        assert valence_cost(state, v, valence) == pytest.approx(cost)
    state.vertex[v, VALENCE] = 4
    renew(state)
    assert state.value[v, ENERGY] == pytest.approx(state.scalar[VALENCES] * (1 - share))


def test_a_mesh_that_is_not_cut_has_only_its_own_goals() -> None:
    """Replacing a part of a mesh asks nothing of a grid."""
    sizes = np.full(HOLED.n_points, 1.0 / HOLED.scale)
    mesh = place(HOLED, *find_corners(HOLED, sizes))
    state = load(HOLED, mesh, np.log(sizes), weights=TRIANGLES)
    assert state.scalar[OF_GRID] == 0
    v = int(np.flatnonzero(state.vertex[:, KIND] == SLIDING)[0])
    state.value[v, GOAL], state.value[v, GRID_GOAL] = 5.0, 4.0
    assert [valence_cost(state, v, n) for n in (4, 5, 6)] == [1.0, 0.0, 1.0]
