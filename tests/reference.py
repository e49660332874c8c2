"""Slow, obvious twins of the fast functions, for comparison only."""

from __future__ import annotations

import math
import struct
from collections import defaultdict
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from bsgplan.arrays import Floats
from bsgplan.patterns import Pattern, Shape, best_width, width_interval
from bsgplan.patterns.frustum import mean_ratios
from bsgplan.patterns.strip import strip_table

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


def limited_sizes(points: list[list[float]], sizes: list[float], slope: float) -> list[float]:
    """Return min over y of size(y) + slope |x - y| for each x: the gradient limit in a convex domain."""
    return [min(h + slope * math.dist(p, q) for q, h in zip(points, sizes, strict=True)) for p in points]


def steepest_minimum(links: list[tuple[int, int, float]], values: list[float]) -> list[int]:
    """Return the minimum that each node reaches along steepest edges (a, b, length), one node at a time."""
    near: dict[int, list[tuple[int, float]]] = defaultdict(list)
    for a, b, length in links:
        near[a].append((b, length))
        near[b].append((a, length))
    result = []
    for node in range(len(values)):
        while lower := [(b, d) for b, d in near[node] if values[b] < values[node]]:
            here = values[node]
            node = min(
                lower, key=lambda pair, here=here: ((values[pair[0]] - here) / pair[1], values[pair[0]])
            )[0]
        result.append(node)
    return result


def basins(links: list[tuple[int, int, float]], values: list[float], persistence: float) -> list[int]:
    """Return the surviving minimum of each node by flooding; values are distinct.

    The water rises over the edges. Where it joins two pools, the one with the higher minimum ends; if its
    depth is under persistence, its basin joins the one across that edge.
    """
    start = steepest_minimum(links, values)
    pool, joins = list(start), {}

    def lowest(node: int) -> int:
        while pool[node] != node:
            node = pool[node]
        return node

    def height(link: tuple[int, int, float]) -> tuple[float, float]:
        a, b, _ = link
        return max(values[a], values[b]), min(values[a], values[b])

    for a, b, _ in sorted(links, key=height):
        low_a, low_b = lowest(a), lowest(b)
        if low_a == low_b:
            continue
        if values[low_a] > values[low_b]:
            a, b, low_a, low_b = b, a, low_b, low_a
        if max(values[a], values[b]) - values[low_b] < persistence:
            joins[low_b] = start[a]
        pool[low_b] = low_a
    result = []
    for node in start:
        while node in joins:
            node = joins[node]
        result.append(node)
    return result


def contour_elements(
    points: Sequence[Sequence[float]], triangles: Cells, log_h: Sequence[float], level: float
) -> float:
    """Return the integral of ds / h along the contour of log h, by marching through the triangles."""
    length = 0.0
    for triangle in triangles:
        cuts = []
        for a, b in zip(triangle, triangle[1:] + triangle[:1], strict=True):
            if (log_h[a] < level) != (log_h[b] < level):
                t = (level - log_h[a]) / (log_h[b] - log_h[a])
                cuts.append([p + t * (q - p) for p, q in zip(points[a], points[b], strict=True)])
        if len(cuts) == 2:
            length += math.dist(*cuts)
    return length / math.exp(level)


SELAFIN_POINTS = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]
SELAFIN_TRIANGLES = [(1, 2, 3), (1, 3, 4)]


def selafin(
    *,
    double=False,
    order=">",
    date=False,
    origin=(0, 0),
    frames=2,
    points=SELAFIN_POINTS,
    corners=3,
    planes=0,
):
    """Return a file as the TELEMAC manual lays it out, one struct at a time."""
    real, n = ("d" if double else "f"), len(points)

    def record(content: bytes) -> bytes:
        return struct.pack(order + "i", len(content)) + content + struct.pack(order + "i", len(content))

    def reals(values) -> bytes:
        return record(struct.pack(f"{order}{len(values)}{real}", *values))

    def integers(*values: int) -> bytes:
        return record(struct.pack(f"{order}{len(values)}i", *values))

    title = b"a basin".ljust(72) + (b"SERAFIND" if double else b"SERAFIN ")
    parts = [record(title), integers(2, 0)]
    parts += [record(b"BOTTOM".ljust(16) + b"M".ljust(16)), record(b"WATER DEPTH".ljust(16) + b"M".ljust(16))]
    parts.append(integers(1, 0, *origin, 0, 0, planes, 0, 0, int(date)))
    if date:
        parts.append(integers(2020, 1, 2, 3, 4, 5))
    parts += [
        integers(len(SELAFIN_TRIANGLES), n, corners, 1),
        integers(*[c for t in SELAFIN_TRIANGLES for c in t]),
    ]
    parts += [integers(1, 2, 3, 4), reals([x for x, _ in points]), reals([y for _, y in points])]
    for frame in range(frames):
        parts += [reals([60.0 * frame]), reals([-1.5] * n), reals([frame + 0.25 * k for k in range(n)])]
    return b"".join(parts)


def holds(triangle: Sequence[Sequence[float]], point: Sequence[float]) -> bool:
    """Return True where a triangle of the plane, (3, 2), holds a point, by the signs of three areas."""
    a, b, c = triangle
    areas = [
        (v[0] - u[0]) * (point[1] - u[1]) - (v[1] - u[1]) * (point[0] - u[0])
        for u, v in ((a, b), (b, c), (c, a))
    ]
    return all(area >= 0 for area in areas) or all(area <= 0 for area in areas)


def every_sequence(
    widths: tuple[np.ndarray, np.ndarray], ends: tuple[int, int], length: float, *, blocks: int, most: int
) -> list[tuple[int, int, tuple[int, ...]]] | None:
    """Return blocks, iota+ and counts of all non-increasing sequences that fit a length; None beyond so many.

    widths holds the smallest and the largest width of the strip between any two counts. Strip by strip, with
    nothing left out but what is already too long or has more than the given blocks.
    """
    low, high = widths
    fine, coarse = ends
    pairs = [(m, n) for m in range(coarse, fine + 1) for n in range(coarse, m + 1) if low[m, n] <= length]
    paths, sums = np.full((1, 1), fine), np.zeros((3, 1))  # lo, hi, blocks
    found = []
    while len(paths):
        at = [np.flatnonzero(paths[:, -1] == m) for m in range(fine + 1)]
        which = np.concatenate([np.zeros(0, int), *(at[m] for m, _ in pairs)])
        below = np.concatenate([np.zeros(0, int), *(np.full(len(at[m]), n) for m, n in pairs)])
        above = paths[which, -1]
        sums = sums[:, which] + np.stack([low[above, below], high[above, below], above + below])
        fits = (sums[0] <= length + 1e-12) & (sums[2] <= blocks)
        paths, sums = np.column_stack([paths[which[fits]], below[fits]]), sums[:, fits]
        ended = (paths[:, -1] == coarse) & (sums[1] >= length - 1e-12)
        irregularities = np.diff(paths[ended][:, [0, *range(paths.shape[1]), -1]], n=2)
        positive = np.maximum(irregularities, 0).sum(axis=1)
        found += zip(sums[2, ended].astype(int), positive, map(tuple, paths[ended]), strict=True)
        if max(len(paths), len(found)) > most:
            return None
    return found


def straight_quality(counts: Sequence[int], length: float, *, is_closed: bool = False) -> float:
    """The mean ratio of a straight pattern over a length: halving of Q, one strip at a time."""
    low, high = 0.0, min(best_width(m, n, is_closed=is_closed)[1] for m, n in pairwise(counts))
    for k in range(60):
        q = high if k == 0 else (low + high) / 2
        widths = [width_interval(m, n, q, is_closed=is_closed) for m, n in pairwise(counts)]
        is_reached = sum(w[0] for w in widths) <= length <= sum(w[1] for w in widths)
        low, high = (q, high) if is_reached else (low, q)
    return low


def stretch(qualities: Floats) -> Floats:
    """The ratio of the principal stretches from an equilateral triangle, (n_triangles,), at least 1.

    The map from the equilateral triangle with stretches s >= t has q = 2 s t / (s^2 + t^2).
    """
    bounded = np.clip(qualities, np.finfo(np.float64).tiny, 1.0)
    return (1 + np.sqrt(1 - bounded**2)) / bounded


def critical_table(m: int, n: int, *, is_closed: bool = False) -> Floats:
    """The columns of the strip table among which the worst triangle is, (4, n_critical).

    On each front the triangles with the smallest and the largest turn of apex against midpoint: exact in a
    rectangle, an annulus and a piece of one.
    """
    table = strip_table(m, n, is_closed=is_closed)
    keep: list[int] = []
    for side in (slice(0, m), slice(m, m + n)):
        turn = np.abs(table[3, side] - table[2, side])
        keep += sorted({side.start + int(turn.argmin()), side.start + int(turn.argmax())})
    return table[:, keep]


def placed(pattern: Pattern, shape: Shape, positions: Sequence[float]) -> list[float]:
    """Front positions by the rounds of `patterns.placement`: one pattern, one pair of trials at a time."""
    window, reached, here = 0.45, -math.inf, list(positions)
    for _ in range(24):
        widths = [b - a for a, b in pairwise(here)]
        reach = [0.0, *(window * min(a, b) for a, b in pairwise(widths)), 0.0]
        trials = [[x + r * (k - 4) / 4 for k in range(9)] for x, r in zip(here, reach, strict=True)]
        strips = []
        for (m, n), first, second in zip(pattern.strips, trials[:-1], trials[1:], strict=True):
            table = critical_table(m, n, is_closed=pattern.is_closed)
            strips.append([[_worst(table, shape, a, b, pattern.is_closed) for b in second] for a in first])
        q = [math.inf] * 9
        for strip in strips:
            q = [max(min(q[i], strip[i][j]) for i in range(9)) for j in range(9)]
        most = max(q)
        paths: list[tuple[float, list[int]]] = [(0.0, [k]) for k in range(9)]
        for strip in strips:
            sums = [
                [paths[i][0] + strip[i][j] if strip[i][j] >= most else -math.inf for i in range(9)]
                for j in range(9)
            ]
            paths = [(max(s), [*paths[s.index(max(s))][1], j]) for j, s in enumerate(sums)]
        best = max(paths, key=lambda path: path[0])[1]
        here = [trial[k] for trial, k in zip(trials, best, strict=True)]
        window, reached = (window if most - reached > 0.005 * abs(most) else window / 2), most
        if window < 0.005:
            break
    return here


def _worst(table: Any, shape: Shape, first: float, second: float, is_closed: bool) -> float:
    lengths = shape.front_lengths(np.array([first, second]))
    return float(mean_ratios(table, *lengths, np.array(second - first), is_closed=is_closed).min())
