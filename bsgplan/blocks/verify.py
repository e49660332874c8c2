"""The verb verify: what must be true of a grid of blocks before anything is written. The noun Verdict.

Every check is a number with the most that it may be. Blocks and their triangles are held to the same:
together they are what is written.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..errors import LayoutRefused
from ..mesh.check import FLAT
from ..mesh.irregularity import summed, vertex_irregularity
from ..mesh.quality import signed_areas
from ..mesh.topology import topology
from .domain import Domain
from .layout import BlockGrid, BlockLayout
from .orientation import orientation
from .outline import area_inside, crossings, curve_sides, distances, outline, rounds
from .placed import PlacedMesh

AREA_TOLERANCE = 1e-9
"""Sums of areas that differ by less than this share are equal: rounding over a million triangles."""

ROUND_TOLERANCE = 1e-6
"""A curve is covered once where its sides add up to its length within this share."""

LARGEST_DEVIATION = 2.0
"""The boundary of a grid stays within one block edge s h of the input's, or within so many h if that is
more: farther away a block has lost the boundary."""


@dataclass(frozen=True)
class Check:
    """A number that has to be at most so much."""

    name: str
    """What is counted or measured."""
    value: float
    """How much of it there is."""
    most: float
    """How much of it there may be."""
    remedy: str = "give smaller blocks or more effort"
    """What the user can do about it."""

    @property
    def is_met(self) -> bool:
        """True where the value is at most what it may be."""
        return self.value <= self.most  # not for NaN


@dataclass(frozen=True)
class Verdict:
    """The checks of a grid, and measures that belong to them."""

    checks: tuple[Check, ...]
    """What must hold."""
    area_difference: float
    """Area of the grid over that of the input, less 1."""
    n_crossings: int
    """Pairs of boundary edges of the grid that cross properly; at most those of the input."""
    n_input_crossings: int
    """Pairs of boundary edges of the input that cross properly: slits of no width, or less."""
    deviation: float
    """Largest distance between the boundaries and interfaces of grid and input, either way, in local h."""

    @property
    def is_valid(self) -> bool:
        """True where every check is met."""
        return all(check.is_met for check in self.checks)

    @property
    def reason(self) -> str:
        """The first check that is not met, in one line; empty where all are."""
        for check in self.checks:
            if not check.is_met:
                return f"{check.name}: {check.value:g}, at most {check.most:g} allowed; {check.remedy}"
        return ""


def verify(grid: BlockGrid) -> Verdict:
    """Return the verdict on a grid of blocks and on the blocks themselves."""
    domain, blocks, fine = grid.layout.domain, grid.layout.placed, grid.placed
    own = domain.outline
    most_crossings = len(crossings(domain.points, own))
    checks: list[Check] = []
    counts = []
    for what, mesh in (("blocks", blocks), ("grid", fine)):
        checks += _topology_checks(what, grid.layout, mesh)
        if not all(check.is_met for check in checks):
            nothing = float("nan")
            return Verdict(tuple(checks), nothing, 0, most_crossings, nothing)
        edges = outline(mesh)
        counts.append(len(crossings(mesh.points, edges)))
        checks += _place_checks(what, domain, mesh, counts[-1], most_crossings, edges)
    side = grid.layout.side
    deviation = deviation_of(domain, fine, grid.layout.size.h[domain.source] / domain.scale)
    per_block = np.bincount(grid.block, minlength=grid.layout.n_blocks)
    checks += [
        Check("blocks without their side^2 triangles", float(np.count_nonzero(per_block != side**2)), 0),
        Check("distance from the input's boundary in local h", deviation, max(LARGEST_DEVIATION, side)),
    ]
    area = float(signed_areas(fine.points, fine.triangles).sum() / domain.areas.sum())
    return Verdict(tuple(checks), area - 1.0, counts[-1], most_crossings, deviation)


def verified(grid: BlockGrid) -> BlockGrid:
    """Return the grid; raises LayoutRefused with the reason where it does not verify."""
    verdict = verify(grid)
    if not verdict.is_valid:
        raise LayoutRefused(f"no valid grid was found: {verdict.reason}")
    return grid


def _topology_checks(what: str, layout: BlockLayout, mesh: PlacedMesh) -> Iterator[Check]:
    """Yield the checks of who is beside whom; those of places make sense only after them."""
    domain, cells, n_points = layout.domain, mesh.triangles, len(mesh.points)
    used = np.bincount(cells.ravel(), minlength=n_points)
    directed = np.stack([cells, np.roll(cells, -1, axis=1)], axis=-1).reshape(-1, 2)
    keys = directed[:, 0] * np.int64(n_points) + directed[:, 1]
    n_twice = len(keys) - len(np.unique(keys))
    yield Check(f"unused points of the {what}", float(np.count_nonzero(used == 0)), 0)
    yield Check(f"edges of the {what} with two triangles on one side", float(n_twice), 0)
    if n_twice:
        return
    own, inputs = mesh.topology, topology(domain.triangles[:, :3], domain.n_points)
    for name, value, wanted in (
        ("Euler characteristic", own.euler_characteristic, inputs.euler_characteristic),
        ("components", own.n_components, inputs.n_components),
        ("boundary loops", own.n_boundary_loops, inputs.n_boundary_loops),
    ):
        yield Check(f"{name} of the {what} off the input's {wanted}", float(abs(value - wanted)), 0)
    yield Check(f"pinches of the {what}, split ones aside", float(own.n_pinches), 0)
    off = summed(vertex_irregularity(own)).total + 6 * inputs.euler_characteristic
    yield Check(f"irregularity of the {what} off -6 chi", float(abs(off)), 0)
    codes, across = mesh.codes, mesh.neighbours
    is_boundary_curve = np.append(~domain.lines.is_inside, False)[np.where(codes < 0, -1, codes // 2)]
    n_wrong = np.count_nonzero((across < 0) != (is_boundary_curve & (codes % 2 == 0)))
    yield Check(f"sides of the {what} on no curve at the boundary, or inside on one", float(n_wrong), 0)
    if n_wrong == 0:
        off_round = float(np.abs(rounds(domain, mesh) - 1.0).max())
        yield Check(f"curves covered by the {what}, off once", off_round, ROUND_TOLERANCE)
    fixed = domain.points[layout.target.is_corner | domain.is_kept | domain.lines.is_junction]
    yield Check(
        f"corners, junctions and kept points missing in the {what}", float(_n_missing(fixed, mesh.points)), 0
    )


def _place_checks(
    what: str, domain: Domain, mesh: PlacedMesh, n_crossing: int, most: int, edges: Ints
) -> Iterator[Check]:
    """Yield the checks of where the points are."""
    points = domain.to_mesh(mesh.points)  # what is written
    areas = signed_areas(points, mesh.triangles)
    a, b, c = points[mesh.triangles].swapaxes(0, 1)
    longest = np.maximum.reduce([((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))])
    is_flat = (orientation(a, b, c) <= 0) | ~(areas > FLAT * longest)
    where = ""
    if is_flat.any():
        x, y = points[mesh.triangles[np.flatnonzero(is_flat)[0]]].mean(axis=0)
        where = f", the first near ({x:g}, {y:g})"
    yield Check(f"inverted or flat triangles of the {what}{where}", float(np.count_nonzero(is_flat)), 0)
    yield Check(f"boundary edges of the {what} that cross", float(n_crossing), float(most))
    summed_area = float(signed_areas(mesh.points, mesh.triangles).sum())
    inside = area_inside(mesh.points, edges, is_crossing=n_crossing > 0)
    largest = float(np.abs(signed_areas(mesh.points, mesh.triangles)).max())
    yield Check(
        f"share of the area of the {what} that overlaps",
        abs(summed_area - inside) / summed_area,
        AREA_TOLERANCE + n_crossing * largest / summed_area,  # a crossing overlaps less than a triangle
    )


def deviation_of(domain: Domain, mesh: PlacedMesh, h: Floats) -> float:
    """Return the largest distance between the curves of the domain and the mesh's sides on them, in h.

    h is the local size at the domain's points, (n_points,). Both ways: points of either to the other.
    """
    rows = np.delete(np.arange(len(domain.curve_nodes)), domain.lines.first[1:] - 1)
    curve_ends = np.stack([domain.curve_nodes[rows], domain.curve_nodes[rows + 1]], axis=1)
    triangle, side = curve_sides(mesh)
    sides = np.column_stack([mesh.triangles[triangle, (side + step) % 3] for step in (1, 2)])
    nodes = np.unique(sides)
    off, nearest = distances(mesh.points[nodes], domain.points[curve_ends])
    from_grid = off / h[curve_ends[nearest]].mean(axis=1)
    back, _ = distances(domain.points[domain.curve_nodes], mesh.points[sides])
    from_input = back / h[domain.curve_nodes]
    return float(max(from_grid.max(), from_input.max()))


def _n_missing(wanted: Floats, points: Floats) -> int:
    """Return how many of the wanted points, (n, 2), are no points, a point twice where it is wanted twice."""
    if not len(wanted):
        return 0
    everything = np.concatenate([wanted, points])
    _, name = np.unique(everything, axis=0, return_inverse=True)
    n_wanted = np.bincount(name.ravel()[: len(wanted)], minlength=int(name.max()) + 1)
    n_there = np.bincount(name.ravel()[len(wanted) :], minlength=int(name.max()) + 1)
    return int(np.maximum(n_wanted - n_there, 0).sum())
