"""The verb: parts of a mesh exchanged for parts with far fewer irregular vertices, where that pays."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..arrays import Bools, Ints
from ..blocks.placed import PlacedMesh
from ..regions.labels import connected
from ..sizing import SizeField
from .accept import Terms
from .attempt import Task, attempt, told_regions
from .cut import Cut
from .graft import graft
from .replacement import Part, Replacement

EFFORT = 30
"""Default sweeps of the annealing."""

SEED = 7
"""Default seed."""


def replace(
    size: SizeField,
    *,
    label: Ints,
    is_drawn: bool = False,
    fixed_edges: Bools | None = None,
    fixed_points: Ints | None = None,
    free_edges: Bools | None = None,
    terms: Terms = Terms(),  # noqa: B008 - frozen
    effort: int = EFFORT,
    seed: int = SEED,
    progress: Callable[[str, float], None] = lambda _, __: None,
    is_stopped: Callable[[], bool] = lambda: False,
) -> Replacement:
    """Return the mesh of a size field with its parts replaced where that pays.

    label is the region of each triangle, (n_triangles,), -1 where nothing may change. Each edge-connected
    piece of what is labelled is tried as a whole; where only the quality of some regions stands in the way,
    once more without these, which are tried apart; where it is refused for more than that or its gain, region
    by region, unless it was drawn. is_stopped ends the annealing early where it gives True. fixed_edges,
    (n_edges,), and fixed_points stay; points of free_edges, (n_edges,), slide along the boundary, come and
    go. Raises InvalidMesh for a surface in space.
    """
    mesh = size.mesh
    task = Task(size, label, fixed_edges, fixed_points, free_edges, terms, effort, seed, is_stopped)
    accepted: list[tuple[Cut, PlacedMesh]] = []
    told: list[Part] = []
    n_labelled = max(int(np.count_nonzero(label >= 0)), 1)
    done = 0

    def tried(inside: Bools, name: str, n_like: int) -> Part:
        nonlocal done
        n = int(np.count_nonzero(inside))
        part, placed = attempt(
            task, inside, name,
            lambda text, share: progress(f"{name}: {text}", min((done + share * n) / n_labelled, 1.0)),
            n_like=n_like,
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
        n = int(np.count_nonzero(inside))
        part = tried(inside, name, n)
        labels = np.unique(label[inside])
        if is_drawn or len(labels) == 1 or not part.could_gain or is_stopped():
            continue
        apart = labels
        if part.offenders and len(part.offenders) < len(labels):
            is_rest = inside & ~np.isin(label, part.offenders)
            if not tried(is_rest, f"{name} without {told_regions(part.offenders)}", n).reason:
                apart = np.array(part.offenders)
        for region in apart:
            tried(inside & (label == region), f"region {region}", n)
    return Replacement(size, graft(mesh, accepted), label, tuple(told), is_stopped())
