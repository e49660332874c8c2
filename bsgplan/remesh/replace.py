"""The verb: parts of a mesh exchanged for parts with far fewer irregular vertices, where that pays."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..blocks.cooling import STAGES, size_rms
from ..blocks.placed import PlacedMesh
from ..mesh import Mesh
from ..regions.labels import connected
from ..sizing import SizeField
from .accept import Terms, gains, refusal
from .anneal import Wish, remeshed
from .cut import Cut, cut
from .graft import Graft, graft
from .measures import Measures, measured

EFFORT = 30
"""Default sweeps of the annealing."""

SEED = 7
"""Default seed."""

TURNS, SMALL = 4, 4000
"""Parts of at most SMALL triangles get so many turns where chance left them worse than allowed."""


@dataclass(frozen=True)
class Part:
    """A part of the mesh that was tried."""

    name: str
    """What it is, in a word or two."""
    before: Measures
    after: Measures
    """As it is now: `before` where it was left alone."""
    reason: str
    """Why it was left alone; "" where it was replaced."""
    could_gain: bool = False
    """True where it was left alone for something else than its gain."""


@dataclass(frozen=True, eq=False)
class Replacement:
    """A mesh with parts of it replaced."""

    size: SizeField = field(repr=False)
    """The wanted edge lengths, on the mesh as it was."""
    graft: Graft = field(repr=False)
    """The mesh as it is, and where it comes from."""
    label: Ints = field(repr=False)
    """Region of each old triangle, (n_old_triangles,), -1 outside."""
    parts: tuple[Part, ...]
    """What was tried, in order."""

    @property
    def mesh(self) -> Mesh:
        """The mesh as it is."""
        return self.graft.mesh

    @property
    def new_label(self) -> Ints:
        """Region of each triangle, (n_triangles,), -1 outside."""
        return self.label[self.graft.source]

    @property
    def log_size(self) -> Floats:
        """Log of the wanted edge length at each point, (n_points,)."""
        return self.graft.at_points(self.size.log_h)

    def totals(self) -> tuple[Measures, Measures]:
        """Return the measures of the whole mesh before and after."""
        return measured(self.size.mesh, self.size.log_h), measured(self.mesh, self.log_size)

    def regions(self) -> Iterator[tuple[int, Measures, Measures]]:
        """Give each region with its measures before and after; a vertex counts with its last region."""
        sides = [(self.size.mesh, self.size.log_h, self.label), (self.mesh, self.log_size, self.new_label)]
        at = [_last_label(mesh, label) for mesh, _, label in sides]
        for k in range(int(self.label.max()) + 1):
            if all((label == k).any() for _, _, label in sides):
                before, after = (
                    measured(mesh, log_size, label == k, own == k)
                    for (mesh, log_size, label), own in zip(sides, at, strict=True)
                )
                yield k, before, after


def replace(
    size: SizeField,
    *,
    label: Ints,
    is_drawn: bool = False,
    fixed_edges: Bools | None = None,
    fixed_points: Ints | None = None,
    terms: Terms = Terms(),  # noqa: B008 - frozen
    effort: int = EFFORT,
    seed: int = SEED,
    progress: Callable[[str, float], None] = lambda _, __: None,
) -> Replacement:
    """Return the mesh of a size field with its parts replaced where that pays.

    label is the region of each triangle, (n_triangles,), -1 where nothing may change. Each edge-connected
    piece of what is labelled is tried as a whole; where that is refused for more than its gain, and unless it
    was drawn, region by region. fixed_edges, (n_edges,), and fixed_points stay. Raises InvalidMesh for a
    surface in space.
    """
    mesh = size.mesh
    accepted: list[tuple[Cut, PlacedMesh]] = []
    told: list[Part] = []
    n_labelled = max(int(np.count_nonzero(label >= 0)), 1)
    done = 0

    def attempt(inside: Bools, name: str) -> Part:
        nonlocal done
        n = int(np.count_nonzero(inside))
        part, placed = _attempt(
            size, inside, name, fixed_edges, fixed_points, terms, effort, seed,
            lambda text, share: progress(f"{name}: {text}", min((done + share * n) / n_labelled, 1.0)),
        )  # fmt: skip
        told.append(part)
        if placed is not None:
            accepted.append(placed)
            done += n
        return part

    piece = np.where(label >= 0, connected(mesh, np.where(label >= 0, 0, 1)), -1)
    pieces = np.unique(piece[piece >= 0])
    for number, k in enumerate(pieces, 1):
        inside = piece == k
        name = "region" if is_drawn else "mesh"
        name = name if len(pieces) == 1 else f"{name}, piece {number}"
        part = attempt(inside, name)
        labels = np.unique(label[inside])
        if part.could_gain and not is_drawn and len(labels) > 1:
            for region in labels:
                attempt(inside & (label == region), f"region {region}")
    return Replacement(size, graft(mesh, accepted), label, tuple(told))


def _attempt(
    size: SizeField, inside: Bools, name: str, fixed_edges: Bools | None, fixed_points: Ints | None,
    terms: Terms, effort: int, seed: int, progress: Callable[[str, float], None],
) -> tuple[Part, tuple[Cut, PlacedMesh] | None]:  # fmt: skip
    """Return what came of a part, and what it is replaced by if it is."""
    mesh = size.mesh
    before = measured(mesh, size.log_h, inside, _points_of(mesh, inside))
    part = cut(mesh, inside, fixed_edges=fixed_edges, fixed_points=fixed_points)
    if not part.start.is_irregular.any():
        return Part(name, before, before, "every vertex is regular"), None
    if part.is_frozen.all():
        return Part(name, before, before, "no vertex inside can move"), None
    log_size = size.log_h[part.point] - np.log(part.domain.scale)
    is_own = size.source == "edges"
    wanted = float(before.n_triangles) if is_own else float(size.triangle_weights[inside].sum())
    quality = max(before.q_min, terms.min_quality or 0.0)
    wish = Wish(wanted, size_rms(part.domain, part.start, log_size), quality)
    for turn in range(TURNS if before.n_triangles <= SMALL else 1):
        placed = remeshed(part, log_size, wish, effort=effort, seed=seed + STAGES * turn, progress=progress)
        tried = graft(mesh, [(part, placed)])
        is_new = np.arange(tried.mesh.n_triangles) >= tried.n_outside
        after = measured(tried.mesh, tried.at_points(size.log_h), is_new, _points_of(tried.mesh, is_new))
        reason = refusal(before, after, wanted, terms)
        if not reason:
            return Part(name, before, after, ""), (part, placed)
        if not gains(before, after):
            break
    return Part(name, before, before, reason, gains(before, after)), None


def _points_of(mesh: Mesh, triangles: Bools) -> Bools:
    is_at = np.zeros(mesh.n_points, dtype=bool)
    is_at[mesh.triangles[triangles]] = True
    return is_at


def _last_label(mesh: Mesh, label: Ints) -> Ints:
    """Return the largest label round each vertex, (n_points,)."""
    result = np.full(mesh.n_points, -1, dtype=np.int64)
    np.maximum.at(result, mesh.triangles.ravel(), np.repeat(label, 3))
    return result
