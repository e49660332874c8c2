"""Regions of an annealed part tried once more from strips of fronts; the better end of the two is kept.

Strips are a start with few irregular vertices where the counts of the fronts put them; they are annealed at
a low temperature, which cleans up the gaps without melting the fronts. What is kept has fewer irregular
vertices, or as many and a better worst triangle, and misses neither size nor number of triangles.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..blocks.cooling import Schedule, cooled, size_rms
from ..blocks.domain import Domain
from ..blocks.lack import qualities
from ..blocks.placed import PlacedMesh
from ..blocks.weights import TRIANGLES
from ..mesh import Mesh
from ..regions.borders import corner_shares, smooth_borders
from ..regions.labels import connected
from .mend import holders, patch_of, spliced, worst_lack
from .polish import polished
from .strips import stripped
from .wish import Wish

CLEANUP = Schedule(
    weights=TRIANGLES,
    hot=0.1,
    cold=0.03,
    moves=2,
    steered=9,
    gain=0.3,
    most_shift=0.2,
    most_size_weight=2.0,
)
"""How strips are annealed: from a lower temperature than a mesh of chance."""

BORDER_ROUNDS = 2
"""Rounds in which the borders of regions are straightened in the new mesh: ragged ones leave no room."""

FEWEST = 4
"""A region with fewer irregular vertices, rim included, has nothing to gain: two fronts of the simplest
transition have as many."""


@dataclass(frozen=True)
class Tries:
    """What came of strips."""

    tried: int = 0
    """Regions with a clear transition, in which strips were laid."""
    kept: int = 0
    """Those that ended better than without."""
    gone: int = 0
    """Irregular vertices fewer in these than without, rims included."""


def with_strips(
    domain: Domain,
    mesh: PlacedMesh,
    log_size: Floats,
    wish: Wish,
    *,
    n_sweeps: int,
    seed: int,
    progress: Callable[[str, float], None] = lambda _, __: None,
    is_stopped: Callable[[], bool] = lambda: False,
) -> tuple[PlacedMesh, Tries]:
    """Return a mesh laid out in strips where that ends better, all of it or by regions, and how often it did.

    log_size is the log of the wanted edge at the domain's points, n_sweeps what each region gets.
    Regions are those of the wish. progress hears of the share of them done.
    """
    tried = kept = gone = 0
    label = _label(domain, mesh, wish)
    n_own = np.bincount(wish.label)
    whole = [] if len(n_own) == 1 else [np.ones(len(n_own), dtype=bool)]
    for number, chosen in enumerate([*whole, *np.eye(len(n_own), dtype=bool)]):
        if is_stopped():
            break
        progress("strips", number / (len(n_own) + 1))
        inside = chosen[label] & ((label >= 0) | chosen.all())
        if not inside.any():
            continue
        patch = patch_of(mesh, inside)
        if np.count_nonzero(patch.mesh.is_irregular) < FEWEST:
            continue
        start = stripped(patch.mesh, _at(domain, log_size, patch.mesh), is_searched=len(n_own) == 1)
        if start is None:
            continue
        tried += 1
        n_wanted = wish.n_triangles * n_own[chosen].sum() / len(wish.label)
        made = cooled(
            domain, start, log_size, CLEANUP,
            n_sweeps=n_sweeps, n_wanted=n_wanted, rms_wanted=wish.size_misfit,
            seed=seed + number, progress=lambda _, __: None, is_stopped=is_stopped,
        )  # fmt: skip
        found = polished(domain, made.mesh, log_size, size_weight=made.size_weight, offset=made.offset)
        if _is_better(domain, found, patch.mesh, log_size, wish, n_wanted):
            gone += int(patch.mesh.is_irregular.sum()) - int(found.is_irregular.sum())
            mesh, kept = spliced(mesh, [(patch, found)]), kept + 1
            label = _label(domain, mesh, wish)
            if chosen.all():
                break
    return mesh, Tries(tried, kept, gone)


def _label(domain: Domain, mesh: PlacedMesh, wish: Wish) -> Ints:
    """Return the region of each triangle, its borders straight; -1 on all but its largest piece."""
    whole = Mesh(mesh.points, mesh.triangles)
    own = wish.label[holders(domain, mesh)]
    label = smooth_borders(whole, own, corner_shares(whole), rounds=BORDER_ROUNDS)
    piece = connected(whole, label)
    n_in = np.bincount(piece)
    order = np.argsort(n_in[piece], kind="stable")
    largest = np.full(int(label.max()) + 1, -1)
    largest[label[order]] = piece[order]
    return np.where(piece == largest[label], label, -1)


def _is_better(
    domain: Domain, made: PlacedMesh, now: PlacedMesh, log_size: Floats, wish: Wish, n_wanted: float
) -> bool:
    off = [abs(len(mesh.triangles) / n_wanted - 1) for mesh in (made, now)]
    lack = [worst_lack(domain, mesh, wish.least) for mesh in (made, now)]
    if off[0] > max(off[1], wish.tolerance) or lack[0] > max(lack[1], 0.0):
        return False
    if size_rms(domain, made, log_size) > max(size_rms(domain, now, log_size), wish.size_misfit):
        return False
    n_irregular = [int(np.count_nonzero(mesh.is_irregular)) for mesh in (made, now)]
    least = [float(qualities(mesh).min()) for mesh in (made, now)]
    return (n_irregular[0], -least[0]) < (n_irregular[1], -least[1])


def _at(domain: Domain, values: Floats, mesh: PlacedMesh) -> Floats:
    from ..blocks.kernel.walk import locate

    triangle, shares = locate(domain.points, domain.triangles, mesh.points, mesh.hints)
    return np.asarray((shares * values[domain.triangles[triangle, :3]]).sum(axis=1))
