"""One pattern proposed for one region, with everything that speaks for or against it."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from ..patterns import Bounds, Pattern, Shape, Spacing, best_spacing, best_width, bounds
from ..regions import Profile, Region
from .fit import arithmetic, misfit, searched, sequences

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
    bounds: Bounds = field(repr=False)
    """What irregularity alone allows."""
    spacing: Spacing = field(repr=False)
    """Best front positions in the region's own shape, and q_min there."""
    rejected: str | None
    """Why it is advised against, or None."""

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


def candidates(region: Region, tris_per_block: int) -> tuple[Candidate, ...]:
    """Return the patterns proposed for a transition region, best fit first, rejected ones last."""
    side = float(np.sqrt(tris_per_block))
    least = 3 if region.is_closed else 1
    shape = region_shape(region.profile, side, is_closed=region.is_closed)
    wanted = region.weight / tris_per_block
    counts = sequences(region.profile, side, least=least)
    best = searched(region.profile, side, is_closed=region.is_closed)
    worth = {c: _worth(c, region.profile, side, wanted) for c in [*counts, *best]}
    kept = _prune(sorted(counts, key=lambda c: (worth[c], len(c), c)))
    more = sorted(set(best) - set(kept), key=lambda c: (worth[c] - best[c], len(c), c))
    kept += more[:MOST_SEARCHED]
    kept += [c for c in arithmetic(region.profile, side, least=least) if c not in kept]
    made = [
        _candidate(
            Pattern(c, is_closed=region.is_closed),
            shape,
            tris_per_block,
            wanted,
            misfit(c, region.profile, side),
        )
        for c in kept
    ]
    return tuple(
        sorted(made, key=lambda c: (c.rejected is not None, c.misfit + c.count_misfit, c.pattern.counts))
    )


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


def _candidate(pattern: Pattern, shape: Shape, tris_per_block: int, wanted: float, error: float) -> Candidate:
    spacing = best_spacing(pattern, shape)
    objection = _objection(pattern)
    if objection is None and spacing.q_min <= 0:
        objection = "its blocks turn inside out in the shape of this region, wherever its fronts stand"
    return Candidate(pattern, tris_per_block, error, wanted, bounds(pattern), spacing, objection)


def _objection(pattern: Pattern) -> str | None:
    steep = [(max(s), min(s)) for s in pattern.strips if max(s) > 2 * min(s)]
    caps = [(strip_cap(*s), s) for s in steep]
    if not caps or min(caps)[0] >= LEAST_STRIP_QUALITY:
        return None
    cap, (m, n) = min(caps)
    what = "anisotropic" if m > 4 * n else "asymmetric"
    return f"strip {m}:{n} is {what}: its mean ratio stays under {cap:.2f} at any width; put a front between"


def _worth(counts: tuple[int, ...], profile: Profile, side: float, wanted: float) -> float:
    return misfit(counts, profile, side) + abs(float(np.log(Pattern(counts).n_blocks / wanted)))


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
