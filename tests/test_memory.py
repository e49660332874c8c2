"""Freed memory is kept inside `reused`, and only there."""

from __future__ import annotations

import platform
import resource

import numpy as np
import pytest

from bsgplan import memory
from bsgplan.memory import reused

HAS_GLIBC = platform.libc_ver()[0] == "glibc"
LARGE = 5_000_000
"""Numbers in an array of 40 MB: over every threshold of the C library's own."""


def faults() -> int:
    """Return the pages that the kernel has had to give so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt


def faults_of_an_array() -> int:
    before = faults()
    np.ones(LARGE)
    return faults() - before


@pytest.mark.skipif(not HAS_GLIBC, reason="only glibc is told")
def test_an_array_takes_the_place_of_the_last_one() -> None:
    with reused():
        np.ones(LARGE)
        assert faults_of_an_array() < 10
    assert faults_of_an_array() > 10


def test_nested_and_after_an_error_all_is_as_before() -> None:
    @reused()
    def fails() -> None:
        with reused():
            pass
        raise ValueError("as asked")

    for _ in range(2):
        with pytest.raises(ValueError, match="as asked"):
            fails()
        assert not memory._depth


def test_elsewhere_nothing_happens(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "_glibc", lambda: None)
    with reused():
        assert np.ones(3).sum() == 3
