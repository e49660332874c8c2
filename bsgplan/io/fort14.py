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
from .file import RawMesh
from .fort14_boundaries import read_boundaries
from .number_table import number_table, shown
from .point_numbers import NodeNumbers, whole

NODE_COLUMNS = ("id", "x", "y", "depth")
ELEMENT_COLUMNS = ("id", "number of nodes", "node 1", "node 2", "node 3", "node 4")


def read_fort14(path: Path) -> RawMesh:
    """Return the nodes, elements, depth and boundary lists of an ADCIRC or SCHISM mesh."""
    content = path.read_bytes()
    if b"\0" in content:
        raise MeshReadError("binary data, not a fort.14 text; give the text mesh")
    lines = content.split(b"\n")
    while lines and not lines[-1].strip():
        lines.pop()
    n_elements, n_nodes = _header(lines)
    first_element = 2 + n_nodes
    first_boundary = first_element + n_elements
    numbers, points, depth = _nodes(lines[2:first_element], n_nodes)
    triangles, quads = _elements(lines[first_element:first_boundary], first_element + 1, numbers, n_nodes)
    boundaries = read_boundaries(lines[first_boundary:], first_boundary + 1, numbers.index)
    return RawMesh(
        points=points,
        triangles=triangles,
        quads=quads,
        point_data={"depth": depth},
        boundaries=boundaries,
        ignored={"quad": len(quads)} if len(quads) else {},
        title=lines[0].decode("utf-8", "replace").strip(),
        is_counting=numbers.is_counting,
    )


def _header(lines: Sequence[bytes]) -> tuple[int, int]:
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
    if n_elements + n_nodes > len(lines) - 2:
        raise MeshReadError(
            f"line 2: {n_elements} elements and {n_nodes} nodes need as many lines, "
            f"only {len(lines) - 2} follow; repair the counts or fetch the whole file"
        )
    return n_elements, n_nodes


def _nodes(lines: Sequence[bytes], n_nodes: int) -> tuple[NodeNumbers, Floats, Floats]:
    line_numbers = range(3, 3 + n_nodes)
    table = number_table(lines, line_numbers, NODE_COLUMNS, "a node")
    ids = whole(table[:, 0], np.asarray(line_numbers), "node id")
    numbers = NodeNumbers(ids)
    if (repeated := numbers.repeated()) is not None:
        again, before = repeated
        raise MeshReadError(
            f"line {3 + again}: node id {ids[again]} stands on line {3 + before} already; "
            f"repair it, or the count of {n_nodes} nodes on line 2"
        )
    return numbers, np.ascontiguousarray(table[:, 1:3]), table[:, 3].copy()


def _elements(lines: Sequence[bytes], first: int, numbers: NodeNumbers, n_nodes: int) -> tuple[Ints, Ints]:
    line_numbers = np.arange(first, first + len(lines))
    table = number_table(lines, line_numbers.tolist(), ELEMENT_COLUMNS[:5], "an element")
    n_corners = table[:, 1]
    is_bad = (n_corners != 3) & (n_corners != 4)
    if is_bad.any():
        where = int(np.flatnonzero(is_bad)[0])
        raise MeshReadError(
            f"line {line_numbers[where]}: an element has 3 or 4 nodes, got {shown(lines[where])}; "
            f"repair it, or the count of {n_nodes} nodes on line 2"
        )
    triangles = _corners(table[n_corners == 3, 2:], line_numbers[n_corners == 3], numbers)
    is_quad = n_corners == 4
    if not is_quad.any():
        return triangles, np.empty((0, 4), dtype=np.int64)
    quad_numbers = line_numbers[is_quad]
    quad_lines = [lines[where] for where in np.flatnonzero(is_quad).tolist()]
    quad_table = number_table(quad_lines, quad_numbers.tolist(), ELEMENT_COLUMNS, "an element of 4 nodes")
    return triangles, _corners(quad_table[:, 2:], quad_numbers, numbers)


def _corners(named: Floats, line_numbers: Ints, numbers: NodeNumbers) -> Ints:
    ids = np.column_stack([whole(column, line_numbers, "node") for column in named.T])
    index = numbers.index(ids)
    if (index < 0).any():
        row, column = np.argwhere(index < 0)[0]
        raise MeshReadError(
            f"line {line_numbers[row]}: the element names node {ids[row, column]}, "
            f"which no node line defines (ids {numbers.ids.min()} .. {numbers.ids.max()}); "
            "repair the element or the node block"
        )
    return index
