"""One line of a benchmark: what was measured, and what is demanded of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """A number, and the number that it must stay below or reach, if any."""

    what: str
    """What was measured, on what."""
    value: float
    unit: str = ""
    """"s CPU", "MB"; "x" for a ratio of two numbers of this run."""
    below: float | None = None
    """The demand, None where the number is for information."""
    above: float | None = None
    """The same the other way round: the number must reach it."""
    beside: str = ""
    """What it is held against."""

    @property
    def holds(self) -> bool:
        """True where nothing is demanded or the demand is met."""
        is_low = self.below is None or self.value < self.below
        return is_low and (self.above is None or self.value >= self.above)

    @property
    def verdict(self) -> str:
        """The demand in words, and whether it is met."""
        if self.below is None and self.above is None:
            return ""
        demand = f"< {self.below:g}" if self.above is None else f">= {self.above:.3g}"
        return f"{demand} {'holds' if self.holds else 'FAILS'}"


def least(measure: Callable[[], float], times: int = 3) -> float:
    """Return the least of several measurements: what else runs on the machine only ever adds."""
    return min(measure() for _ in range(times))
