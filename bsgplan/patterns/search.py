"""The noun Found and the verb search: the patterns of a transition worth choosing from.

For straight regions of height 1. Sequences are monotone: a transition's size is, so a front with fewer
elements than a coarser one exceeds the size wanted there, which is an upper limit; fronts of equal counts may
follow each other. (Over a long transition a sequence that goes below its coarse end can save blocks; the size
forbids it.) Sequences come from dynamic programming with prices (`search_priced`) and from the arithmetic,
geometric and halving rules, improved by single fronts (`search_pool`); the answer is their Pareto front over
blocks (fewer), iota+ (less) and q_min (more), hence never worse than the arithmetic and geometric sequences
and the paper's. Up to EXACT elements it is completed to the front of all sequences, at every length: a
sequence that is not listed is matched by one that is, with no more blocks, no more iota+ and a q_min at most
2 RESOLUTION less (`search_exact`).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from ..errors import InvalidOption, NoPatternFits
from .length import best_length
from .pattern import FEWEST_CLOSED, FEWEST_OPEN, Pattern
from .search_exact import exact_front
from .search_pool import improved, regular_sequences
from .search_priced import priced_sequences
from .search_strips import Known, front, known, strips_between
from .straight import qualities_over

EXACT = 16
"""Largest fine front searched exactly."""
MOST = 256
"""Largest fine front searched at all: time and memory grow with its square."""
MOST_LAYERS = 256
"""Layers of equal coarse fronts that the length may take: more are no transition."""
RESOLUTION = 1e-3
"""Mean ratios that differ by less count as equal: the digits that are printed."""
LEAST_QUALITY = 0.3
"""Mean ratio below which a pattern is left out: a sliver (7:1 has .24 at best)."""


@dataclass(frozen=True)
class Found:
    """A pattern of the Pareto front."""

    pattern: Pattern
    """Its counts, in the direction asked for."""
    length: float
    """The length asked for, or the pattern's own best one, in heights."""
    q_min: float
    """Smallest mean ratio of the straight pattern over that length, fronts at their best positions."""

    @property
    def n_blocks(self) -> int:
        """Blocks, Eq. 15."""
        return self.pattern.n_blocks

    @property
    def positive(self) -> int:
        """Positive irregularity, Eq. 20."""
        return self.pattern.irregularity.positive


def search(
    fine: int,
    coarse: int,
    *,
    length: float | None = None,
    least_quality: float = LEAST_QUALITY,
    is_closed: bool = False,
) -> tuple[Found, ...]:
    """Return the Pareto front of patterns between two counts over a length, best q_min first.

    length is in heights (front length 1), None for each pattern's own best. Where fine < coarse the patterns
    are reversed. Raises InvalidOption for counts, length or quality out of range, NoPatternFits where no
    pattern reaches least_quality.

    >>> [str(f.pattern) for f in search(4, 1, length=0.75)]
    ['4:2:1', '4:3:2:1', '4:1:1', '4:1']
    """
    _check(fine, coarse, length, least_quality, is_closed=is_closed)
    high, low = max(fine, coarse), min(fine, coarse)
    pool = _pool(high, low, length, least_quality, is_closed=is_closed)
    if high > low and is_exact(fine, coarse):
        strips = strips_between(high, low, is_closed=is_closed)
        good = (k for k in pool if k.quality >= least_quality)
        pool = exact_front(strips, length, good, least_quality=least_quality) or pool
    best = front((k for k in pool if k.quality >= least_quality), resolution=RESOLUTION)
    if not best:
        top = max(pool, key=lambda k: k.quality)
        where = "" if length is None else f" over {length:g} heights"
        raise NoPatternFits(
            f"no pattern from {fine} to {coarse}{where} reaches a mean ratio of {least_quality:g}; "
            f"{':'.join(map(str, top.counts))} has {top.quality:.3g}; change the length or ask for less"
        )
    return tuple(_found(k, length, is_reversed=fine < coarse, is_closed=is_closed) for k in best)


def shortlist(
    fine: int, coarse: int, *, length: float, least_quality: float = LEAST_QUALITY, is_closed: bool = False
) -> tuple[Found, ...]:
    """Return what `search` finds before it proves that nothing is missing: most of the front, soon; or none.

    Raises InvalidOption as `search` does.

    >>> [str(f.pattern) for f in shortlist(4, 1, length=0.75, least_quality=0.55)]
    ['4:2:1', '4:3:2:1']
    """
    _check(fine, coarse, length, least_quality, is_closed=is_closed)
    pool = _pool(max(fine, coarse), min(fine, coarse), length, least_quality, is_closed=is_closed)
    best = front((k for k in pool if k.quality >= least_quality), resolution=RESOLUTION)
    return tuple(_found(k, length, is_reversed=fine < coarse, is_closed=is_closed) for k in best)


def _pool(
    fine: int, coarse: int, length: float | None, least_quality: float, *, is_closed: bool
) -> list[Known]:
    """Return the front of what prices and rules suggest, or all of it where nothing is good enough."""
    if fine == coarse:
        return _equal_fronts(fine, length, is_closed=is_closed)
    strips = strips_between(fine, coarse, is_closed=is_closed)
    priced = priced_sequences(strips, length, least_quality=least_quality)
    sequences = list(dict.fromkeys([*regular_sequences(fine, coarse, length), *priced]))
    qualities = qualities_over(sequences, length, is_closed=is_closed)
    pool = known(sequences, qualities)
    good = [k for k in pool if k.quality >= least_quality]
    return improved(good, length, least_quality=least_quality, is_closed=is_closed) if good else pool


def is_exact(fine: int, coarse: int) -> bool:
    """Return whether the search proves its answer, at any length: up to EXACT elements on a front.

    >>> is_exact(16, 1), is_exact(4, 17)
    (True, False)
    """
    return max(fine, coarse) <= EXACT


def _equal_fronts(count: int, length: float | None, *, is_closed: bool) -> list[Known]:
    """Layers of equal fronts: their number is all there is to choose, and more than suffice gain nothing."""
    strip = best_length(Pattern((count, count), is_closed))
    most = 1 if length is None else max(1, round(length / strip.length) + 1)
    sequences = [(count,) * (n + 1) for n in range(1, most + 1)]
    qualities = qualities_over(sequences, length, is_closed=is_closed)
    return known(sequences, qualities)


def _found(k: Known, length: float | None, *, is_reversed: bool, is_closed: bool) -> Found:
    pattern = Pattern(k.counts[::-1] if is_reversed else k.counts, is_closed)
    return Found(pattern, best_length(pattern).length if length is None else length, k.quality)


def _check(fine: int, coarse: int, length: float | None, least_quality: float, *, is_closed: bool) -> None:
    fewest = FEWEST_CLOSED if is_closed else FEWEST_OPEN
    for count in (fine, coarse):
        if not fewest <= count <= MOST:
            kind = "closed ring" if is_closed else "front"
            raise InvalidOption(f"{count} elements on a {kind} is not from {fewest} to {MOST}")
    if length is not None and not 0 < length < inf:
        raise InvalidOption(f"length {length:g} is not above 0; give it in heights, for example 0.7")
    if length is not None and length * min(fine, coarse) > MOST_LAYERS:
        layers = round(length * min(fine, coarse))
        raise InvalidOption(
            f"{length:g} heights of {min(fine, coarse)} elements are {layers} layers; "
            f"the most is {MOST_LAYERS}; plan the part where the size changes"
        )
    if not 0 < least_quality < 1:
        raise InvalidOption(f"least quality {least_quality:g} is not between 0 and 1; give for example 0.3")
