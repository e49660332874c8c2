"""Every sequence of front counts worth having, exactly: dynamic programming over strips at a quality.

A strip reaches mean ratio Q for widths in one interval, and the intervals of a pattern's strips add: it
reaches Q over a length where sum lo(Q) <= length <= sum hi(Q). At a fixed Q a partial sequence that has come
down to a count is therefore known by five numbers: blocks, iota+ so far, its last drop, sum lo and sum hi.
iota+ is the sum of the rises of the drop f(k) - f(k+1), [Zint & Grosso], Eq. 16 to 18.

Long transitions reduce to short ones. Strips of equal fronts of n elements have the widths of those of c, the
coarse end, times c / n, at every Q: n / gcd(n, c) of the former are as long as c / gcd(n, c) of the latter,
which have fewer blocks and add no iota+ at the end of a sequence. So there are fewer than n / gcd(n, c) of
them before the coarse end, whatever the length, and only the last front is repeated at will: its number
follows by division. Partial sequences are left out where another one, perhaps followed by some such strips,
is as good in all five numbers (`search_labels`), where they cannot end with fewer blocks or less iota+ than
a pattern known to reach Q, and a strip of equal fronts is added only while the sequence may still be too
short. None of this loses one that counts.
The front follows by raising Q from the least quality wanted to just above the worst pattern known, again
and again: each round is one dynamic programme and leaves that pattern behind.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import gcd, inf

import numpy as np

from ..arrays import Bools, Floats, Ints
from .pattern import Counts
from .search_labels import Labels, Rest, Tail, path, stack, start, undominated
from .search_strips import Known, Strips, front, known
from .straight import SLACK, qualities_over

STEP = 1e-4
"""Rise of Q above the worst pattern known: two more digits than anybody prints."""
NEAR = 1e-3
"""Mean ratios this close to the best at any length count as equal: ever more sequences, hardly better."""


def exact_front(
    strips: Strips, length: float | None, pool: Iterable[Known], *, least_quality: float
) -> list[Known]:
    """Return the front of all non-increasing sequences of these strips, fine > coarse, best quality first.

    The length is in heights, None for each sequence's best; pool holds sequences known beforehand.
    Every sequence of mean ratio at least least_quality is matched by a returned one with no more blocks,
    no more iota+, and no less mean ratio but for STEP, or NEAR next to the best one at any length.
    """
    found, q = front(pool), least_quality
    last = max(least_quality, _top(strips) - NEAR)
    while True:
        new = sequences_at(strips, length, q, [k for k in found if k.quality >= q])
        if new:
            qualities = qualities_over(new, length, is_closed=strips.is_closed)
            found = front([*found, *known(new, np.maximum(q, qualities))])
        above = [k.quality for k in found if k.quality >= q]
        if not above or q >= last:
            return [k for k in found if k.quality >= least_quality]
        q = min(min(above) + STEP, last)


def sequences_at(strips: Strips, length: float | None, q: float, incumbents: Iterable[Known]) -> list[Counts]:
    """Return sequences that reach q over the length: one for each pair of least blocks and iota+.

    Pairs that an incumbent, known to reach q, has or betters are left out.

    >>> from .search_strips import strips_between
    >>> sequences_at(strips_between(4, 1), 0.75, 0.86, [])
    [(4, 2, 1)]
    """
    step = _Step.at(strips, length, q, _bars(incumbents))
    batches: list[Labels] = []
    n_labels = 0
    for count in range(strips.fine, strips.coarse, -1):
        here = stack([], count)
        layer = start(count) if count == strips.fine else step.arrivals(batches, count)
        for _ in range(count // gcd(count, strips.coarse)):
            layer = step.best(layer, here).numbered(n_labels)
            n_labels += len(layer)
            here = stack([here, layer], count)
            layer = step.moved(layer.take(step.is_short(layer)), count)
            if not len(layer):
                break
        batches.append(here)
    last = step.arrivals(batches, strips.coarse)
    n_more, n_blocks = step.ended(last)
    least, chosen = inf, []
    for k in np.lexsort((last.positive, n_blocks)):
        if last.positive[k] < least and np.isfinite(n_blocks[k]):
            least = last.positive[k]
            chosen.append(int(k))
    if not chosen:
        return []
    parent = np.concatenate([b.whole[3] for b in batches])
    counts = np.concatenate([np.full(len(b), b.count) for b in batches])
    return [
        path(int(last.whole[3, k]), parent, counts) + (strips.coarse,) * (1 + int(n_more[k])) for k in chosen
    ]


@dataclass(frozen=True, eq=False)
class _Step:
    """What a strip adds at a quality, and what any completion from a count adds at least."""

    low: Floats
    """Smallest width of the strip between two counts, (fine + 1, fine + 1), inf where none reaches q."""
    high: Floats
    length: float
    tail: Tail
    rest_low: Floats
    """Least sum of low from a count to the last, (fine + 1,)."""
    rest_high: Floats
    rest_blocks: Floats
    rate: float
    """Least blocks per largest width of any strip, blocks a height; 0 at free length."""
    rest_excess: Floats
    """Least sum of blocks - rate * high, which no strip has under 0, (fine + 1,)."""
    rest_stiff: Floats
    """Largest sum of low - high tail.low / tail.high, to which strips of equal fronts add 0, (fine + 1,)."""
    bars: Floats
    """Blocks that a sequence must stay under, by its iota+, (n,)."""

    @classmethod
    def at(cls, strips: Strips, length: float | None, q: float, bars: Floats) -> _Step:
        low, high = strips.intervals(q)
        end = strips.coarse
        tail = Tail(2 * end, float(low[end, end]), float(high[end, end]))
        if length is None:
            low, high = np.where(np.isfinite(low), 0.0, np.inf), np.where(np.isfinite(high), 0.0, -np.inf)
            tail = Tail(2 * end, inf, -inf)
        is_open = np.isfinite(low)
        count = np.arange(strips.fine + 1)
        blocks = np.where(is_open, count[:, None] + count, np.inf)
        wide = np.where(is_open, high, np.inf)
        rate = float((blocks[is_open] / wide[is_open]).min()) if length and is_open.any() else 0.0
        ratio = tail.low / tail.high if tail.is_open else 0.0
        with np.errstate(invalid="ignore"):
            excess, stiff = (
                np.where(is_open, add, np.inf) for add in (blocks - rate * high, ratio * high - low)
            )
        adds = (low, wide, blocks, excess, stiff)
        rests = np.full((5, strips.fine + 1), np.inf)
        rests[:, end] = 0.0
        for k in range(end + 1, strips.fine + 1):
            for rest, add in zip(rests, adds, strict=True):
                rest[k] = (add[k, end:k] + rest[end:k]).min()
        lows, highs, least_blocks, least_excess, most_stiff = rests
        return cls(
            low, high, length or 0.0, tail, lows, highs, least_blocks, rate, least_excess, -most_stiff, bars
        )

    def arrivals(self, batches: list[Labels], count: int) -> Labels:
        """Return the labels of finer counts one strip further, at this count."""
        return stack([self.moved(b, count) for b in batches], count)

    def moved(self, labels: Labels, count: int) -> Labels:
        """Return the labels one strip further, none where no width of the strip reaches the quality."""
        low, high = self.low[labels.count, count], self.high[labels.count, count]
        return labels.followed(count, low, high) if np.isfinite(low) else stack([], count)

    def is_short(self, labels: Labels) -> Bools:
        """Whether some completion would leave the sequence too short for the length, (n,)."""
        rest = self.rest_high[labels.count]
        return np.asarray(labels.widths[1] + rest < self.length * (1 - SLACK))

    def best(self, labels: Labels, others: Labels) -> Labels:
        """Return the labels that can still become the best of something, beside others of the same count."""
        count = labels.count
        bar = self.bars[np.minimum(labels.positive, len(self.bars) - 1)]
        fits = labels.widths[0] + self.rest_low[count] <= self.length * (1 + SLACK)
        missing = self.length * (1 - SLACK) - labels.widths[1]
        rest = np.maximum(self.rest_blocks[count], missing * self.rate + self.rest_excess[count])
        labels = labels.take(fits & (labels.blocks + np.ceil(rest - 1e-6) < bar))
        return undominated(labels, others, self.tail, self.rest(count))

    def rest(self, count: int) -> Rest:
        """Return what completions from a count on are like."""
        enough, spare = max(0.0, self.length - self.rest_high[count]), -inf
        if self.tail.is_open:
            ratio = self.tail.low / self.tail.high
            spare = self.length * (1 - ratio) - self.tail.low - self.rest_stiff[count]
        return Rest(enough, spare)

    def ended(self, labels: Labels) -> tuple[Ints, Floats]:
        """Return the strips needed at the coarse end, and the blocks with them, inf where none fit, (n,)."""
        low, high = labels.widths
        missing = np.maximum(self.length * (1 - SLACK) - high, 0.0)
        n_more = np.zeros(len(labels), dtype=np.int64)
        if self.tail.is_open:
            n_more = np.ceil(missing / self.tail.high).astype(np.int64)
            low, missing = low + n_more * self.tail.low, np.zeros(len(labels))
        blocks = labels.blocks + n_more * self.tail.blocks
        bar = self.bars[np.minimum(labels.positive, len(self.bars) - 1)]
        fits = (low <= self.length * (1 + SLACK)) & (missing <= 0) & (blocks < bar)
        return n_more, np.where(fits, blocks, np.inf)


def _top(strips: Strips) -> float:
    """Return the best mean ratio of a sequence at any length."""
    caps = np.zeros((strips.fine + 1, strips.fine + 1))
    caps[strips.first, strips.second] = strips.caps
    top = np.ones(strips.fine + 1)
    for count in range(strips.coarse + 1, strips.fine + 1):
        top[count] = np.minimum(caps[count, strips.coarse : count], top[strips.coarse : count]).max()
    return float(top[strips.fine])


def _bars(incumbents: Iterable[Known]) -> Floats:
    pairs = [(k.positive, k.n_blocks) for k in incumbents]
    bars = np.full(max((p for p, _ in pairs), default=0) + 1, np.inf)
    for positive, blocks in pairs:
        bars[positive:] = np.minimum(bars[positive:], blocks)
    return bars
