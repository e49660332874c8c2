"""Reader of the ADCIRC and SCHISM text mesh: fort.14, .14, .grd, .gr3, .ll.

Grammar, one record a line, free format, anything after the wanted values is a comment:

    title
    n_elements n_nodes
    id x y depth                          n_nodes times; ids distinct, in any order
    id 3 node node node                   n_elements times; SCHISM also has  id 4 node node node node
    n_open                                from here on optional
    n_open_nodes
      n_nodes [code]                      for each open segment, then its nodes, one a line
    n_land
    n_land_nodes
      n_nodes code                        for each land segment (code is IBTYPE), then its nodes:
      node                                  0, 1, 2, 10 .. 12, 20 .. 22, ...: shores and islands
      node height coefficient               3, 13, 23: weirs in the outer boundary
      node partner height sub super         4, 14, 24, 64: barriers with a node on each side
      node partner height sub super height coefficient diameter     5, 25: with pipes

Coincident nodes are meant (walls, weirs) and stay apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .chunks import Lines, n_lines_of
from .file import RawMesh
from .fort14_boundaries import read_boundaries
from .number_table import shown
from .point_numbers import NodeNumbers, whole

NODE_COLUMNS = ("id", "x", "y", "depth")
ELEMENT_COLUMNS = ("id", "number of nodes", "node 1", "node 2", "node 3", "node 4")


def read_fort14(path: Path) -> RawMesh:
    """Return the nodes, elements, depth and boundary lists of an ADCIRC or SCHISM mesh."""
    lines, n_lines = Lines(path), n_lines_of(path)
    head = [line for chunk in lines.take(2) for line in chunk.lines]
    n_elements, n_nodes = _header(head, n_lines)
    numbers, points, depth = _nodes(lines, n_nodes)
    triangles, quads = _elements(lines, n_elements, numbers)
    first = 3 + n_nodes + n_elements
    rest = [line for chunk in lines.take(n_lines + 1 - first) for line in chunk.lines]
    return RawMesh(
        points=points,
        triangles=triangles,
        quads=quads,
        point_data={"depth": depth},
        boundaries=read_boundaries(rest, first, numbers.index),
        ignored={"quad": len(quads)} if len(quads) else {},
        title=head[0].decode("utf-8", "replace").strip(),
        is_counting=numbers.is_counting,
    )


def _header(lines: Sequence[bytes], n_lines: int) -> tuple[int, int]:
    if len(lines) < 2:
        raise MeshReadError("line 1 is the last; a fort.14 has the title there and both counts on line 2")
    words = lines[1].split()[:2]
    try:
        n_elements, n_nodes = (int(word) for word in words)
    except ValueError:
        raise MeshReadError(
            f"line 2: needs the numbers of elements and nodes, got {shown(lines[1])}; repair it"
        ) from None
    if n_elements < 1 or n_nodes < 3:
        raise MeshReadError(
            f"line 2: {n_elements} elements and {n_nodes} nodes are no mesh; repair the counts"
        )
    if n_elements + n_nodes > n_lines - 2:
        raise MeshReadError(
            f"line 2: {n_elements} elements and {n_nodes} nodes need as many lines, "
            f"only {n_lines - 2} follow; repair the counts or fetch the whole file"
        )
    return n_elements, n_nodes


def _nodes(lines: Lines, n_nodes: int) -> tuple[NodeNumbers, Floats, Floats]:
    ids = np.empty(n_nodes, dtype=np.int64)
    points, depth = np.empty((n_nodes, 2)), np.empty(n_nodes)
    first = 0
    for chunk in lines.take(n_nodes):
        table = chunk.table(NODE_COLUMNS, "a node")
        rows = slice(first, first := first + chunk.n_lines)
        ids[rows] = whole(table[:, 0], chunk.line_numbers, "node id")
        points[rows], depth[rows] = table[:, 1:3], table[:, 3]
    numbers = NodeNumbers(ids)
    if (repeated := numbers.repeated()) is not None:
        again, before = repeated
        raise MeshReadError(
            f"line {3 + again}: node id {ids[again]} stands on line {3 + before} already; "
            f"repair it, or the count of {n_nodes} nodes on line 2"
        )
    return numbers, points, depth


def _elements(lines: Lines, n_elements: int, numbers: NodeNumbers) -> tuple[Ints, Ints]:
    triangles, n_triangles = np.empty((n_elements, 3), dtype=np.int64), 0
    quads = [np.empty((0, 4), dtype=np.int64)]
    for chunk in lines.take(n_elements):
        table = chunk.table(ELEMENT_COLUMNS[:5], "an element")
        n_corners = table[:, 1]
        is_triangle, is_quad = n_corners == 3, n_corners == 4
        if not (is_triangle | is_quad).all():
            where = int(np.flatnonzero(~(is_triangle | is_quad))[0])
            raise MeshReadError(
                f"line {chunk.line_numbers[where]}: an element has 3 or 4 nodes, got "
                f"{shown(chunk.lines[where])}; repair it, or the count of {len(numbers.ids)} nodes on line 2"
            )
        rows = slice(n_triangles, n_triangles := n_triangles + int(np.count_nonzero(is_triangle)))
        triangles[rows] = _corners(table[is_triangle, 2:], chunk.line_numbers[is_triangle], numbers)
        if is_quad.any():
            of_quads = chunk.select(is_quad)
            named = of_quads.table(ELEMENT_COLUMNS, "an element of 4 nodes")[:, 2:]
            quads.append(_corners(named, of_quads.line_numbers, numbers))
    return triangles[:n_triangles].copy() if n_triangles < n_elements else triangles, np.concatenate(quads)


def _corners(named: Floats | Ints, line_numbers: Ints, numbers: NodeNumbers) -> Ints:
    ids = whole(named, line_numbers, "node")
    index = numbers.index(ids)
    if (index < 0).any():
        row, column = np.argwhere(index < 0)[0]
        raise MeshReadError(
            f"line {line_numbers[row]}: the element names node {ids[row, column]}, "
            f"which no node line defines (ids {numbers.ids.min()} .. {numbers.ids.max()}); "
            "repair the element or the node block"
        )
    return index
