"""Patches: put back they change nothing; mended, the worst triangle is better and the rim as it was."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import jittered, meshes

from bsgplan.blocks.kinds import FROZEN, FROZEN_SIDE
from bsgplan.blocks.smooth import qualities
from bsgplan.mesh import Mesh
from bsgplan.remesh.cut import cut
from bsgplan.remesh.graft import graft
from bsgplan.remesh.mend import mended, patch_of, spliced


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
    back = spliced(start, patch, patch.mesh)
    assert geometry(back.points, back.triangles) == geometry(start.points, start.triangles)
    fixed = start.kinds == FROZEN
    assert np.array_equal(back.points[back.kinds == FROZEN][: fixed.sum()], start.points[fixed])
    assert np.count_nonzero(back.codes == FROZEN_SIDE) == np.count_nonzero(start.codes == FROZEN_SIDE)


def test_the_worst_triangle_of_a_jittered_square_is_mended() -> None:
    mesh = jittered(14, 14, 3)
    part = cut(mesh, np.ones(mesh.n_triangles, bool))
    log_size = np.zeros(part.domain.n_points) - np.log(part.domain.scale)
    least = float(np.quantile(mesh.qualities, 0.05))
    made = mended(part.domain, part.start, log_size, least, seed=3, offset=0.0)
    assert qualities(made).min() > mesh.qualities.min()
    whole = graft(mesh, [(part, made)])
    kept = whole.new_index >= 0
    assert kept[mesh.topology.is_boundary].all()
    assert np.array_equal(whole.mesh.points[whole.new_index[kept]], mesh.points[kept])
