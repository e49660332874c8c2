"""Cuts: what stays is frozen, and a frozen vertex wants what makes it regular in the whole mesh."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from strategies import jittered, meshes

from bsgplan.blocks.kinds import FROZEN, FROZEN_SIDE
from bsgplan.mesh import Mesh
from bsgplan.remesh.cut import cut, fitting_valence

HEXAGON = Mesh(
    np.vstack([[0, 0], [[np.cos(a), np.sin(a)] for a in np.arange(6) * np.pi / 3]]),
    np.array([[0, k + 1, (k + 1) % 6 + 1] for k in range(6)]),
)


def test_fitting_valence_of_a_regular_hexagon_is_its_valence() -> None:
    wanted = [6, 3, 3, 3, 3, 3, 3]  # corners of 120 degrees carry two triangles: three edges
    assert fitting_valence(HEXAGON).tolist() == HEXAGON.topology.valence.tolist() == wanted


def test_the_goal_of_a_frozen_vertex_counts_what_lies_outside() -> None:
    """Two of six triangles: the centre has three edges inside and three outside, so three are wanted."""
    part = cut(HEXAGON, np.array([True, True, False, False, False, False]))
    centre = int(np.flatnonzero(part.point == 0)[0])
    assert part.start.goals[centre] == 3 == part.start.topology.valence[centre]
    assert part.is_frozen.all()
    assert (part.start.codes[part.start.neighbours < 0] == FROZEN_SIDE).all()
    assert (part.start.codes[part.start.neighbours >= 0] == -1).all()


@given(mesh=meshes(), seed=st.integers(0, 2**32 - 1))
def test_frozen_is_what_touches_the_rim_and_goals_tell_the_whole_valence(mesh: Mesh, seed: int) -> None:
    inside = np.random.default_rng(seed).random(mesh.n_triangles) < 0.7
    inside[0] = True
    part = cut(mesh, inside)
    outer = np.zeros(mesh.n_points, bool)
    outer[mesh.triangles[~inside]] = True
    outer |= mesh.topology.is_boundary
    assert (part.is_frozen == outer[part.point]).all()
    np.testing.assert_allclose(part.domain.to_mesh(part.domain.points), mesh.points[part.point], atol=1e-9)
    off = part.start.topology.valence - part.start.goals
    assert (off == (mesh.topology.valence - fitting_valence(mesh))[part.point]).all()


def test_fixed_edges_and_points_are_frozen() -> None:
    mesh = jittered(7, 7, 3)
    middle = np.abs(mesh.points[:, 0] - 3) < 0.5
    fixed = middle[mesh.topology.edges].all(axis=1)
    point = int(np.argmin(np.linalg.norm(mesh.points - [1.5, 3], axis=1)))
    part = cut(mesh, np.ones(mesh.n_triangles, bool), fixed_edges=fixed, fixed_points=np.array([point]))
    assert part.start.kinds[part.point == point].tolist() == [FROZEN]
    assert (part.start.kinds[np.isin(part.point, mesh.topology.edges[fixed])] == FROZEN).all()
    n_frozen = np.count_nonzero(part.start.codes == FROZEN_SIDE)
    inner = fixed & ~mesh.topology.is_boundary_edge
    assert n_frozen == np.count_nonzero(mesh.topology.is_boundary_edge) + 2 * np.count_nonzero(inner)
