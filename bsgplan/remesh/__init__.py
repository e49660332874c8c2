"""Parts of existing meshes replaced, far fewer irregular vertices in them: NOUN Replacement, VERB replace."""

from .replace import replace
from .replacement import Replacement

__all__ = ["Replacement", "replace"]
