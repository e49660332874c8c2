"""One part of a mesh tried: cut out, annealed, measured, accepted or not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..blocks.cooling import STAGES, size_rms
from ..blocks.placed import PlacedMesh
from ..mesh import Mesh
from ..sizing import SizeField
from .accept import QUALITY_LOSS, Terms, gains, refusal
from .anneal import n_sweeps, remeshed
from .cut import Cut, cut
from .graft import Graft, graft
from .measures import measured
from .replacement import Part
from .wish import Wish

TURNS, SMALL = 4, 4000
"""Parts of at most SMALL triangles get so many turns where chance left them worse than allowed."""

SHOWN = 3
"""Regions named in a reason."""


@dataclass(frozen=True, eq=False)
class Task:
    """What is asked of every part of a mesh."""

    size: SizeField
    """The wanted edge lengths on the mesh."""
    label: Ints
    """Region of each triangle, (n_triangles,), -1 where nothing may change."""
    fixed_edges: Bools | None
    """Edges that stay, (n_edges,)."""
    fixed_points: Ints | None
    """Points that stay."""
    free_edges: Bools | None
    """Boundary edges whose points may move along them, (n_edges,)."""
    terms: Terms
    """What a replacement must keep to."""
    effort: int
    """Sweeps of the annealing."""
    seed: int
    """Number of the chance."""
    is_stopped: Callable[[], bool]
    """Asked before every sweep: True ends the work with what there is."""


def attempt(
    task: Task, inside: Bools, name: str, progress: Callable[[str, float], None], *, n_like: int
) -> tuple[Part, tuple[Cut, PlacedMesh] | None]:
    """Return what came of a part, (n_triangles,), and what it is replaced by if it is.

    It gets the sweeps and turns of a part of n_like triangles.
    """
    size, terms = task.size, task.terms
    mesh = size.mesh
    before = measured(mesh, size.log_h, inside, _points_of(mesh, inside))
    part = cut(
        mesh, inside,
        fixed_edges=task.fixed_edges, fixed_points=task.fixed_points, free_edges=task.free_edges,
    )  # fmt: skip
    if not part.start.is_irregular.any():
        return Part(name, before, before, "every vertex is regular"), None
    if part.is_frozen.all():
        return Part(name, before, before, "no vertex inside can move"), None
    log_size = size.log_h[part.point] - np.log(part.domain.scale)
    is_own = size.source == "edges"
    wanted = float(before.n_triangles) if is_own else float(size.triangle_weights[inside].sum())
    least = least_qualities(mesh, task.label)
    names, own = np.unique(task.label[part.triangle], return_inverse=True)
    wish = Wish(
        n_triangles=wanted,
        size_misfit=size_rms(part.domain, part.start, log_size),
        label=own,
        least=np.maximum(least[names][own], terms.min_quality or 0.0),
        floor=np.maximum(least[names][own] - QUALITY_LOSS, terms.min_quality or 0.0),
        tolerance=terms.tolerance,
    )
    for turn in range(TURNS if n_like <= SMALL else 1):
        made = remeshed(
            part, log_size, wish,
            n_sweeps=n_sweeps(n_like, task.effort), seed=task.seed + STAGES * turn,
            progress=progress, is_stopped=task.is_stopped,
        )  # fmt: skip
        tried = graft(mesh, [(part, made.mesh)])
        is_new = np.arange(tried.mesh.n_triangles) >= tried.n_outside
        after = measured(tried.mesh, tried.at_points(size.log_h), is_new, _points_of(tried.mesh, is_new))
        reason = refusal(before, after, wanted, terms)
        offenders = _offenders(tried, task.label, least)
        if not reason and not offenders:
            return Part(name, before, after, "", made.strips), (part, made.mesh)
        if not gains(before, after) or task.is_stopped():
            break
    reason = reason or f"quality would fall in {told_regions(offenders)}"
    could_gain = gains(before, after)
    return Part(name, before, before, reason, made.strips, tuple(offenders), could_gain), None


def told_regions(numbers: Sequence[int]) -> str:
    """Return a few regions in words.

    >>> told_regions([3]), told_regions([1, 2, 5, 7])
    ('region 3', 'regions 1, 2, 5, ..')
    """
    told = ", ".join(map(str, numbers[:SHOWN])) + (", .." if len(numbers) > SHOWN else "")
    return f"region{'s' if len(numbers) > 1 else ''} {told}"


def least_qualities(mesh: Mesh, label: Ints) -> Floats:
    """Return the least mean ratio of the triangles with each label, (n_labels,); -1 counts with none."""
    result = np.full(int(label.max(initial=-1)) + 1, np.inf)
    np.minimum.at(result, label[label >= 0], mesh.qualities[label >= 0])
    return result


def _offenders(tried: Graft, label: Ints, least: Floats) -> list[int]:
    """Return the regions whose worst triangle would lose more than QUALITY_LOSS."""
    now = np.full(len(least), np.inf)
    own = label[tried.source]
    np.minimum.at(now, own[own >= 0], tried.mesh.qualities[own >= 0])
    return np.flatnonzero(now < least - QUALITY_LOSS).tolist()


def _points_of(mesh: Mesh, triangles: Bools) -> Bools:
    is_at = np.zeros(mesh.n_points, dtype=bool)
    is_at[mesh.triangles[triangles]] = True
    return is_at
