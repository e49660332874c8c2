"""The type of options that are whole numbers: 2.5 is a slip, not 2."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

from cyclopts import Parameter, Token


def whole_number(_: Any, tokens: Sequence[Token]) -> int:
    """Return the whole number of an option's word; raises ValueError for any other word.

    >>> whole_number(int, [Token(value="16")])
    16
    """
    word = tokens[0].value
    try:
        return int(word)
    except ValueError:
        raise ValueError(f"{word!r} is no whole number") from None


Whole = Annotated[int, Parameter(converter=whole_number)]
"""A whole number, written as one."""
