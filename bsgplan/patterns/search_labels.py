"""The noun Labels: partial sequences that have come down to one count, and which of them are worth going on.

A label is its blocks, iota+ so far, its last drop, and the sums lo and hi of the widths at which its strips
reach a quality. It is left out where another label, followed by some strips of equal coarse fronts, has no
more blocks and no more iota+ whatever comes next, no larger lo and no smaller hi: those strips can wait
until the end of the sequence, where they add no iota+.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from ..arrays import Bools, Floats, Ints
from .pattern import Counts
from .straight import SLACK

CHUNK = 256
"""Labels compared with all kept ones at once: memory."""


@dataclass(frozen=True, eq=False)
class Labels:
    """Partial sequences that have come down to one count."""

    whole: Ints
    """Rows positive, drop, blocks, parent and own number, (5, n)."""
    widths: Floats
    """Rows sum lo and sum hi, (2, n), heights."""
    count: int
    """Elements of the front they have come down to."""

    def __len__(self) -> int:
        return self.whole.shape[1]

    def take(self, which: Bools | Ints) -> Labels:
        """Return some of the labels, by mask or index."""
        return Labels(self.whole[:, which], self.widths[:, which], self.count)

    def numbered(self, first: int) -> Labels:
        """Return the labels with own numbers from first on."""
        own = np.arange(first, first + len(self))[None]
        return Labels(np.concatenate([self.whole[:4], own]), self.widths, self.count)

    def followed(self, count: int, low: float, high: float) -> Labels:
        """Return the labels one strip further, at this count; low and high are the widths of the strip."""
        drop = np.full(len(self), self.count - count)
        positive = self.positive + np.maximum(drop - self.drop, 0)
        whole = np.stack([positive, drop, self.blocks + self.count + count, self.own, self.own])
        return Labels(whole, self.widths + np.array([[low], [high]]), count)

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


def start(count: int) -> Labels:
    """Return the label of a sequence that is its finest front."""
    return Labels(np.array([[0], [0], [0], [-1], [-1]]), np.zeros((2, 1)), count)


def stack(parts: list[Labels], count: int) -> Labels:
    """Return the labels of all parts, which have come down to the same count."""
    none = Labels(np.zeros((5, 0), dtype=np.int64), np.zeros((2, 0)), count)
    parts = [none, *parts]
    whole = np.concatenate([p.whole for p in parts], axis=1)
    return Labels(whole, np.concatenate([p.widths for p in parts], axis=1), count)


def path(label: int, parent: Ints, counts: Ints) -> Counts:
    """Return the counts of a label by its number, from the numbers of parents and the counts of all."""
    found = []
    while label >= 0:
        found.append(int(counts[label]))
        label = int(parent[label])
    return tuple(reversed(found))


@dataclass(frozen=True)
class Tail:
    """A strip between two coarsest fronts, which may follow any sequence as often as wanted."""

    blocks: int
    low: float
    """Its smallest width at the quality, inf where it never reaches it."""
    high: float

    @property
    def is_open(self) -> bool:
        """Whether it reaches the quality."""
        return self.low < inf


@dataclass(frozen=True)
class Rest:
    """What is left to do from a count on."""

    enough: float
    """Sum hi from which no completion leaves a sequence too short, heights."""
    spare: float
    """Bound of lo - hi tail.low / tail.high: a label under it fits, completed in any way, with as few tail
    strips as make it long enough, if it needs one at all. The strips vary enough to bridge a whole one."""


def undominated(labels: Labels, others: Labels, tail: Tail, rest: Rest) -> Labels:
    """Return the labels that neither others of the same count nor one of themselves makes superfluous."""
    keys = (-labels.widths[1], labels.widths[0], -labels.drop, labels.positive, labels.blocks)
    labels = labels.take(np.lexsort(keys))  # whatever makes another superfluous comes before it
    every, n_others = stack([others, labels], labels.count), len(others)
    kept = np.arange(n_others)
    for first in range(n_others, len(every), CHUNK):
        here = np.arange(first, min(first + CHUNK, len(every)))
        here = here[~_is_matched(every, kept, here, tail, rest).any(axis=0)]
        among = np.triu(_is_matched(every, here, here, tail, rest), 1)
        kept = np.concatenate([kept, here[~among.any(axis=0)]])
    return every.take(kept[n_others:])


def _is_matched(labels: Labels, by: Ints, each: Ints, tail: Tail, rest: Rest) -> Bools:
    """Whether each label is matched by others, (n_by, n_each)."""
    positive, drop, blocks = labels.whole[:3, by, None]
    turned = positive + np.maximum(labels.drop[each] - drop, 0)
    low, high = labels.widths[:, by, None]
    most, wanted = labels.widths[0, each], np.minimum(labels.widths[1, each], rest.enough)
    slack = SLACK * (1 + wanted)
    missing = wanted - slack - high
    if tail.is_open:
        n_strips = np.ceil(np.maximum(missing, 0.0) / tail.high)
        is_free = low - high * (tail.low / tail.high) <= rest.spare
        low = low + np.where(is_free, 0.0, n_strips * tail.low)
        blocks, missing = blocks + n_strips * tail.blocks, np.zeros(1)
    is_as_good: Bools = (turned <= labels.positive[each]) & (blocks <= labels.blocks[each])
    return is_as_good & (low <= most + slack) & (missing <= 0)
