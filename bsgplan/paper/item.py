"""The nouns Item and Section: a number of ours beside the paper's, and the numbers of one table or figure.

Invariant: every printed number of a section has one of ours beside it, or the section says why not.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from .printed import REASONS, printed, row_heading

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Number: TypeAlias = int | float | str | None

ROUNDING = 1e-9
"""Slack on half a unit of the last printed digit: rounding of doubles, so a tie counts as equal."""


@dataclass(frozen=True)
class Item:
    """One number of the paper, the correct one and ours."""

    section: str
    row: str
    column: str
    paper: str | None
    """As the paper prints it."""
    correct: str | None
    """With the digits that ours must show; None where nothing is to be compared."""
    ours: Number
    """As computed; None where it was not."""
    reason: str = ""
    """Why the correct number is not the paper's."""

    @property
    def name(self) -> str:
        """Row and column in words; the column "paper" goes without saying."""
        row = f"{row_heading(self.section)} {self.row}" if self.row.isdigit() else self.row
        return row if self.column == "paper" else f"{row}, {self.column}"

    @property
    def agrees(self) -> bool | None:
        """True where ours shows the correct digits; None where there is nothing to compare."""
        return None if self.correct is None or self.ours is None else shows(self.ours, self.correct)

    @property
    def is_slip(self) -> bool:
        """True where the correct number is not what the paper prints."""
        if self.paper is None or self.correct is None:
            return False
        number = _number(self.correct)
        return not shows(self.correct if number is None else number, self.paper)

    @property
    def shown(self) -> str:
        """Ours as text: with one digit more than the printed number, whole numbers whole."""
        if self.ours is None:
            return "-"
        if not isinstance(self.ours, float):
            return str(self.ours)
        digits = _decimals(self.correct or self.paper or "0.00")
        is_whole = digits == 0 and abs(self.ours - round(self.ours)) < ROUNDING
        return f"{self.ours:.{0 if is_whole else digits + 1}f}"

    def document(self) -> dict[str, Any]:
        """Return the item as plain values."""
        return {
            "section": self.section,
            "name": self.name,
            "paper": self.paper,
            "ours": self.ours,
            "correct": self.correct,
            "agrees": self.agrees,
            "is_slip": self.is_slip,
            "reason": self.reason,
        }


@dataclass(frozen=True)
class Section:
    """A table or a figure of the paper."""

    key: str
    """Its name, and that of its picture."""
    title: str
    text: str
    """What is shown, in sentences."""
    items: tuple[Item, ...]
    figure: Callable[[], Figure] | None = None
    """Draws it."""
    skipped: str = ""
    """What was not done, and why."""


def items_of(section: str, ours: Mapping[tuple[str, str], Number]) -> tuple[Item, ...]:
    """Return the items of a section: our numbers by row and column beside those printed.

    Printed numbers without one of ours keep ours None; ours without a printed one follow their row.

    >>> items_of("table_1", {("8", "q"): 0.9473})[15].agrees
    True
    """
    there = printed(section)
    rows = dict.fromkeys(row for row, _ in [*there, *ours])
    places = [place for row in rows for place in dict.fromkeys([*there, *ours]) if place[0] == row]
    return tuple(
        Item(
            section,
            *place,
            paper=there[place].paper if place in there else None,
            correct=there[place].correct if place in there else None,
            ours=ours.get(place),
            reason=REASONS.get((section, *place), ""),
        )
        for place in places
    )


def shows(value: int | float | str, text: str) -> bool:
    """Return whether a value, rounded to the digits of a printed number, is that number.

    A printed number may be a least one, ">= 0.7", or a range, "10 to 11"; words must be the same.

    >>> shows(0.9473, "0.95"), shows(0.9473, "0.94"), shows(0.71, ">= 0.70"), shows(10.4, "10 to 11")
    (True, False, True, True)
    """
    if isinstance(value, str):
        return value == text
    if text.startswith(">= "):
        return value >= float(text[3:]) - ROUNDING
    if " to " in text:
        low, high = map(float, text.split(" to "))
        return low - ROUNDING <= value <= high + ROUNDING
    number = _number(text)
    return number is not None and abs(value - number) <= 0.5 * 10.0 ** -_decimals(text) + ROUNDING


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _decimals(text: str) -> int:
    return len(text.rpartition(".")[2]) if "." in text else 0
