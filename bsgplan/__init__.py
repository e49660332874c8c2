"""bsgplan: the planner for block-structured triangular grids.

The public names are resolved on first use, so that importing the package costs next to nothing.

>>> import bsgplan
>>> bsgplan.Pattern.parse("7:4:1").n_blocks
16
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .io import MeshFile, read, read_lonlat, write
    from .mesh import Mesh
    from .patterns import Pattern, Shape, best_spacing, bounds
    from .pipeline import plan_blocks
    from .planning import Plan, estimate
    from .regions import Regions, find_regions
    from .result import PlannedMesh
    from .sizing import SizeField, named_size_field, size_field

_HOMES = {
    "MeshFile": "io",
    "read": "io",
    "read_lonlat": "io",
    "Mesh": "mesh",
    "Pattern": "patterns",
    "Shape": "patterns",
    "best_spacing": "patterns",
    "bounds": "patterns",
    "plan_blocks": "pipeline",
    "Plan": "planning",
    "PlannedMesh": "result",
    "estimate": "planning",
    "Regions": "regions",
    "find_regions": "regions",
    "SizeField": "sizing",
    "named_size_field": "sizing",
    "size_field": "sizing",
    "write": "io",
}

__all__ = [
    "Mesh",
    "MeshFile",
    "Pattern",
    "Plan",
    "PlannedMesh",
    "Regions",
    "Shape",
    "SizeField",
    "best_spacing",
    "bounds",
    "estimate",
    "find_regions",
    "named_size_field",
    "plan_blocks",
    "read",
    "read_lonlat",
    "size_field",
    "write",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'bsgplan' has no attribute {name!r}")
    return getattr(import_module(f".{_HOMES[name]}", __name__), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
