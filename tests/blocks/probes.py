"""Inner kernels that tests call from Python: compiled once more, with an entry."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bsgplan.compiled import compiled


def probe(kernel: Any) -> Callable[..., Any]:
    """Return an inner kernel as a function that Python may call."""
    return compiled(kernel.py_func)
