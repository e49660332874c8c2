"""Slow, obvious twins of the fast functions, for comparison only."""

from __future__ import annotations

from collections import defaultdict

Cells = list[list[int]]


def edges(cells: Cells) -> dict[tuple[int, int], list[int]]:
    """Return the cells of each edge."""
    result: dict[tuple[int, int], list[int]] = defaultdict(list)
    for i, cell in enumerate(cells):
        for a, b in zip(cell, cell[1:] + cell[:1], strict=True):
            result[min(a, b), max(a, b)].append(i)
    return dict(result)


def components(nodes: set[int], links: list[tuple[int, int]]) -> list[set[int]]:
    """Return the connected sets of nodes, by flooding."""
    near: dict[int, set[int]] = defaultdict(set)
    for a, b in links:
        near[a].add(b)
        near[b].add(a)
    result, seen = [], set()
    for start in sorted(nodes):
        if start in seen:
            continue
        piece, front = {start}, [start]
        while front:
            for other in near[front.pop()] - piece:
                piece.add(other)
                front.append(other)
        seen |= piece
        result.append(piece)
    return result


def n_fans(cells: Cells, vertex: int) -> int:
    """Return the number of edge-connected fans of cells around a vertex."""
    around = {i for i, cell in enumerate(cells) if vertex in cell}
    links = [(c[0], c[1]) for e, c in edges(cells).items() if vertex in e and len(c) == 2]
    return len(components(around, links))


def n_pinches(cells: Cells) -> int:
    """Return the sum over vertices of fans - 1."""
    return sum(n_fans(cells, vertex) - 1 for vertex in {v for cell in cells for v in cell})


def n_boundary_loops(cells: Cells) -> int:
    """Return the number of closed boundary curves, walked with the domain on one hand.

    At a pinch a walk turns round the cells of the fan it arrives in, so loops never cross one.
    """
    cells_of = edges(cells)
    boundary = {e for e, c in cells_of.items() if len(c) == 1}
    links, names = [], {e: i for i, e in enumerate(sorted(boundary))}
    for e in boundary:
        for vertex in e:
            cell, edge = cells_of[e][0], e
            while True:  # turn about the vertex until the fan ends
                corners = cells[cell]
                at = [
                    (min(a, b), max(a, b))
                    for a, b in zip(corners, corners[1:] + corners[:1], strict=True)
                    if vertex in (a, b)
                ]
                edge = at[1] if at[0] == edge else at[0]
                if edge in boundary:
                    break
                cell = next(c for c in cells_of[edge] if c != cell)
            links.append((names[e], names[edge]))
    return len(components(set(names.values()), links))


def valence_irregularity(cells: Cells, n_points: int) -> list[int]:
    """Return valence - 6 inside and valence - 4 on the boundary, for triangles."""
    cells_of = edges(cells)
    result = []
    for vertex in range(n_points):
        mine = [e for e in cells_of if vertex in e]
        is_boundary = any(len(cells_of[e]) == 1 for e in mine)
        result.append(len(mine) - (4 if is_boundary else 6))
    return result


def read_fort14(text: str) -> tuple[list[list[float]], list[list[int]]]:
    """Return (x, y, depth) of the nodes in order of the file, and the triangles' node ids."""
    lines = text.splitlines()
    n_elements, n_nodes = (int(word) for word in lines[1].split()[:2])
    nodes = [[float(w.replace("D", "e")) for w in line.split()[1:4]] for line in lines[2 : 2 + n_nodes]]
    elements = lines[2 + n_nodes : 2 + n_nodes + n_elements]
    return nodes, [[int(w) for w in line.split()[2:5]] for line in elements]
