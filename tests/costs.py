"""What a call costs: CPU seconds and bytes at its peak, and the bounds of both for hostile files."""

from __future__ import annotations

import time
import tracemalloc
from collections.abc import Callable
from typing import TypeVar

from bsgplan.errors import BsgplanError

Found = TypeVar("Found")

MOST_BYTES = 48 << 20
"""Memory that reading a hostile file of a few megabytes may take: buffers, never what a header claims."""
MOST_SECONDS = 5.0
"""CPU that it may take, many times what most do."""


def seconds(call: Callable[[], object]) -> float:
    """Return the least CPU time of three runs."""
    costs = []
    for _ in range(3):
        start = time.process_time()
        call()
        costs.append(time.process_time() - start)
    return min(costs)


def with_peak(call: Callable[[], Found]) -> tuple[Found, int]:
    """Return what a call returns, and the bytes at its peak."""
    tracemalloc.start()
    try:
        return call(), tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def read_or_refused(read: Callable[[], Found]) -> tuple[Found | None, str]:
    """Return what is read of a hostile file, or None and the message that refuses it; within the bounds."""

    def attempt() -> tuple[Found | None, str]:
        try:
            return read(), ""
        except BsgplanError as error:
            return None, str(error)

    start = time.process_time()
    answer, peak = with_peak(attempt)
    assert time.process_time() - start < MOST_SECONDS
    assert peak < MOST_BYTES
    return answer
