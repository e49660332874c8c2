"""Block layouts of whole domains: NOUNS BlockLayout and BlockGrid, VERB lay_out."""

from .lay_out import lay_out
from .layout import BlockGrid, BlockLayout

__all__ = ["BlockGrid", "BlockLayout", "lay_out"]
