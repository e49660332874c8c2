"""One pattern proposed for one region, with everything that speaks for or against it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from math import log

import numpy as np

from ..patterns import Bounds, Pattern, Shape, Spacing, best_spacings, best_width, bounds
from ..regions import Profile, Region
from .fit import arithmetic, misfits, searched, sequences

LEAST_STRIP_QUALITY = 0.55
"""A strip that cannot reach this mean ratio at any width is advised against: 3:1 and 4:1 have .50, 7:1 .24
([Zint & Grosso], Sec. 2.2: "asymmetric transitions like 3:1 should be avoided")."""

MOST_SHOWN = 10
"""Candidates kept of those that fit a region: enough for the best of every kind and the runners-up."""

MOST_SEARCHED = 4
"""Candidates kept beside them of those that the search finds best in quality, blocks and irregularity."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """A pattern for a region, in blocks of s x s triangles."""

    pattern: Pattern
    """Its front counts, fine end first."""
    tris_per_block: int
    """Triangles per block, s^2."""
    misfit: float
    """rms of ln(block edge / wanted edge)."""
    wanted_blocks: float
    """Triangles of the region over triangles per block."""
    spacing: Spacing = field(repr=False)
    """Best front positions in the region's own shape, and q_min there."""
    rejected: str | None
    """Why it is advised against, or None."""

    @cached_property
    def bounds(self) -> Bounds:
        """What irregularity alone allows."""
        return bounds(self.pattern)

    @property
    def n_blocks(self) -> int:
        """Blocks, Eq. 15."""
        return self.pattern.n_blocks

    @property
    def planned_triangles(self) -> int:
        """Triangles after subdivision: blocks times triangles per block."""
        return self.pattern.n_blocks * self.tris_per_block

    @property
    def q_min(self) -> float:
        """Least mean ratio of the straight-edged pattern in the region's shape; 0 where blocks turn over."""
        return max(0.0, self.spacing.q_min)

    @property
    def count_misfit(self) -> float:
        """|ln(blocks / wanted blocks)|."""
        return abs(float(np.log(self.n_blocks / self.wanted_blocks)))


def candidates(regions: Sequence[Region], tris_per_block: int) -> list[tuple[Candidate, ...]]:
    """Return the patterns proposed for each transition region, best fit first, rejected ones last."""
    side = float(np.sqrt(tris_per_block))
    shapes = [region_shape(region.profile, side, is_closed=region.is_closed) for region in regions]
    proposed = [_proposed(region, tris_per_block) for region in regions]
    each = [
        (k, Pattern(counts, regions[k].is_closed)) for k, found in enumerate(proposed) for counts in found
    ]
    spacings = best_spacings([pattern for _, pattern in each], [shapes[k] for k, _ in each])
    made: list[list[Candidate]] = [[] for _ in regions]
    for (k, pattern), spacing in zip(each, spacings, strict=True):
        error, wanted = proposed[k][pattern.counts], regions[k].weight / tris_per_block
        made[k].append(
            Candidate(pattern, tris_per_block, error, wanted, spacing, _objection(pattern, spacing))
        )
    for found in made:
        found.sort(key=lambda c: (c.rejected is not None, c.misfit + c.count_misfit, c.pattern.counts))
    return [tuple(found) for found in made]


def _proposed(region: Region, tris_per_block: int) -> dict[tuple[int, ...], float]:
    """Return the counts proposed for a region and their misfit: good fits, the search's best, the paper's."""
    side = float(np.sqrt(tris_per_block))
    least = 3 if region.is_closed else 1
    wanted = region.weight / tris_per_block
    counts = sequences(region.profile, side, least=least)
    best = searched(region.profile, side, is_closed=region.is_closed)
    papers = arithmetic(region.profile, side, least=least)
    error = misfits(dict.fromkeys([*counts, *best, *papers]), region.profile, side)
    worth = {c: error[c] + abs(log(Pattern(c).n_blocks / wanted)) for c in error}
    kept = _prune(sorted(counts, key=lambda c: (worth[c], len(c), c)))
    more = sorted(set(best) - set(kept), key=lambda c: (worth[c] - best[c], len(c), c))
    return {c: error[c] for c in [*kept, *more[:MOST_SEARCHED], *papers]}


def region_shape(profile: Profile, side: float, *, is_closed: bool) -> Shape:
    """Return the front lengths of a region averaged over one block each, as patterns see them."""
    n = max(2, int(np.rint(profile.layers / side)) + 1)
    total = float(profile.positions[-1])
    fine = np.linspace(0.0, total, 8 * n + 1)
    lengths = np.interp(fine, profile.positions, profile.lengths)
    stations = np.linspace(0.0, total, n)
    half = total / (n - 1) / 2
    mean = [lengths[np.abs(fine - x) <= half * (1 + 1e-9)].mean() for x in stations]
    return Shape(stations, np.asarray(mean), is_closed)


@lru_cache(maxsize=65536)
def strip_cap(m: int, n: int) -> float:
    """Return the best mean ratio that a straight strip of m to n elements has at any width."""
    return best_width(max(m, n), min(m, n))[1]


def _objection(pattern: Pattern, spacing: Spacing) -> str | None:
    """Return why a pattern is advised against, or None."""
    steep = [(max(s), min(s)) for s in pattern.strips if max(s) > 2 * min(s)]
    caps = [(strip_cap(*s), s) for s in steep]
    if caps and min(caps)[0] < LEAST_STRIP_QUALITY:
        cap, (m, n) = min(caps)
        what = "anisotropic" if m > 4 * n else "asymmetric"
        return (
            f"strip {m}:{n} is {what}: its mean ratio stays under {cap:.2f} at any width; put a front between"
        )
    if spacing.q_min <= 0:
        return "its blocks turn inside out in the shape of this region, wherever its fronts stand"
    return None


def _steepest(counts: tuple[int, ...]) -> float:
    """Return the largest ratio of the counts of two neighbouring fronts."""
    return max(max(strip) / min(strip) for strip in Pattern(counts).strips)


def _prune(counts: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Return at most MOST_SHOWN sequences: the best fits and the extremes of blocks and irregularity."""
    if len(counts) <= MOST_SHOWN:
        return counts
    smooth = [c for c in counts if _steepest(c) <= 2] or counts
    extremes = [
        min(smooth, key=lambda c: Pattern(c).n_blocks),
        min(smooth, key=lambda c: (Pattern(c).irregularity.positive, Pattern(c).n_blocks)),
        max(counts, key=_steepest),
    ]
    rest = [c for c in counts if c not in extremes]
    return list(dict.fromkeys(extremes + rest[: MOST_SHOWN - len(set(extremes))]))
