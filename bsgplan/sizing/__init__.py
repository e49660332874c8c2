"""The noun SizeField and the verbs that make one."""

from .field import SizeField
from .measure import named_size_field, size_field

__all__ = ["SizeField", "named_size_field", "size_field"]
