"""Reports: plain data first (documents and the noun Table), then text, HTML, rich and pictures of it."""

from .table import Table

__all__ = ["Table"]
