"""Array aliases, and the one way to make an array read-only."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array

Floats: TypeAlias = NDArray[np.float64]
Ints: TypeAlias = NDArray[np.int64]
Bools: TypeAlias = NDArray[np.bool_]
Wholes: TypeAlias = NDArray[np.integer[Any]]
"""Whole numbers of any length: where a mesh allows, short ones."""
Value = TypeVar("Value", bound=np.generic)

RELATIVE_TOLERANCE = 1e-12
"""Two lengths of one mesh that differ by less than this share of its extent are equal: a few hundred
roundings of double precision, far below any edge that a mesh generator makes."""


def frozen_floats(values: Any) -> Floats:
    """Return values as a read-only array of float64, copied only where needed.

    >>> frozen_floats([1, 2]).flags.writeable
    False
    """
    array = np.ascontiguousarray(values, dtype=np.float64)
    return _frozen(array, values)


def frozen_ints(values: Any) -> Ints:
    """Return values as a read-only array of int64, copied only where needed.

    >>> frozen_ints([[0, 1, 2]]).shape
    (1, 3)
    """
    array = np.ascontiguousarray(values, dtype=np.int64)
    return _frozen(array, values)


def grouped(index: Ints, n: int) -> tuple[Ints, Ints]:
    """Return the stable order of indices 0 .. n - 1, and the start of each in it, (n + 1,); linear in time.

    >>> [part.tolist() for part in grouped(np.array([1, 0, 1]), 2)]
    [[1, 0, 2], [0, 1, 3]]
    """
    index = index.ravel()
    order, _, start = by_row(index, np.arange(len(index)), np.empty(len(index), dtype=np.int8), n)
    return order.astype(np.int64), start.astype(np.int64)


def by_row(
    rows: Wholes, columns: Wholes, values: NDArray[Value], n: int
) -> tuple[Wholes, NDArray[Value], Wholes]:
    """Return the columns and values of entries by their rows 0 .. n - 1, and where each row begins, (n + 1,).

    Entries of one row keep their order; linear in time. Whole numbers are short where they can be.

    >>> columns, values, start = by_row(np.array([1, 0, 1]), np.array([5, 3, 4]), np.ones(3), 2)
    >>> columns.tolist(), start.tolist()
    ([3, 5, 4], [0, 1, 3])
    """
    entries = coo_array((values, (rows, columns)), shape=(n, int(columns.max(initial=0)) + 1))
    entries.has_canonical_format = True  # neither sorted further nor summed
    table = entries.tocsr()
    return table.indices, table.data, table.indptr


def short_type(largest: int) -> type[np.int32 | np.int64]:
    """Return the shortest type of whole numbers up to the largest that lists of links are made of.

    >>> short_type(10**9).__name__, short_type(10**10).__name__
    ('int32', 'int64')
    """
    return np.int32 if largest < np.iinfo(np.int32).max else np.int64


def joined(parts: Sequence[Wholes], largest: int) -> Wholes:
    """Return whole numbers up to the largest one part after the other, of the shortest type.

    >>> joined([np.array([1, 2]), np.array([3])], 3).dtype.name
    'int32'
    """
    result: Wholes = np.concatenate(parts, dtype=short_type(largest), casting="same_kind")
    return result


def sums_by(index: Ints, values: Floats, n: int) -> Floats:
    """Return the sum of the values with each index 0 .. n - 1, (n,); both flattened alike.

    >>> sums_by(np.array([0, 2, 2]), np.array([1.0, 2.0, 3.0]), 3)
    array([1., 0., 5.])
    """
    return np.asarray(np.bincount(index.ravel(), values.ravel(), n), dtype=np.float64)


def _frozen(array: NDArray[Any], source: Any) -> NDArray[Any]:
    if array is source and array.flags.writeable:
        array = array.view()  # the caller keeps a writable array; ours is a read-only view of it
    array.flags.writeable = False
    return array
