"""The two decorators of compiled code, and the one import of numba: half a second, for those who need it.

One is for what Python calls, the other for what only other compiled code calls.

Neither counts references: a state outlives every call, and no kernel makes an array. An inner function has
no entry from Python and no cache of its own, it lies in those of its callers: that halves the compilation.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
import numpy as np

Kernel = TypeVar("Kernel", bound=Callable[..., Any])

PLAIN: Any = partial(
    cast(Any, numba.njit), nogil=True, error_model="numpy", _nrt=False, no_cfunc_wrapper=True
)
"""The compiler with the options of all kernels."""


def compiled(function: Kernel) -> Kernel:
    """Return a function compiled at its first call; a folder that cannot hold the cache is no error."""
    try:
        return cast(Kernel, PLAIN(function, cache=True))
    except RuntimeError:  # no writable folder for the cache
        return cast(Kernel, PLAIN(function))


def inner(function: Kernel) -> Kernel:
    """Return a function that compiled code calls, and nobody else."""
    return cast(Kernel, PLAIN(function, no_cpython_wrapper=True))


def whole(number: int) -> int:
    """Return a constant to call kernels with: for every value of a bare one they are compiled anew."""
    return cast(int, np.int64(number))


def is_cached(kernel: Any) -> bool:
    """Return True where a cache of the kernel lies on disk, so that its first call need not compile."""
    folder = getattr(getattr(kernel, "_cache", None), "cache_path", None)
    return folder is not None and any(Path(folder).glob(f"{kernel.__module__.split('.')[-1]}.*.nbi"))
