"""The noun Plan, and the verb that makes one: a pattern for every region, and totals for the domain."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from math import isqrt, sqrt

import numpy as np

from ..errors import InvalidOption
from ..mesh.irregularity import Irregularity
from ..mesh.thinned import Thinned
from ..regions import Region, Regions
from ..regions.carried import carried
from ..regions.region import UNIFORM
from .candidate import Candidate, candidates
from .fit import block_counts
from .objective import OBJECTIVES, choose
from .totals import GRADIENT_LIMIT, Drivers, drivers

LARGEST_BLOCK = 10**8
"""Triangles per block beyond which a number is a slip of the keyboard."""

SHORT_FRONT = 0.9
"""A front with less than this share of a block's edge is too short for the block size; a tenth of it is
measuring noise: the paper's region counts as 4 elements, not as 3.7."""


MOST_MISFIT = 0.4
"""ln of planned over wanted triangles, a factor of 1.5, beyond which a region is limited."""


@dataclass(frozen=True, eq=False)
class RegionPlan:
    """What one region becomes: the chosen pattern of a transition, or the blocks of a uniform zone."""

    region: Region
    """The region."""
    tris_per_block: int
    """Triangles per block."""
    candidates: tuple[Candidate, ...] = field(repr=False)
    """Patterns proposed, best fit first, rejected ones last; empty for a uniform zone."""
    chosen: Candidate | None
    """The one that meets the objective; None for a uniform zone."""

    @property
    def n_blocks(self) -> int:
        """Blocks of the chosen pattern (Eq. 15), or of the zone by its area."""
        if self.chosen is not None:
            return self.chosen.n_blocks
        return max(1, round(self.region.weight / self.tris_per_block))

    @property
    def planned_triangles(self) -> int:
        """Triangles after subdivision."""
        return self.n_blocks * self.tris_per_block

    @property
    def irregularity(self) -> Irregularity:
        """Relative irregularity of the chosen pattern; none in a uniform zone."""
        return self.chosen.pattern.irregularity if self.chosen else Irregularity(0, 0)

    @cached_property
    def profile(self) -> tuple[float, ...]:
        """Front counts that the region asks for, in block units, on the fronts of the chosen pattern."""
        if self.chosen is None:
            return ()
        n = self.chosen.pattern.n_layers
        return tuple(float(t) for t in block_counts(self.region.profile, sqrt(self.tris_per_block), n))

    @property
    def largest_tris_per_block(self) -> int:
        """Triangles of the largest block that this region carries."""
        if self.chosen is None:
            return max(1, isqrt(int(self.region.weight))) ** 2
        shortest = min(self.region.profile.fine_elements, self.region.profile.coarse_elements)
        return max(1, min(int(shortest / SHORT_FRONT), isqrt(int(self.region.weight)))) ** 2

    @property
    def limited(self) -> str | None:
        """Why the region cannot carry blocks of this size, or None."""
        side = sqrt(self.tris_per_block)
        if self.region.weight < self.tris_per_block:
            return f"its area holds only {self.region.weight:.1f} triangles of its size, less than one block"
        if self.chosen is None:
            return None
        profile = self.region.profile
        for name, elements in (("coarsest", profile.coarse_elements), ("finest", profile.fine_elements)):
            if elements < SHORT_FRONT * side:
                return (
                    f"constrained by the {name} front, which only contains {_count(elements, 'element')}; "
                    f"the largest block that fits has {_plural(self.largest_tris_per_block, 'triangle')}"
                )
        if self.chosen.rejected:
            return f"no pattern fits it; {self.chosen.pattern} is the least bad: {self.chosen.rejected}"
        if self.chosen.count_misfit > MOST_MISFIT:
            return (
                f"no good pattern follows its fronts; {self.planned_triangles} triangles are planned where "
                f"the size asks for {self.region.weight:.0f}"
            )
        return None


@dataclass(frozen=True, eq=False)
class Plan:
    """A plan for a mesh: regions, their patterns, and totals."""

    regions: Regions = field(repr=False)
    """The regions planned."""
    tris_per_block: int
    """Triangles per block, a perfect square."""
    objective: str
    """What the patterns were chosen for."""
    gradient_limit: float
    """Bound on the gradient of the block size in `drivers`."""
    region_plans: tuple[RegionPlan, ...] = field(repr=False)
    """One plan a region, in the order of the regions."""
    drivers: Drivers = field(repr=False)
    """Counts of the whole domain that do not depend on patterns."""

    @property
    def n_blocks(self) -> int:
        """Blocks of all patterns and uniform zones."""
        return sum(p.n_blocks for p in self.region_plans)

    @property
    def planned_triangles(self) -> int:
        """Triangles of all regions after subdivision."""
        return self.n_blocks * self.tris_per_block

    @property
    def q_min(self) -> float | None:
        """Least mean ratio over the chosen patterns, None without any."""
        return min((p.chosen.q_min for p in self.region_plans if p.chosen), default=None)

    @property
    def q_bound(self) -> float | None:
        """Least bound from valence over the chosen patterns, None without any."""
        return min((p.chosen.bounds.q_bound for p in self.region_plans if p.chosen), default=None)

    @property
    def irregularity(self) -> Irregularity:
        """Sum over isolated regions: fronts shared by two regions count twice, so an upper estimate."""
        each = [p.irregularity for p in self.region_plans]
        return Irregularity(sum(i.positive for i in each), sum(i.negative for i in each))

    def carried(self, thin: Thinned) -> Plan:
        """Return the plan of a thinned mesh as one of the whole mesh: the same patterns and drivers."""
        regions = carried(self.regions, thin)
        plans = tuple(replace(p, region=regions[p.region.id]) for p in self.region_plans)
        return replace(self, regions=regions, region_plans=plans)


def estimate(
    regions: Regions,
    *,
    tris_per_block: int = 16,
    objective: str = "balanced",
    gradient_limit: float = GRADIENT_LIMIT,
    boundary_limited: float | None = None,
) -> Plan:
    """Return the plan of regions at a block size.

    boundary_limited is the number of blocks of the domain that its boundary allows, kept among the drivers.

    Raises InvalidOption unless tris_per_block is a perfect square, the objective is known and the
    gradient limit is positive.
    """
    check_block_size(tris_per_block)
    if objective not in OBJECTIVES:
        raise InvalidOption(f"objective {objective!r} is unknown; choose one of {', '.join(OBJECTIVES)}")
    if not (np.isfinite(gradient_limit) and gradient_limit > 0):
        raise InvalidOption(f"gradient limit {gradient_limit:g} is not positive; give for example 0.6")
    transitions = [region for region in regions if region.kind != UNIFORM]
    found = dict(zip((r.id for r in transitions), candidates(transitions, tris_per_block), strict=True))
    plans = []
    for region in regions:
        proposed = found.get(region.id, ())
        chosen = choose(proposed, objective) if proposed else None
        plans.append(RegionPlan(region, tris_per_block, proposed, chosen))
    counted = drivers(
        regions,
        tris_per_block=tris_per_block,
        gradient_limit=gradient_limit,
        boundary_limited=boundary_limited,
    )
    return Plan(regions, tris_per_block, objective, gradient_limit, tuple(plans), counted)


def check_block_size(tris_per_block: int) -> None:
    """Raise InvalidOption unless tris_per_block is a perfect square s^2 >= 1.

    >>> check_block_size(20)
    Traceback (most recent call last):
    ...
    bsgplan.errors.InvalidOption: 20 triangles per block is not a square s x s; the nearest are 16 and 25
    """
    if tris_per_block < 1:
        raise InvalidOption(f"{tris_per_block} triangles per block is under 1; the nearest are 1 and 4")
    if tris_per_block > LARGEST_BLOCK:
        raise InvalidOption(f"{tris_per_block} triangles per block is over {LARGEST_BLOCK}; give fewer")
    side = isqrt(tris_per_block)
    if side**2 != tris_per_block:
        raise InvalidOption(
            f"{tris_per_block} triangles per block is not a square s x s; "
            f"the nearest are {side**2} and {(side + 1) ** 2}"
        )


def n_refinements(tris_per_block: int) -> int | None:
    """Return k where tris_per_block is 4^k, so that blocks are k uniform refinements; else None.

    >>> n_refinements(64), n_refinements(36)
    (3, None)
    """
    k = (tris_per_block.bit_length() - 1) // 2
    return k if 4**k == tris_per_block else None


def _plural(count: int, thing: str) -> str:
    return f"{count} {thing}" + ("" if count == 1 else "s")


def _count(number: float, thing: str) -> str:
    return f"{_number(number)} {thing}" + ("" if round(number) == 1 else "s")


def _number(elements: float) -> str:
    words = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
    return words[round(elements)] if 1 <= round(elements) < len(words) else f"{elements:.1f}"
