"""The nouns Pattern, Shape, Spacing, Bounds and Realised, and the verbs that make them: no mesh in here."""

from .bounds import Bounds, bounds, fan_angle, fan_edge_ratio, fan_quality, valences_of_quality
from .pattern import Pattern
from .realise import Realised, realise, relative_irregularity, vertex_irregularity_of_fronts
from .shape import Shape
from .spacing import Spacing, best_spacing, paper_spacing
from .strip import strip_triangles
from .subdivision import subdivide
from .width import best_width, strip_quality, width_interval

__all__ = [
    "Bounds",
    "Pattern",
    "Realised",
    "Shape",
    "Spacing",
    "best_spacing",
    "best_width",
    "bounds",
    "fan_angle",
    "fan_edge_ratio",
    "fan_quality",
    "paper_spacing",
    "realise",
    "relative_irregularity",
    "strip_quality",
    "strip_triangles",
    "subdivide",
    "valences_of_quality",
    "vertex_irregularity_of_fronts",
    "width_interval",
]
