"""Numbers before nouns, as messages and tables tell them."""

from __future__ import annotations


def counted(n: int, noun: str, plural: str = "") -> str:
    """Return a number and its noun, in the plural but for one.

    >>> counted(1, "block"), counted(3, "block"), counted(2, "vertex", "vertices")
    ('1 block', '3 blocks', '2 vertices')
    """
    return f"{n} {noun}" if n == 1 else f"{n} {plural or noun + 's'}"
