"""What a lab's own recordings teach: recorded runs as trajectories, models fitted on them, and
the smallest volumes that these would catch."""

from .fitting import STORED, fit_model
from .tips import FoundTips, find_tips

__all__ = ["STORED", "FoundTips", "find_tips", "fit_model"]
