"""Rows of a table of measures: name, value and unit as text, and how numbers look in them."""

from __future__ import annotations

from collections.abc import Mapping

from ..mesh.irregularity import Irregularity

Row = tuple[str, str, str]
"""Name, value and unit of one measure, as text."""


def plain_irregularity(irregularity: Irregularity) -> dict[str, int]:
    """Return both parts of an irregularity and their sum."""
    return {
        "positive": irregularity.positive,
        "negative": irregularity.negative,
        "total": irregularity.total,
    }


def shown_irregularity(values: Mapping[str, int]) -> str:
    """Return both parts and their sum as text."""
    return f"{values['positive']:+d} {values['negative']:+d} = {values['total']}"


def shown_share(part: int, whole: int) -> str:
    """Return a part of a whole, and in percent."""
    return f"{part} of {whole}" + (f" ({100 * part / whole:.0f} %)" if whole else "")
