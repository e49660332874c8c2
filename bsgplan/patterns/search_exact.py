"""Every sequence of front counts worth having, exactly: dynamic programming over strips at a quality.

A strip reaches mean ratio Q for widths in one interval, and the intervals of a pattern's strips add: it
reaches Q over a length where sum lo(Q) <= length <= sum hi(Q). At a fixed Q a partial sequence that has come
down to a count is therefore known by five numbers: blocks, iota+ so far, its last drop, sum lo and sum hi.
iota+ is the sum of the rises of the drop f(k) - f(k+1), [Zint & Grosso], Eq. 16 to 18.
Of two partial sequences with equal integers the one with no smaller lo and no larger hi is left out; so is
one that cannot end with fewer blocks or less iota+ than a pattern known to reach Q; and a further strip of
equal fronts is added only while the sequence may still be too short. None of this loses one that
counts.
The front follows by raising Q from the least quality wanted to just above the worst pattern known, again
and again: each round is one dynamic programme and leaves that pattern behind.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats, Ints
from .search_strips import SLACK, Counts, Known, Strips, front, known, qualities_over

STEP = 1e-4
"""Rise of Q above the worst pattern known: two more digits than anybody prints."""

MOST_LABELS = 150_000
"""Partial sequences of one round, at most: half a second. Only long transitions to many elements have more,
near the best quality of all, where intervals shrink to points and leave nothing out."""


class TooManyLabels(Exception):  # noqa: N818 - never leaves this module
    """A round has more than MOST_LABELS partial sequences."""


def exact_front(
    strips: Strips, length: float | None, pool: Iterable[Known], *, least_quality: float
) -> list[Known]:
    """Return the front of all non-increasing sequences of these strips, fine > coarse, best quality first.

    The length is in heights, None for each sequence's best; pool holds sequences known beforehand.
    Every sequence of mean ratio at least least_quality is matched by a returned one with no more blocks,
    no more iota+, and no less mean ratio but for STEP; above a quality at which there are more than
    MOST_LABELS partial sequences only by the best of those known.
    """
    found, q = front(pool), least_quality
    while True:
        incumbents = [k for k in found if k.quality >= q]
        try:
            new = sequences_at(strips, length, q, incumbents)
        except TooManyLabels:
            return [k for k in found if k.quality >= least_quality]
        if new:
            qualities = qualities_over(new, length, is_closed=strips.is_closed)
            found = front([*found, *(known(c, max(q, r)) for c, r in zip(new, qualities, strict=True))])
        above = [k.quality for k in found if k.quality >= q]
        if not above:
            return [k for k in found if k.quality >= least_quality]
        q = min(above) + STEP


def sequences_at(strips: Strips, length: float | None, q: float, incumbents: Iterable[Known]) -> list[Counts]:
    """Return sequences that reach q over the length: one for each pair of least blocks and iota+.

    Pairs that an incumbent, known to reach q, has or betters are left out. Raises TooManyLabels.

    >>> from .search_strips import strips_between
    >>> sequences_at(strips_between(4, 1), 0.75, 0.86, [])
    [(4, 2, 1)]
    """
    step = _Step.at(strips, length, q, _bars(incumbents))
    batches: list[_Labels] = []
    n_labels = 0
    for count in range(strips.fine, strips.coarse - 1, -1):
        layer = _start(count) if count == strips.fine else step.arrivals(batches, count)
        while len(layer):
            layer = step.best(layer).numbered(n_labels)
            batches.append(layer)
            n_labels += len(layer)
            if n_labels > MOST_LABELS:
                raise TooManyLabels
            layer = step.moved(layer.take(step.is_short(layer)), count)
    ends = [b for b in batches if b.count == strips.coarse]
    if not ends:
        return []
    last = _stack(ends)
    last = last.take(last.widths[1] >= step.length * (1 - SLACK))
    cheapest = np.lexsort((last.positive, last.blocks))
    chosen, least = [], np.inf
    for k in cheapest:
        if last.positive[k] < least:
            least = last.positive[k]
            chosen.append(int(last.own[k]))
    parent = np.concatenate([b.whole[3] for b in batches])
    counts = np.concatenate([np.full(len(b), b.count) for b in batches])
    return [_path(k, parent, counts) for k in chosen]


@dataclass(frozen=True, eq=False)
class _Labels:
    """Partial sequences that have come down to one count."""

    whole: Ints
    """Rows positive, drop, blocks, parent and own number, (5, n)."""
    widths: Floats
    """Rows sum lo and sum hi, (2, n)."""
    count: int
    """Elements of the front they have come down to."""

    def __len__(self) -> int:
        return self.whole.shape[1]

    def take(self, which: Bools | Ints) -> _Labels:
        return _Labels(self.whole[:, which], self.widths[:, which], self.count)

    def numbered(self, first: int) -> _Labels:
        own = np.arange(first, first + len(self))[None]
        return _Labels(np.concatenate([self.whole[:4], own]), self.widths, self.count)

    @property
    def positive(self) -> Ints:
        """Sum of the rises of the drop so far."""
        return self.whole[0]

    @property
    def drop(self) -> Ints:
        """Last drop."""
        return self.whole[1]

    @property
    def blocks(self) -> Ints:
        """Blocks so far."""
        return self.whole[2]

    @property
    def own(self) -> Ints:
        """Number by which a later label names this one as its parent; -1 before the start."""
        return self.whole[4]


def _start(count: int) -> _Labels:
    return _Labels(np.array([[0], [0], [0], [-1], [-1]]), np.zeros((2, 1)), count)


def _none(count: int) -> _Labels:
    return _Labels(np.zeros((5, 0), dtype=np.int64), np.zeros((2, 0)), count)


@dataclass(frozen=True, eq=False)
class _Step:
    """What a strip adds at a quality, and what any completion from a count adds at least."""

    low: Floats
    """Smallest width of the strip between two counts, (fine + 1, fine + 1), inf where none reaches q."""
    high: Floats
    length: float
    rest_low: Floats
    """Least sum of low from a count to the last, (fine + 1,)."""
    rest_high: Floats
    rest_blocks: Floats
    rate: Floats
    """Least blocks per largest width of any strip from a count on, (fine + 1,)."""
    bars: Floats
    """Blocks that a sequence must stay under, by its iota+, (n,)."""

    @classmethod
    def at(cls, strips: Strips, length: float | None, q: float, bars: Floats) -> _Step:
        low, high = strips.intervals(q)
        if length is None:
            low, high = np.where(np.isfinite(low), 0.0, np.inf), np.where(np.isfinite(high), 0.0, -np.inf)
        size = np.arange(strips.fine + 1, dtype=np.float64)
        adds = (low, np.where(high < 0, np.inf, high), np.where(high < 0, np.inf, size[:, None] + size))
        rests = np.full((3, strips.fine + 1), np.inf)
        rests[:, strips.coarse] = 0.0
        for count in range(strips.coarse + 1, strips.fine + 1):
            below = slice(strips.coarse, count)
            for rest, add in zip(rests, adds, strict=True):
                rest[count] = (add[count, below] + rest[below]).min()
        finite = np.isfinite(low) & (high > 0)
        rates = np.where(finite, (size[:, None] + size) / np.where(finite, high, 1.0), np.inf).min(axis=1)
        rate = np.minimum.accumulate(rates)
        return cls(low, high, length or 0.0, rests[0], rests[1], rests[2], rate, bars)

    def arrivals(self, batches: list[_Labels], count: int) -> _Labels:
        """Return the labels of finer counts one strip further, at this count."""
        parts = [self.moved(b, count) for b in batches if np.isfinite(self.low[b.count, count])]
        return _stack(parts) if parts else _none(count)

    def moved(self, labels: _Labels, count: int) -> _Labels:
        """Return the labels one strip further, none where no width of the strip reaches the quality."""
        first = labels.count
        if not np.isfinite(self.low[first, count]):
            return _none(count)
        drop = np.full(len(labels), first - count)
        positive = labels.positive + np.maximum(drop - labels.drop, 0)
        whole = np.stack([positive, drop, labels.blocks + first + count, labels.own, labels.own])
        added = np.array([[self.low[first, count]], [self.high[first, count]]])
        return _Labels(whole, labels.widths + added, count)

    def is_short(self, labels: _Labels) -> Bools:
        """Whether some completion would leave the sequence too short for the length, (n,)."""
        rest = self.rest_high[labels.count]
        return np.asarray(labels.widths[1] + rest < self.length * (1 - SLACK))

    def best(self, labels: _Labels) -> _Labels:
        """Return the labels that can still become the best of something."""
        count = labels.count
        bar = self.bars[np.minimum(labels.positive, len(self.bars) - 1)]
        fits = labels.widths[0] + self.rest_low[count] <= self.length * (1 + SLACK)
        rest = np.full(len(labels), self.rest_blocks[count])
        missing = self.length * (1 - SLACK) - labels.widths[1]
        if np.isfinite(self.rate[count]):
            rest = np.maximum(rest, missing * self.rate[count])
        labels = labels.take(fits & (labels.blocks + np.ceil(rest - 1e-6) < bar))
        if len(labels) < 2:
            return labels
        # a sequence that no completion leaves too short gains nothing from more hi
        high = np.minimum(labels.widths[1], max(0.0, self.length - self.rest_high[count]))
        order = np.lexsort((-high, labels.widths[0], labels.blocks, labels.drop, labels.positive))
        labels, high = labels.take(order), high[order]
        group = np.concatenate([[0], np.cumsum((np.diff(labels.whole[:3]) != 0).any(axis=0))])
        lifted = high + group * 2 * (self.length + 1)  # every group above all before it
        before = np.concatenate([[-1.0], np.maximum.accumulate(lifted)[:-1]])
        return labels.take(lifted > before + SLACK * self.length)


def _bars(incumbents: Iterable[Known]) -> Floats:
    pairs = [(k.positive, k.n_blocks) for k in incumbents]
    bars = np.full(max((p for p, _ in pairs), default=0) + 1, np.inf)
    for positive, blocks in pairs:
        bars[positive:] = np.minimum(bars[positive:], blocks)
    return bars


def _stack(parts: list[_Labels]) -> _Labels:
    whole = np.concatenate([p.whole for p in parts], axis=1)
    return _Labels(whole, np.concatenate([p.widths for p in parts], axis=1), parts[0].count)


def _path(label: int, parent: Ints, counts: Ints) -> Counts:
    path = []
    while label >= 0:
        path.append(int(counts[label]))
        label = int(parent[label])
    return tuple(reversed(path))
