"""The noun Mesh, and the clean-up that makes one from raw arrays."""

from .cleanup import clean
from .mesh import Mesh

__all__ = ["Mesh", "clean"]
