"""The noun Boundary: a list of points that a file calls an open, a land or a named boundary."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from itertools import count
from typing import Literal

import numpy as np

from ..arrays import Floats, Ints, frozen_floats, frozen_ints

MAX_TAG = 2**31 - 1
"""Largest tag that a file of 32-bit tags holds."""

Kind = Literal["open", "land", "named"]


@dataclass(frozen=True, eq=False)
class Boundary:
    """Points of one boundary segment, with what the file says at each of them."""

    kind: Kind
    """"open" and "land" as ADCIRC and SCHISM mean them; "named" for a physical group or marker."""
    nodes: Ints
    """Indices into the points of the mesh, (n_nodes,), in the order of the file."""
    code: int | None = None
    """IBTYPE of an ADCIRC segment, tag of a named one; None where the file gives none."""
    name: str = ""
    """Name of a physical group or marker."""
    partners: Ints | None = None
    """The point across the barrier at each node, (n_nodes,); None unless the segment is a pair of sides."""
    columns: Floats | None = None
    """Further numbers at each node (crest height, coefficients), (n_nodes, k); None where there are none."""
    edges: Ints | None = None
    """Both points of each edge, (n_edges, 2); None where the nodes are in order along the boundary."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "nodes", frozen_ints(self.nodes))
        if self.partners is not None:
            object.__setattr__(self, "partners", frozen_ints(self.partners))
        if self.columns is not None:
            object.__setattr__(self, "columns", frozen_floats(self.columns))
        if self.edges is not None:
            object.__setattr__(self, "edges", frozen_ints(self.edges))

    @property
    def n_nodes(self) -> int:
        """Number of points in the segment (pairs of points at a barrier)."""
        return len(self.nodes)

    @property
    def segments(self) -> Ints:
        """Both points of each edge, (n_edges, 2): as given, else from node to node."""
        if self.edges is not None:
            return self.edges
        return np.column_stack([self.nodes[:-1], self.nodes[1:]])

    def renumbered(self, new_index: Ints) -> Boundary:
        """Return the segment with nodes new_index[node], without those where that is negative."""
        nodes = new_index[self.nodes]
        is_kept = nodes >= 0
        partners, columns, edges = self.partners, self.columns, self.edges
        if partners is not None:
            is_kept = is_kept & (new_index[partners] >= 0)
            partners = new_index[partners][is_kept]
        if columns is not None:
            columns = columns[is_kept]
        if edges is not None:
            edges = new_index[edges][(new_index[edges] >= 0).all(axis=1)]
        return replace(self, nodes=nodes[is_kept], partners=partners, columns=columns, edges=edges)


def n_nodes(boundaries: tuple[Boundary, ...]) -> int:
    """Return the number of nodes of all segments, shared ones counted in each.

    >>> n_nodes((Boundary("open", np.array([0, 1])), Boundary("land", np.array([1, 2, 0]))))
    5
    """
    return int(np.sum([boundary.n_nodes for boundary in boundaries], dtype=np.int64))


def labels(boundaries: tuple[Boundary, ...]) -> tuple[tuple[int, str], ...]:
    """Return a tag and a name for each boundary, for files that know all of them by both.

    Tags are positive and distinct: the code of a named boundary where it is free, else the next number.
    Names are distinct, on one line, without double quotes; one without a name is called by kind and number.

    >>> labels((Boundary("open", np.array([0, 1])), Boundary("named", np.array([1, 2]), 7, "wall")))
    ((1, 'open 1'), (7, 'wall'))
    """
    tags: list[int] = []
    taken = {0}
    for boundary in boundaries:
        code = boundary.code if boundary.kind == "named" else None
        is_free = code is not None and 0 < code <= MAX_TAG and code not in taken
        tags.append(code if is_free and code is not None else 0)
        taken.add(tags[-1])
    free = (tag for tag in count(1) if tag not in taken)
    tags = [tag or next(free) for tag in tags]
    names: list[str] = []
    seen: set[str] = set()
    numbers: Counter[str] = Counter()
    for boundary, tag in zip(boundaries, tags, strict=True):
        numbers[boundary.kind] += 1
        name = " ".join(boundary.name.replace('"', "'").split())
        name = name or f"{boundary.kind} {numbers[boundary.kind]}"
        name = name if name not in seen else f"{name} {tag}"
        names.append(name)
        seen.add(name)
    return tuple(zip(tags, names, strict=True))


def paths(boundary: Boundary) -> list[Ints]:
    """Return the nodes of a boundary in order along it, a closed path with its first node again at its end.

    One path where the nodes are in order already; else as few as cover every edge once, from fork to fork.
    """
    if boundary.edges is None:
        return [boundary.nodes] if boundary.n_nodes else []
    neighbours: dict[int, list[tuple[int, int]]] = {}
    for k, (a, b) in enumerate(boundary.edges.tolist()):
        neighbours.setdefault(a, []).append((b, k))
        neighbours.setdefault(b, []).append((a, k))
    ends = [node for node, around in neighbours.items() if len(around) != 2]
    is_used = [False] * len(boundary.edges)
    result = []
    for start in [*(end for end in ends for _ in neighbours[end]), *neighbours]:
        path, node = [start], start
        while (onward := next((n for n in neighbours[node] if not is_used[n[1]]), None)) is not None:
            node = onward[0]
            is_used[onward[1]] = True
            path.append(node)
            if len(neighbours[node]) != 2:
                break
        if len(path) > 1:
            result.append(np.array(path, dtype=np.int64))
    return result
