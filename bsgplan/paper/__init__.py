"""The nouns Item, Section and Report, and the verb reproduce: the paper's tables and figures beside ours."""

from .item import Item, Section
from .report import Report, reproduce
from .write import write_report

__all__ = ["Item", "Report", "Section", "reproduce", "write_report"]
