"""`bsgplan patterns`: the patterns of a transition worth choosing from."""

from __future__ import annotations

import sys
from math import isqrt
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from ..errors import InvalidOption, NoPatternFits
from .whole import Whole

if TYPE_CHECKING:
    from ..patterns import Pattern


def patterns(
    ends: str,
    /,
    *,
    length: float | None = None,
    layers: float | None = None,
    tris_per_block: Whole = 1,
    least_quality: float = 0.3,
    closed: Annotated[bool, Parameter(negative=())] = False,
    most: Whole = 16,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Find the best patterns of a transition: no other has fewer blocks, less iota+ and better quality.

    Parameters
    ----------
    ends
        Elements on the first and on the last front, as 7:1.
    length
        Length of the transition in heights, the length of a front; default: each pattern's best.
    layers
        Instead: its layers of elements, taken as equilateral, their counts linear from end to end.
    tris_per_block
        Triangles per block, a square s x s: the ends are divided by s.
    least_quality
        Patterns whose worst block has a mean ratio under this are left out.
    closed
        Fronts are closed rings; lengths are then in circumferences.
    most
        Rows of the table at most.
    json
        Write one JSON document, with all patterns, instead of the table.
    """
    from ..patterns import Pattern, length_of_layers, search
    from ..planning import check_block_size
    from ..report.patterns_table import patterns_document, patterns_table
    from ..result import dumps
    from .output import show

    check_block_size(tris_per_block)
    if length is not None and layers is not None:
        raise InvalidOption("--layers gives the length too; give one of --length and --layers")
    if most < 1:
        raise InvalidOption(f"--most {most} is under 1; give the rows you want to see")
    elements = Pattern.parse(ends)
    if elements.n_fronts != 2:
        raise InvalidOption(f"{ends!r} has {elements.n_fronts} counts; give those of both ends, as 7:1")
    if layers is not None:
        length = length_of_layers(elements.counts[0], elements.counts[1], layers)
    first, last = _block_counts(elements, isqrt(tris_per_block), 3 if closed else 1)
    found = search(first, last, length=length, least_quality=least_quality, is_closed=closed)
    document = patterns_document(
        found, asked=str(elements), length=length, layers=layers, tris_per_block=tris_per_block
    )
    if json:
        sys.stdout.write(dumps(document))
    else:
        show([patterns_table(document, most=most)])


def _block_counts(elements: Pattern, side: int, fewest: int) -> tuple[int, int]:
    """Return the blocks along both fronts, rounded; raises NoPatternFits where a front carries too few."""
    first, last = (round(count / side) for count in elements.counts)
    if side > 1 and min(first, last) < fewest:
        raise NoPatternFits(
            f"a front of {min(elements.counts)} elements carries {min(first, last)} blocks of side {side}, "
            f"it needs {fewest}; choose smaller blocks"
        )
    return first, last
