"""Parts of existing meshes replaced, far fewer irregular vertices in them: NOUN Replacement, VERB replace."""

from .replace import Replacement, replace

__all__ = ["Replacement", "replace"]
