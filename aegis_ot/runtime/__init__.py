"""The robot half of Layer 2: keyframes, boundaries, the link, failure policies.

Standard library and ``opentrons`` only; see ``docs/reference/keyframes.md``.
"""

from .descriptions import about_layer1
from .link import SidecarLink
from .objecting import Bystander, Hands
from .planner import Planner
from .recovering import TipKnowledge
from .rejection import tell_of_rejection
from .spare_tips import TipForecast
from .summary import WatchSummary
from .tracker import Tracker
from .watch import Watcher

__all__ = [
    "Bystander",
    "Hands",
    "Planner",
    "SidecarLink",
    "TipForecast",
    "TipKnowledge",
    "Tracker",
    "WatchSummary",
    "Watcher",
    "about_layer1",
    "tell_of_rejection",
]
