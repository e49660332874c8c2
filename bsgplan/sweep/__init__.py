"""The noun Job and the verb sweep: many meshes at many block sizes, one row of a CSV file each."""

from .job import Job
from .sweeping import sweep

__all__ = ["Job", "sweep"]
