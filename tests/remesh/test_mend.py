"""Patches: put back they change nothing; mended, the worst triangle is better and the rim as it was."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import jittered, meshes

from bsgplan.blocks.kinds import FROZEN, FROZEN_SIDE
from bsgplan.blocks.lack import qualities
from bsgplan.blocks.placed import grown
from bsgplan.mesh import Mesh
from bsgplan.mesh.quality import signed_areas
from bsgplan.remesh.anneal import remeshed
from bsgplan.remesh.cut import cut
from bsgplan.remesh.graft import graft
from bsgplan.remesh.mend import around, holders, mended, patch_of, spliced
from bsgplan.remesh.restore import put_back, restored
from bsgplan.remesh.wish import Wish


def geometry(points: np.ndarray, triangles: np.ndarray) -> set[tuple[bytes, ...]]:
    return {tuple(sorted(points[corner].tobytes() for corner in t)) for t in triangles}


@given(mesh=meshes(), seed=st.integers(0, 2**32 - 1), share=st.sampled_from([0.2, 0.6, 1.0]))
@settings(max_examples=40)
def test_a_patch_put_back_as_it_was_changes_nothing(mesh: Mesh, seed: int, share: float) -> None:
    start = cut(mesh, np.ones(mesh.n_triangles, bool)).start
    inside = np.random.default_rng(seed).random(mesh.n_triangles) < share
    inside[0] = True
    patch = patch_of(start, inside)
    assert np.array_equal(patch.mesh.points, start.points[patch.source])
    off = patch.mesh.topology.valence - patch.mesh.goals
    assert np.array_equal(off, (start.topology.valence - start.goals)[patch.source])
    back = spliced(start, [(patch, patch.mesh)])
    assert geometry(back.points, back.triangles) == geometry(start.points, start.triangles)
    fixed = start.kinds == FROZEN
    assert np.array_equal(back.points[back.kinds == FROZEN][: fixed.sum()], start.points[fixed])
    assert np.count_nonzero(back.codes == FROZEN_SIDE) == np.count_nonzero(start.codes == FROZEN_SIDE)


def test_the_worst_triangle_of_a_jittered_square_is_mended() -> None:
    mesh = jittered(14, 14, 3)
    part = cut(mesh, np.ones(mesh.n_triangles, bool))
    log_size = np.zeros(part.domain.n_points) - np.log(part.domain.scale)
    least = np.full(mesh.n_triangles, np.quantile(mesh.qualities, 0.05))
    made = mended(part.domain, part.start, log_size, least, seed=3, offset=0.0)
    assert qualities(made).min() > mesh.qualities.min()
    whole = graft(mesh, [(part, made)])
    kept = whole.new_index >= 0
    assert kept[mesh.topology.is_boundary].all()
    assert np.array_equal(whole.mesh.points[whole.new_index[kept]], mesh.points[kept])


@given(seed=st.integers(0, 2**32 - 1), n_rings=st.integers(1, 3))
@settings(max_examples=30)
def test_old_triangles_put_back_keep_the_rim_and_are_there(seed: int, n_rings: int) -> None:
    """Into another triangulation of the same rim: a conforming patch that holds them as they were."""
    mesh = jittered(12, 12, seed % 1000)
    part = cut(mesh, np.ones(mesh.n_triangles, bool))
    log_size = np.zeros(part.domain.n_points) - np.log(part.domain.scale)
    n = mesh.n_triangles
    wish = Wish(n, 0.1, np.zeros(n, np.int64), np.zeros(n), np.zeros(n))
    other = remeshed(part, log_size, wish, n_sweeps=3, seed=seed % 1000).mesh
    centre = np.random.default_rng(seed).uniform(-0.5, 0.5, 2)
    old = around(part.start, centre, n_rings)
    patch = patch_of(other, grown(part.start, old, 2)[holders(part.domain, other)])
    begun = put_back(part.start, other, patch, old)
    if begun is None:
        return
    assert (qualities(begun) > 0).all()
    whole = spliced(other, [(patch, begun)])
    assert geometry(part.start.points, part.start.triangles[old]) <= geometry(whole.points, whole.triangles)
    assert signed_areas(whole.points, whole.triangles).sum() == pytest.approx(
        signed_areas(other.points, other.triangles).sum(), rel=1e-9
    )


def test_a_worst_triangle_that_was_made_is_undone_by_putting_the_old_ones_back() -> None:
    mesh = jittered(14, 14, 3, jitter=0.1)
    part = cut(mesh, np.ones(mesh.n_triangles, bool))
    log_size = np.zeros(part.domain.n_points) - np.log(part.domain.scale)
    start = part.start
    free = int(np.flatnonzero(start.kinds != FROZEN)[50])
    moved = start.points.copy()
    ring = np.unique(start.triangles[(start.triangles == free).any(axis=1)])
    moved[free] += 0.8 * (moved[ring[ring != free][0]] - moved[free])
    poor = replace(start, points=moved)
    least = np.full(mesh.n_triangles, mesh.qualities.min())
    assert qualities(poor).min() < least[0]
    made = restored(part.domain, start, poor, log_size, least, seed=3, offset=0.0)
    assert qualities(made).min() >= least[0]
