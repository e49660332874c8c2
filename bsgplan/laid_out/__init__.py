"""Layouts with what their file holds: NOUNS LaidOut, Features; VERBS find_features, lay_out_file, export."""

from .export import FORMATS, export
from .features import Features, find_features
from .laid_out import LaidOut
from .paired import lay_out_file, lay_out_with
from .saved import arrays_of, load_layout

__all__ = [
    "FORMATS",
    "Features",
    "LaidOut",
    "arrays_of",
    "export",
    "find_features",
    "lay_out_file",
    "lay_out_with",
    "load_layout",
]
