"""The robot half of Layer 2: keyframes, boundaries, the link, failure policies.

Standard library and ``opentrons`` only; see ``docs/reference/keyframes.md``.
"""

from .link import SidecarLink
from .planner import Planner
from .recovering import TipKnowledge
from .spare_tips import TipForecast
from .summary import WatchSummary
from .tracker import Tracker
from .watch import Watcher

__all__ = [
    "Planner",
    "SidecarLink",
    "TipForecast",
    "TipKnowledge",
    "Tracker",
    "WatchSummary",
    "Watcher",
]
