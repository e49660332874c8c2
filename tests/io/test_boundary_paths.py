"""Boundaries: labels are unique, paths cover every edge once."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from strategies import meshes as random_meshes

from bsgplan.io import Boundary
from bsgplan.io.boundary import labels, paths


def named(*edges: tuple[int, int]) -> Boundary:
    ends = np.array(edges, dtype=np.int64).reshape(-1, 2)
    return Boundary("named", np.unique(ends), edges=ends)


def test_paths_by_hand():
    assert [p.tolist() for p in paths(named((3, 1), (5, 3), (1, 4)))] == [[5, 3, 1, 4]]
    assert [p.tolist() for p in paths(named((1, 2), (2, 3), (3, 1)))] == [[1, 2, 3, 1]]
    assert [p.tolist() for p in paths(Boundary("open", [4, 2, 9]))] == [[4, 2, 9]]
    assert sorted(len(p) for p in paths(named((0, 1), (0, 2), (3, 0), (3, 4)))) == [2, 2, 3]


@given(mesh=random_meshes(), seed=st.integers(0, 2**32 - 1))
def test_paths_cover_every_edge_once_and_nothing_else(mesh, seed):
    edges = mesh.topology.edges
    random = np.random.default_rng(seed)
    chosen = edges[random.random(len(edges)) < random.random()].tolist()
    along = [path.tolist() for path in paths(named(*chosen))]
    found = [tuple(sorted(pair)) for path in along for pair in pairwise(path)]
    assert Counter(found) == Counter(map(tuple, chosen))


boundaries = st.builds(
    lambda kind, code, name: Boundary(kind, [0, 1], code, name),
    st.sampled_from(["open", "land", "named"]),
    st.one_of(st.none(), st.integers(-2, 4)),
    st.sampled_from(["", "wall", "open 1", 'a "b"', "wall 1"]),
)


@given(found=st.lists(boundaries, max_size=8))
def test_labels_are_positive_distinct_and_of_one_line(found):
    told = labels(tuple(found))
    tags, names = [tag for tag, _ in told], [name for _, name in told]
    assert len(set(tags)) == len(set(names)) == len(found)
    assert min(tags, default=1) > 0
    assert not any('"' in name or "\n" in name or not name for name in names)
    for boundary, tag in zip(found, tags, strict=True):
        codes = [b.code for b in found if b.kind == "named"]
        if boundary.kind == "named" and (boundary.code or 0) > 0 and codes.count(boundary.code) == 1:
            assert tag == boundary.code
