"""The rival of a layout: gmsh Frontal-Delaunay on the same domain, as many triangles, polished as blocks are.

gmsh gets the outline as polylines cut at the corners that the layout has, and s h times a factor as its
background size; the factor is found so that it makes as many triangles as there are blocks. What it makes is
put on the domain, and its vertices are moved by the polish of `bsgplan.blocks.anneal`: topology by gmsh,
everything else as ours.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from bsgplan.arrays import Floats, Ints
from bsgplan.blocks.anneal import POLISH
from bsgplan.blocks.curve_places import CurvePlaces
from bsgplan.blocks.domain import Domain
from bsgplan.blocks.kinds import CORNER, INTERIOR, SLIDING
from bsgplan.blocks.placed import PlacedMesh
from bsgplan.blocks.target import Target, n_blocks

RUNS = 5
"""The most runs of gmsh to come near a count."""

NEAR = 0.02
"""Relative difference of the count that will do."""

LIMIT = 120
"""Seconds after which gmsh is given up (it never ended on one coast)."""

LEAST_PIECES = 3
"""Every loop is cut into so many pieces at least, so that gmsh cannot flatten an island."""


@dataclass(frozen=True, eq=False)
class Outline:
    """The boundary as gmsh gets it: pieces of closed curves."""

    nodes: Ints
    """Points of the domain along each piece, one piece after the other, (k,)."""
    first: Ints
    """Where each piece starts, and one past the last, (n_pieces + 1,)."""
    loop: Ints
    """Curve of the domain of each piece, (n_pieces,)."""
    rows: Ints
    """Row of the domain's curves at the start of each piece, (n_pieces,)."""


def rival_of(domain: Domain, target: Target, wanted: Floats, n_triangles: int) -> PlacedMesh | None:
    """Return gmsh's mesh of about n_triangles, polished; None where gmsh fails or takes too long.

    wanted is the block edge s h at the domain's points, in its own unit.
    """
    outline = outline_of(domain, target)
    factor = float(np.sqrt(n_blocks(domain, wanted) / n_triangles))
    best: PlacedMesh | None = None
    tried: list[tuple[int, float]] = []
    for _ in range(RUNS):
        mesh = meshed(domain, target, outline, factor * wanted)
        if mesh is None:
            break
        if best is None or _off(mesh, n_triangles) < _off(best, n_triangles):
            best = mesh
        if _off(best, n_triangles) < NEAR:
            break
        tried.append((len(mesh.triangles), factor))
        factor = _next(tried, n_triangles)
    return best and polished(domain, best, wanted)


def _next(tried: list[tuple[int, float]], n_triangles: int) -> float:
    """Return the factor between those that gave too many and too few, else the last one scaled."""
    small = [factor for n, factor in tried if n > n_triangles]
    large = [factor for n, factor in tried if n < n_triangles]
    if small and large:
        return float(np.sqrt(max(small) * min(large)))
    n, factor = tried[-1]
    return factor * float(np.sqrt(n / n_triangles))


def _off(mesh: PlacedMesh, n_triangles: int) -> float:
    return abs(len(mesh.triangles) / n_triangles - 1)


def outline_of(domain: Domain, target: Target) -> Outline:
    """Return the closed curves of a domain cut at corners, and further where corners are few."""
    nodes: list[Ints] = []
    loops: list[int] = []
    rows: list[int] = []
    for c, (first, stop, _, _) in enumerate(domain.curves):
        own, arcs = domain.curve_nodes[first : stop - 1], domain.curve_points[first : stop - 1, 2]
        cuts = np.flatnonzero(target.is_corner[own])
        while len(cuts) < LEAST_PIECES:
            cuts = np.append(cuts, _farthest(arcs, domain.curve_lengths[c], cuts))
        cuts = np.sort(cuts)
        for start, end in zip(cuts, [*cuts[1:], cuts[0] + len(own)], strict=True):
            nodes.append(own[np.arange(start, end + 1) % len(own)])
            loops.append(c)
            rows.append(first + start)
    lengths = [len(own) for own in nodes]
    return Outline(
        np.concatenate(nodes), np.concatenate([[0], np.cumsum(lengths)]), np.array(loops), np.array(rows)
    )


def _farthest(arcs: Floats, length: float, cuts: Ints) -> int:
    """Return the node of a closed curve farthest along it from the cuts there are."""
    if not len(cuts):
        return 0
    gap = np.abs(arcs[:, None] - arcs[cuts])
    return int(np.minimum(gap, length - gap).min(axis=1).argmax())


def meshed(domain: Domain, target: Target, outline: Outline, size: Floats) -> PlacedMesh | None:
    """Return what gmsh makes of the outline with that size, placed on the domain."""
    script = Path(__file__).with_name("gmsh_mesh.py")
    with tempfile.TemporaryDirectory() as folder:
        job, mesh = Path(folder) / "job.npz", Path(folder) / "mesh.npz"
        np.savez(job, **_job(domain, outline, size))
        try:
            words = [sys.executable, str(script), str(job), str(mesh)]
            subprocess.run(words, check=True, timeout=LIMIT, stdout=subprocess.DEVNULL)
        except (subprocess.TimeoutExpired, subprocess.CalledProcessError):
            return None
        return placed(domain, target, outline, dict(np.load(mesh)))


def _job(domain: Domain, outline: Outline, size: Floats) -> dict[str, Floats | Ints]:
    triangle, side = np.nonzero(domain.side_codes >= 0)
    component = np.empty(len(domain.curves), dtype=np.int64)
    component[domain.side_codes[triangle, side] // 2] = domain.mesh.topology.component[triangle]
    x, y = domain.curve_points[:, :2].T
    doubled = [x[a : b - 1] @ y[a + 1 : b] - x[a + 1 : b] @ y[a : b - 1] for a, b in domain.curves[:, :2]]
    return {
        "map_points": domain.points,
        "map_triangles": domain.triangles[:, :3],
        "size": size,
        "nodes": outline.nodes,
        "first": outline.first,
        "loop": outline.loop,
        "component": component,
        "is_outer": np.array(doubled) > 0,
    }


def placed(domain: Domain, target: Target, outline: Outline, mesh: dict[str, Floats]) -> PlacedMesh:
    """Return gmsh's mesh with the places of its vertices on the domain's curves."""
    used, corners = np.unique(mesh["triangles"], return_inverse=True)
    points, triangles = mesh["points"][used], corners.reshape(-1, 3)
    number = np.full(len(mesh["points"]), -1)
    number[used] = np.arange(len(used))
    at, piece = number[mesh["nodes"].astype(np.int64)], mesh["piece"].astype(np.int64)
    n = len(points)
    curves, arcs = np.full(n, -1), np.zeros(n)
    kinds, goals = np.full(n, INTERIOR), np.full(n, 6.0)
    length = np.diff(outline.first)[piece] - 1
    place = mesh["place"] * length  # gmsh counts nodes along a polyline, from 0 to 1
    low = np.minimum(place.astype(np.int64), length - 1)
    start, stop = domain.curves[outline.loop[piece], 0], domain.curves[outline.loop[piece], 1] - 1
    row = start + (outline.rows[piece] - start + low) % (stop - start)
    along = domain.curve_points[:, 2]
    arc = along[row] + (place - low) * (along[row + 1] - along[row])
    curves[at], arcs[at] = outline.loop[piece], arc % domain.curve_lengths[outline.loop[piece]]
    kinds[at], goals[at] = SLIDING, 4.0
    ends = np.isin(place, [0.0]) | (place == length)
    node = outline.nodes[outline.first[piece[ends]] + np.rint(place[ends]).astype(np.int64)]
    is_corner = target.is_corner[node]
    kinds[at[ends][is_corner]] = CORNER
    turning = target.turning[node[is_corner]]
    goals[at[ends][is_corner]] = 1.0 + np.maximum(np.pi - turning, 0.0) / (np.pi / 3)
    on_curve = kinds != INTERIOR
    off = CurvePlaces(domain, np.zeros(domain.n_points)).points(curves[on_curve], arcs[on_curve])
    if np.abs(off - points[on_curve]).max() > 1e-6:
        raise RuntimeError("a boundary vertex of gmsh's is not where it says")
    middles = domain.points[domain.triangles[:, :3]].mean(axis=1)
    result = PlacedMesh(
        points=points,
        triangles=_upright(points, triangles),
        codes=np.full(triangles.shape, -1),
        kinds=kinds,
        curves=curves,
        arcs=arcs,
        goals=goals,
        hints=cKDTree(middles).query(points)[1].astype(np.int64),
    )
    triangle, side = np.nonzero(result.neighbours < 0)
    result.codes[triangle, side] = 2 * curves[result.triangles[triangle, (side + 1) % 3]]
    return result


def _upright(points: Floats, triangles: Ints) -> Ints:
    a, b, c = points[triangles].swapaxes(0, 1)
    u, v = b - a, c - a
    is_down = u[:, 0] * v[:, 1] < u[:, 1] * v[:, 0]
    return np.where(is_down[:, None], triangles[:, ::-1], triangles)


def polished(domain: Domain, mesh: PlacedMesh, wanted: Floats) -> PlacedMesh:
    """Return the mesh with its vertices moved as the polish of an annealing moves them."""
    from bsgplan.blocks.kernel.exchange import load, unload
    from bsgplan.blocks.kernel.schedule import polish

    offset = 0.5 * float(np.log(n_blocks(domain, wanted) / len(mesh.triangles)))
    state = load(domain, mesh, np.log(wanted), offset=offset)
    polish(state, POLISH)
    return unload(state)
