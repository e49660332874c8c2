"""Boundaries as edges: which edge of the rim belongs to which boundary, for formats that want segments.

An edge of the rim (in one cell only) belongs to the last boundary that lists it. Boundaries without edges are
lists of points: there an edge belongs to the smallest that has both its ends, so one edge between two long
boundaries stays its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from ..arrays import Ints
from ..mesh.edges import edge_keys
from .boundary import Boundary

UNMARKED = "unmarked"
"""Name of the edges of the rim that are in no boundary."""


@dataclass(frozen=True, eq=False)
class EdgeGroup:
    """The edges of one boundary, with a name and a tag that no other group of the mesh has."""

    name: str
    """One word, never empty."""
    tag: int
    """Positive: the code of the boundary where that is free."""
    edges: Ints
    """End points of each edge, (n_edges, 2), the cell on the left."""


def edge_groups(
    triangles: Ints, quads: Ints, boundaries: Sequence[Boundary], n_points: int
) -> list[EdgeGroup]:
    """Return the rim of a mesh group by group, in the order of the boundaries, edges of none of them last.

    Boundaries that share a code and a name are one group; one that has no edge of the rim is left out.
    """
    edges = rim(triangles, quads, n_points)
    label = _labels(edges, boundaries, n_points)
    groups: dict[tuple[str, int | None], list[int]] = {}
    for k in np.unique(label[label >= 0]).tolist():
        groups.setdefault((_word(boundaries[k]), boundaries[k].code), []).append(k)
    if (label < 0).any():
        groups[UNMARKED, None] = [-1]
    found: list[EdgeGroup] = []
    names, tags = set[str](), set[int]()
    free = max([0, *(code for _, code in groups if code is not None)]) + 1
    for (word, code), members in groups.items():
        tag = free if code is None or code < 1 or code in tags else code
        free += tag == free
        name = _unused(word, names)
        names.add(name)
        tags.add(tag)
        found.append(EdgeGroup(name, tag, edges[np.isin(label, members)]))
    return found


def rim(triangles: Ints, quads: Ints, n_points: int) -> Ints:
    """Return the edges of one cell only, (n_edges, 2), the cell on the left.

    >>> rim(np.array([[0, 1, 2], [2, 1, 3]]), np.empty((0, 4), int), 4).tolist()
    [[0, 1], [2, 0], [1, 3], [3, 2]]
    """
    halves = [np.stack([c, np.roll(c, -1, axis=1)], axis=2).reshape(-1, 2) for c in (triangles, quads)]
    edges = np.concatenate(halves)
    _, first, count = np.unique(edge_keys(edges, n_points), return_index=True, return_counts=True)
    return edges[np.sort(first[count == 1])]


def _labels(edges: Ints, boundaries: Sequence[Boundary], n_points: int) -> Ints:
    """Return the smallest boundary that has both ends of each edge, (n_edges,); -1 where there is none."""
    nodes = [
        np.empty(0, dtype=np.int64) if b.edges is not None
        else b.nodes if b.partners is None
        else np.concatenate([b.nodes, b.partners])
        for b in boundaries
    ]  # fmt: skip
    sets = [np.unique(part) for part in nodes]
    sizes = np.array([len(part) for part in sets], dtype=np.int64)
    column = np.repeat(np.arange(len(sets)), sizes)
    row = np.concatenate([np.empty(0, dtype=np.int64), *sets])
    has = csr_array((np.ones(len(row)), (row, column)), shape=(n_points, max(len(sets), 1)))
    common = has[edges[:, 0]].multiply(has[edges[:, 1]]).tocoo()
    order = np.lexsort([sizes[common.col], common.row]) if len(sets) else np.empty(0, dtype=np.int64)
    edge, first = np.unique(common.row[order], return_index=True)
    label = np.full(len(edges), -1, dtype=np.int64)
    label[edge] = common.col[order][first]
    keys = edge_keys(edges, n_points)
    for k, boundary in enumerate(boundaries):
        if boundary.edges is not None:
            label[np.isin(keys, edge_keys(boundary.edges, n_points))] = k
    return label


def _word(boundary: Boundary) -> str:
    """Return the name of a boundary as one word; without one its kind and code."""
    kind = boundary.kind if boundary.code is None else f"{boundary.kind}_{boundary.code}"
    return "_".join(boundary.name.split()) or kind


def _unused(word: str, names: set[str]) -> str:
    number, found = 2, word
    while found in names:
        found, number = f"{word}_{number}", number + 1
    return found
