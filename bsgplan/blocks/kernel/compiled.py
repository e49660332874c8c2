"""The one decorator of compiled code: numba, cached on disk where there is a place for a cache."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

Kernel = TypeVar("Kernel", bound=Callable[..., Any])


def compiled(function: Kernel) -> Kernel:
    """Return a function compiled at its first call; a folder that cannot hold the cache is no error."""
    try:
        return cast(Kernel, numba.njit(function, cache=True, nogil=True, error_model="numpy"))
    except RuntimeError:  # no writable folder for the cache
        return cast(Kernel, numba.njit(function, nogil=True, error_model="numpy"))


def is_cached(kernel: Any) -> bool:
    """Return True where a cache of the kernel lies on disk, so that its first call need not compile."""
    folder = getattr(getattr(kernel, "_cache", None), "cache_path", None)
    return folder is not None and any(Path(folder).glob(f"{kernel.__module__.split('.')[-1]}.*.nbi"))
