"""Checks of options that are wrong whatever the mesh, each told alike."""

from __future__ import annotations

from math import isfinite

from ..errors import InvalidOption


def check_least(option: str, value: int, least: int, example: str) -> None:
    """Raise InvalidOption for a whole number under the least."""
    if value < least:
        raise InvalidOption(f"{option} {value} is under {least}; give for example {example}")


def check_above(option: str, value: float, bound: float, example: str) -> None:
    """Raise InvalidOption for a number that is not finite and above a bound."""
    if not (isfinite(value) and value > bound):
        raise InvalidOption(f"{option} {value:g} is not above {bound:g}; give for example {example}")
