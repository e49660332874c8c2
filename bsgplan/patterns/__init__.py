"""The nouns Pattern, Shape, Spacing, Bounds and Realised, and the verbs that make them: no mesh in here."""

from .bounds import Bounds, bounds, fan_angle, fan_edge_ratio, fan_quality, valences_of_quality
from .length import BestLength, best_length, length_of_layers
from .moving import move_vertices
from .pattern import Pattern
from .realise import Realised, realise, relative_irregularity, vertex_irregularity_of_fronts
from .search import Found, is_exact, search, shortlist
from .shape import Shape
from .spacing import Spacing, best_spacing, best_spacings, paper_spacing
from .strip import strip_triangles
from .subdivision import subdivide
from .width import best_width, strip_quality, width_interval

__all__ = [
    "BestLength",
    "Bounds",
    "Found",
    "Pattern",
    "Realised",
    "Shape",
    "Spacing",
    "best_length",
    "best_spacing",
    "best_spacings",
    "best_width",
    "bounds",
    "fan_angle",
    "fan_edge_ratio",
    "fan_quality",
    "is_exact",
    "length_of_layers",
    "move_vertices",
    "paper_spacing",
    "realise",
    "relative_irregularity",
    "search",
    "shortlist",
    "strip_quality",
    "strip_triangles",
    "subdivide",
    "valences_of_quality",
    "vertex_irregularity_of_fronts",
    "width_interval",
]
