"""Tables of numbers as text, a bounded number of lines at a time; floats to the last bit."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

import numpy as np

from ..arrays import Floats, Ints

LINES = 20_000
"""Lines made at a time."""


def table_lines(line: str, *columns: Floats | Ints) -> Iterator[str]:
    r"""Yield text with one line a row; `line` has a %d or %r for each column, (n,) or (n, k), in their order.

    >>> import numpy as np
    >>> "".join(table_lines("3 %d %d\n", np.array([0, 1]), np.array([7, 8])))
    '3 0 7\n3 1 8\n'
    """
    single = [part for column in columns for part in (column.T if column.ndim == 2 else [column])]
    for start in range(0, len(single[0]) if single else 0, LINES):
        parts = [column[start : start + LINES].tolist() for column in single]
        yield line * len(parts[0]) % tuple(chain.from_iterable(zip(*parts, strict=True)))


def counting(n: int, first: int = 1) -> Ints:
    """Return the numbers of n rows from the first on, (n,)."""
    return np.arange(first, first + n, dtype=np.int64)
