"""Random sequences of moves against a twin rebuilt from scratch: nothing drifts, everything can be undone."""

from __future__ import annotations

import domains
import numpy as np
import pytest
from probes import probe

from bsgplan.arrays import Floats
from bsgplan.blocks.corners import find_corners
from bsgplan.blocks.domain import Domain, domain_of
from bsgplan.blocks.kernel import collapse as collapses
from bsgplan.blocks.kernel import energy as energies
from bsgplan.blocks.kernel import flip as flips
from bsgplan.blocks.kernel import journal
from bsgplan.blocks.kernel import relax as relaxations
from bsgplan.blocks.kernel import split as splits
from bsgplan.blocks.kernel.anneal import anneal
from bsgplan.blocks.kernel.exchange import load, unload
from bsgplan.blocks.kernel.schedule import give_credit
from bsgplan.blocks.kernel.state import (
    ARC,
    DELTA,
    ENERGY,
    KIND,
    N_FREE_TRIANGLES,
    N_FREE_VERTICES,
    N_TRIANGLES,
    N_VERTICES,
    OVERFLOW,
    TEMPERATURE,
    TRIANGLE,
    VALENCE,
    State,
)
from bsgplan.blocks.kinds import CORNER
from bsgplan.blocks.placed import place

N_MOVES = 250

begin, commit, rollback = map(probe, (journal.begin, journal.commit, journal.rollback))
can_flip, flip = probe(flips.can_flip), probe(flips.flip)
can_split, split = probe(splits.can_split), probe(splits.split)
kept_end, collapse = probe(collapses.kept_end), probe(collapses.collapse)
relax_vertex = probe(relaxations.relax_vertex)
triangle_energy, valence_energy = probe(energies.triangle_energy), probe(energies.valence_energy)


@pytest.mark.parametrize(
    ("name", "seed"), [("holed", 11), ("interfaces", 12), ("pinched", 13), ("strip", 14)]
)
def test_moves_leave_what_a_rebuilt_state_has(name: str, seed: int) -> None:
    """Committed moves keep every invariant and DELTA is the difference; undone moves leave no trace."""
    state = _state(name, seed)
    random = np.random.default_rng(seed)
    assert_is_state(state)
    done = 0
    for turn in range(N_MOVES):
        before, energy = _live(state), _energy(state)
        begin(state)
        n = sum(_move(state, random) for _ in range(random.integers(1, 4)))
        if random.random() < 0.5 or state.counter[OVERFLOW]:
            rollback(state)
            after = _live(state)
            assert before.keys() == after.keys()
            assert all(np.array_equal(before[key], after[key]) for key in before), turn
        else:
            delta = state.scalar[DELTA]
            commit(state)
            done += n
            assert _energy(state) - energy == pytest.approx(delta, rel=1e-9, abs=1e-7)
        if turn % 10 == 0:
            assert_is_state(state)
    assert_is_state(state)
    assert done > N_MOVES / 4


@pytest.mark.parametrize(("name", "seed"), [("holed", 21), ("interfaces", 22), ("pinched", 23)])
def test_annealing_leaves_what_a_rebuilt_state_has(name: str, seed: int) -> None:
    """The compiled driver too, hot enough that most things happen; fixed vertices stay where they are."""
    state = _state(name, seed)
    fixed = state.vertex[:, KIND] >= CORNER
    points = state.point[fixed].copy()
    state.scalar[TEMPERATURE] = 1.0
    assert anneal(state, 4000) > 400
    assert_is_state(state)
    assert np.array_equal(points, state.point[fixed])
    mesh = unload(state)
    assert mesh.topology.euler_characteristic == EULER[name]


def assert_is_state(state: State) -> None:
    """Mutual neighbours and curves, true valences, anchors, energies and free rows."""
    rows = state.triangle[: state.counter[N_TRIANGLES]]
    live = np.flatnonzero(rows[:, 0] >= 0)
    free = state.free_triangle[: state.counter[N_FREE_TRIANGLES]]
    assert sorted([*live, *free]) == list(range(len(rows)))
    beside, joined = {}, {}
    for t in live.tolist():
        for side in range(3):
            a, b = int(rows[t, (side + 1) % 3]), int(rows[t, (side + 2) % 3])
            assert (a, b) not in beside
            beside[a, b] = (t, side)
            joined.setdefault(a, set()).add(b)
            joined.setdefault(b, set()).add(a)
    for (a, b), (t, side) in beside.items():
        other, other_side = beside.get((b, a), (-1, -1))
        assert rows[t, 3 + side] == other
        code = rows[t, 6 + side]
        if other < 0:
            assert code >= 0
            assert code % 2 == 0
        else:
            assert rows[other, 6 + other_side] == (code ^ 1 if code >= 0 else -1)
    vertices = state.vertex[: state.counter[N_VERTICES]]
    free = state.free_vertex[: state.counter[N_FREE_VERTICES]]
    assert sorted([*joined, *free]) == list(range(len(vertices)))
    for v, others in joined.items():
        assert vertices[v, VALENCE] == len(others)
        assert v in rows[vertices[v, TRIANGLE], :3]
        assert state.value[v, ENERGY] == pytest.approx(valence_energy(state, v))
    assert [state.energy[t] for t in live] == pytest.approx(
        [triangle_energy(state, t) for t in live], rel=1e-9
    )


def _move(state: State, random: np.random.Generator) -> bool:
    live = np.flatnonzero(state.triangle[: state.counter[N_TRIANGLES], 0] >= 0)
    t, side = int(random.choice(live)), int(random.integers(3))
    match random.integers(4):
        case 0:
            if can_flip(state, t, side):
                flip(state, t, side)
                return True
        case 1:
            if can_split(state, t, side):
                return bool(split(state, t, side) >= 0)
        case 2:
            keep = kept_end(state, t, side)
            if keep >= 0:
                return bool(collapse(state, t, side, keep))
        case _:
            relax_vertex(state, int(state.triangle[t, side]))
            return True
    return False


def _live(state: State) -> dict[str, np.ndarray]:
    """Return copies of all rows in use."""
    is_vertex = state.vertex[: state.counter[N_VERTICES], TRIANGLE] >= 0
    is_triangle = state.triangle[: state.counter[N_TRIANGLES], 0] >= 0
    v, t = np.flatnonzero(is_vertex), np.flatnonzero(is_triangle)
    return {
        "v": v,
        "t": t,
        "point": state.point[v],
        "value": state.value[v],
        "vertex": state.vertex[v],
        "triangle": state.triangle[t],
        "energy": state.energy[t],
    }


def _energy(state: State) -> float:
    live = _live(state)
    return float(live["energy"].sum() + live["value"][:, ENERGY].sum())


def _domain(name: str) -> Domain:
    keep = np.ones((7, 6), bool)
    if name == "holed":
        keep[2:5, 2:4] = False
    if name == "pinched":
        keep[:4, 3:], keep[4:, :3] = False, False
    if name == "strip":
        keep[:, 1:] = False
    mesh = domains.grid_mesh(7, 6, keep)
    x, y = mesh.points.T
    interfaces = None
    if name == "interfaces":  # one across, one that ends inside, and a kept point
        interfaces = domains.edges_where(mesh, x == 3) | domains.edges_where(mesh, (y == 3) & (x <= 5))
    return domain_of(mesh, interfaces=interfaces, kept=np.array([9]))


EULER = {"holed": 0, "interfaces": 1, "pinched": 2}
"""Euler characteristic of what `_domain` makes, pinches split."""


def _state(name: str, seed: int) -> State:
    domain = _domain(name)
    log_size: Floats = np.log(0.12) + 0.5 * domain.points[:, 0]
    is_corner, turning = find_corners(domain, np.exp(log_size))
    state = load(domain, place(domain, is_corner, turning), log_size, room=3.0, seed=seed)
    give_credit(state, 0.5)
    assert (state.value[:, ARC] >= 0)[: len(domain.points)].all()
    return state
