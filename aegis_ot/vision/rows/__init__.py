"""Several tips in one frame: found as a row, named by their nozzles, judged one by one."""

from .analyser import ChannelAnalyser
from .finder import FirstChannel

__all__ = ["ChannelAnalyser", "FirstChannel"]
