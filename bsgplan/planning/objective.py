"""What a user may want of a pattern, and the choice that follows."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..errors import InvalidOption
from .candidate import Candidate

GOOD_QUALITY = 0.8
"""Mean ratio above which better blocks no longer speed multigrid up (V-cycle factor .34 to .39)."""

QUALITY_DIGITS = 9
"""Digits of a mean ratio that count: patterns of equal strips differ by rounding beyond."""


def _size(c: Candidate) -> tuple[float, ...]:
    return (c.misfit + 2 * c.count_misfit, c.pattern.irregularity.positive)


def _blocks(c: Candidate) -> tuple[float, ...]:
    return (c.n_blocks, c.misfit)


def _irregularity(c: Candidate) -> tuple[float, ...]:
    return (c.pattern.irregularity.positive, c.misfit + c.count_misfit)


def _quality(c: Candidate) -> tuple[float, ...]:
    return (-round(c.q_min, QUALITY_DIGITS), c.misfit + c.count_misfit)


def _balanced(c: Candidate) -> tuple[float, ...]:
    # one unit each: 15 % off in size, 25 % off in the count, .1 short of good quality, and as much
    # irregularity as the two ends of the transition impose
    counts = c.pattern.counts
    imposed = max(1, abs(counts[0] - counts[-1]))
    return (
        c.misfit / 0.15
        + c.count_misfit / 0.25
        + max(0.0, GOOD_QUALITY - c.q_min) / 0.1
        + c.pattern.irregularity.positive / imposed,
    )


OBJECTIVES: dict[str, Callable[[Candidate], tuple[float, ...]]] = {
    "size": _size,
    "blocks": _blocks,
    "irregularity": _irregularity,
    "quality": _quality,
    "balanced": _balanced,
}
"""Cost of a candidate under each objective; the smallest wins."""


def choose(candidates: Sequence[Candidate], objective: str = "balanced") -> Candidate:
    """Return the candidate that meets an objective best; a rejected one only where all are.

    Raises InvalidOption for an unknown objective.
    """
    if objective not in OBJECTIVES:
        raise InvalidOption(f"objective {objective!r} is unknown; choose one of {', '.join(OBJECTIVES)}")
    cost = OBJECTIVES[objective]
    accepted = [c for c in candidates if c.rejected is None] or list(candidates)
    return min(accepted, key=lambda c: (*cost(c), c.pattern.counts))
