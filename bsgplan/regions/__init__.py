"""The nouns Region and Regions, and the verbs that find them in a size field."""

from .measure import find_regions, measure_regions
from .profile import Profile
from .region import Region, Regions

__all__ = ["Profile", "Region", "Regions", "find_regions", "measure_regions"]
