"""Let the allocator keep what large arrays free, for the next large arrays.

By default the C library maps every large array afresh and hands its pages back when it is freed; with dozens
of arrays one after the other the kernel then zeroes the same pages again and again, a tenth of a plan's time.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

TRIM_THRESHOLD, TOP_PAD, MMAP_THRESHOLD, MMAP_MAX = -1, -2, -3, -4
"""Parameters of glibc's mallopt."""

KEPT = {MMAP_MAX: 0, TRIM_THRESHOLD: 2**31 - 1, TOP_PAD: 2**26}
"""Nothing is mapped, nothing handed back, and memory is asked for in steps of 64 MB."""

USUAL = {MMAP_MAX: 2**16, MMAP_THRESHOLD: 2**25, TRIM_THRESHOLD: 2**26, TOP_PAD: 2**17}
"""Where glibc's own moving thresholds end in a program with large arrays."""


@contextmanager
def reused() -> Iterator[None]:
    """Keep freed memory inside, hand it back at the end; does nothing where the C library is not glibc.

    Also a decorator. Inside another one it does nothing.
    """
    if _depth or (library := _glibc()) is None:
        yield
        return
    _depth.append(True)
    _set(library, KEPT)
    try:
        yield
    finally:
        _set(library, USUAL)
        library.malloc_trim(0)
        _depth.pop()


_depth: list[bool] = []
"""Holds an entry inside `reused`."""


@cache
def _glibc() -> ctypes.CDLL | None:
    try:
        library = ctypes.CDLL(None)
    except (OSError, TypeError):
        return None
    return library if hasattr(library, "mallopt") and hasattr(library, "malloc_trim") else None


def _set(library: ctypes.CDLL, options: dict[int, int]) -> None:
    for option, value in options.items():
        library.mallopt(option, value)
