"""The search of patterns: each transition's CPU seconds over what it may take."""

from __future__ import annotations

from collections.abc import Iterator

from bsgplan.patterns import length_of_layers, search

from .cost import cpu_of
from .row import Row, least

TITLE = "Search"

TRANSITIONS = (
    ("28:4 on 9.5 layers, 16 a block", 7, 1, length_of_layers(28, 4, 9.5), 0.2),
    ("128:1 over 1 height", 128, 1, 1.0, 3.0),
    ("128:1, each at its best length", 128, 1, None, 3.0),
    ("40:10 over 2 heights", 40, 10, 2.0, 3.0),
    ("16:1 over 2 heights, exact", 16, 1, 2.0, None),
    ("16:1 over 32 heights, exact", 16, 1, 32.0, None),
)
"""What is searched, its counts, its length in heights, and the CPU seconds that it may take."""


def rows() -> Iterator[Row]:
    """Measure each search, and how much of its limit that is."""
    search(4, 1)  # imports are no part of it
    for what, fine, coarse, length, limit in TRANSITIONS:
        seconds = least(lambda f=fine, c=coarse, h=length: cpu_of(lambda: search(f, c, length=h))[1])
        yield Row(what, seconds, "s CPU")
        if limit is not None:
            yield Row(f"{what}: share of {limit:g} s CPU", seconds / limit, "x", below=1)
