"""What a lab's own recordings teach: recorded runs as trajectories, models fitted on them, and
the smallest volumes that these would catch."""

from .fitting import STORED, fit_model

__all__ = ["STORED", "fit_model"]
