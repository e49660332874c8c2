"""Basins: the same partition as a slow flood, whatever the numbering, with what persistence promises."""

from __future__ import annotations

import numpy as np
import pytest
import reference
from hypothesis import given
from hypothesis import strategies as st
from strategies import hilly

from bsgplan.arrays import Floats, Ints
from bsgplan.mesh import Mesh
from bsgplan.regions.watershed import basins

Graph = tuple[Ints, Floats, Floats]


@st.composite
def graphs(draw: st.DrawFn) -> Graph:
    """Random graphs, connected or not, with distinct values on the nodes; edges, lengths, values."""
    n = draw(st.integers(1, 40))
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    pairs = random.integers(0, n, (draw(st.integers(0, 3)) * n, 2))
    edges = np.unique(np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1), axis=0).reshape(-1, 2)
    values = random.permutation(np.arange(n) / n + random.uniform(0, 0.5 / n, n))
    return edges.astype(np.int64), random.uniform(0.5, 2, len(edges)), values


def links(edges: Ints, lengths: Floats) -> list[tuple[int, int, float]]:
    return [(a, b, d) for (a, b), d in zip(edges.tolist(), lengths.tolist(), strict=True)]


PERSISTENCE = st.sampled_from([0.0, 0.05, 0.2, 0.5, 2.0])


@given(graphs(), PERSISTENCE)
def test_basins_are_those_of_a_slow_flood(graph: Graph, persistence: float) -> None:
    edges, lengths, values = graph
    slow = reference.basins(links(edges, lengths), values.tolist(), persistence)
    assert basins(edges, lengths, values, persistence).tolist() == slow


@given(hilly(12), PERSISTENCE)
def test_basins_of_a_mesh_are_those_of_a_slow_flood(case: tuple[Mesh, Floats], persistence: float) -> None:
    mesh, log_h = case
    edges, lengths = mesh.topology.edges, mesh.edge_lengths
    for values in (log_h, -log_h):
        slow = reference.basins(links(edges, lengths), values.tolist(), persistence)
        assert basins(edges, lengths, values, persistence).tolist() == slow


@given(graphs(), PERSISTENCE, st.integers(0, 2**32 - 1))
def test_basins_do_not_depend_on_the_numbering(graph: Graph, persistence: float, seed: int) -> None:
    edges, lengths, values = graph
    random = np.random.default_rng(seed)
    old, order = random.permutation(len(values)), random.permutation(len(edges))
    new = np.argsort(old)
    moved = basins(new[edges][order][:, ::-1], lengths[order], values[old], persistence)
    assert old[moved].tolist() == basins(edges, lengths, values, persistence)[old].tolist()


@given(graphs(), PERSISTENCE)
def test_a_basin_is_connected_and_named_by_its_lowest_node(graph: Graph, persistence: float) -> None:
    edges, lengths, values = graph
    label = basins(edges, lengths, values, persistence)
    for name in np.unique(label):
        own = np.flatnonzero(label == name)
        assert values[own].min() == values[name]
        inner = [(a, b) for a, b in edges.tolist() if label[a] == label[b] == name]
        assert len(reference.components(set(own.tolist()), inner)) == 1


@given(graphs())
def test_boundless_persistence_leaves_one_basin_a_component(graph: Graph) -> None:
    edges, lengths, values = graph
    n_components = len(reference.components(set(range(len(values))), [(a, b) for a, b in edges.tolist()]))
    assert len(np.unique(basins(edges, lengths, values, np.inf))) == n_components


@given(graphs())
def test_more_persistence_never_makes_more_basins(graph: Graph) -> None:
    edges, lengths, values = graph
    counts = [len(np.unique(basins(edges, lengths, values, p))) for p in (0.0, 0.05, 0.2, 0.5, 2.0)]
    assert counts == sorted(counts, reverse=True)


@pytest.mark.parametrize(("persistence", "expected"), [(0.1, [0, 0, 2, 2, 2]), (0.31, [0, 0, 0, 0, 0])])
def test_a_pit_joins_its_neighbour_when_shallower_than_the_persistence(
    persistence: float, expected: list[int]
) -> None:
    path = np.array([[0, 1], [1, 2], [2, 3], [3, 4]])
    found = basins(path, np.ones(4), np.array([0.0, 0.8, 0.5, 0.9, 1.0]), persistence)
    assert found.tolist() == expected


def test_a_constant_field_is_one_basin_once_anything_is_noise() -> None:
    path = np.array([[0, 1], [1, 2], [2, 3]])
    assert len(set(basins(path, np.ones(3), np.ones(4), 1e-9).tolist())) == 1


def test_of_two_saddles_at_one_node_the_one_over_the_lower_end_is_crossed_first_whatever_the_numbering() -> (
    None
):
    """Node 3, in the shallow basin of 2, looks down into two deep basins at once: it joins the lower side."""
    edges = np.array([[2, 3], [0, 3], [1, 3]])
    values = np.array([0.0, 0.1, 0.95, 1.0])
    for order in ([0, 1, 2, 3], [1, 0, 2, 3], [3, 2, 1, 0], [2, 3, 0, 1]):
        old = np.array(order)
        new = np.argsort(old)
        steep = np.array([0.01, 3.0, 3.0])
        label = old[basins(new[edges], steep, values[old], 0.2)][new]
        assert label.tolist() == [0, 1, 0, 0]
