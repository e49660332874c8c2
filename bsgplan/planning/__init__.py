"""The nouns Plan, RegionPlan and Candidate, and the verb estimate."""

from .candidate import Candidate
from .objective import OBJECTIVES, choose
from .plan import Plan, RegionPlan, check_block_size, estimate

__all__ = ["OBJECTIVES", "Candidate", "Plan", "RegionPlan", "check_block_size", "choose", "estimate"]
