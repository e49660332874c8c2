"""The noun Pattern: how many elements each front of a transition has, and what follows from that alone.

Holds for every sequence of counts, not only for decreasing ones, and for closed rings of fronts (an
annulus). Invariants: n fronts bound n - 1 layers; a layer between f and g elements has f + g blocks;
the irregularities of all fronts sum to 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from operator import index

from ..errors import InvalidOption
from ..mesh.irregularity import Irregularity

Counts = tuple[int, ...]
"""Elements of each front, from the first to the last."""

FEWEST_FRONTS = 2
FEWEST_OPEN = 1
FEWEST_CLOSED = 3
"""A ring of one or two elements would use an edge or a vertex twice."""


@dataclass(frozen=True)
class Pattern:
    """A transition written as its counts of elements per front, 7:4:1.

    Raises InvalidOption for fewer than two fronts, a front without elements, a ring of fewer than three.
    """

    counts: tuple[int, ...]
    """Elements of each front, from the first to the last, (n_fronts,)."""
    is_closed: bool = False
    """True where each front is a closed ring, false where it runs from wall to wall."""

    def __post_init__(self) -> None:
        try:
            object.__setattr__(self, "counts", tuple(index(count) for count in self.counts))
        except TypeError:
            raise InvalidOption(
                f"pattern {self.counts!r} is not a sequence of integers; write it as 7:4:1"
            ) from None
        if len(self.counts) < FEWEST_FRONTS:
            raise InvalidOption(
                f"pattern {str(self)!r} has fewer than two fronts; write at least two counts, as 2:1"
            )
        fewest = FEWEST_CLOSED if self.is_closed else FEWEST_OPEN
        if min(self.counts) < fewest:
            kind = "closed ring" if self.is_closed else "front"
            raise InvalidOption(
                f"pattern {self} has a {kind} of {min(self.counts)} elements; each needs at least {fewest}"
            )

    @classmethod
    def parse(cls, text: str, *, is_closed: bool = False) -> Pattern:
        """Return the pattern written as counts between colons.

        >>> Pattern.parse("7:4:1")
        Pattern(counts=(7, 4, 1), is_closed=False)
        """
        parts = [part.strip() for part in text.split(":")]
        if not all(part.isascii() and part.isdigit() for part in parts):
            raise InvalidOption(f"pattern {text!r} is not counts between colons; write it as 7:4:1")
        return cls(tuple(int(part) for part in parts), is_closed)

    def __str__(self) -> str:
        return ":".join(map(str, self.counts))

    @property
    def n_fronts(self) -> int:
        """Number of fronts."""
        return len(self.counts)

    @property
    def n_layers(self) -> int:
        """Number of strips between two fronts."""
        return len(self.counts) - 1

    @property
    def strips(self) -> tuple[tuple[int, int], ...]:
        """Counts on both sides of each layer, (n_layers, 2)."""
        return tuple(pairwise(self.counts))

    @property
    def n_blocks(self) -> int:
        """Number of triangles, [Zint & Grosso], Eq. 15.

        >>> Pattern.parse("7:2:1").n_blocks  # the paper's text says 14, its Eq. 15 gives 12
        12
        """
        return sum(first + second for first, second in self.strips)

    @cached_property
    def front_irregularity(self) -> tuple[int, ...]:
        """Sum of relative vertex irregularities of each front, (n_fronts,).

        f(k-1) - 2 f(k) + f(k+1) with f(0) = f(1) and f(n+1) = f(n), [Zint & Grosso], Eq. 16.

        >>> Pattern.parse("4:2:1").front_irregularity
        (-2, 1, 1)
        """
        f = (self.counts[0], *self.counts, self.counts[-1])
        return tuple(f[k - 1] - 2 * f[k] + f[k + 1] for k in range(1, len(f) - 1))

    @property
    def irregularity(self) -> Irregularity:
        """Positive and negative relative mesh irregularity, summed over fronts, Eq. 20 and 21.

        >>> Pattern.parse("7:4:2:1").irregularity
        Irregularity(positive=3, negative=-3)
        """
        fronts = self.front_irregularity
        return Irregularity(sum(i for i in fronts if i > 0), sum(i for i in fronts if i < 0))

    def reversed(self) -> Pattern:
        """Return the same pattern read from its last front.

        >>> str(Pattern.parse("7:4:1").reversed())
        '1:4:7'
        """
        return Pattern(self.counts[::-1], self.is_closed)
