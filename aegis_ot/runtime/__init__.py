"""The robot half of Layer 2: keyframes, boundaries, the link, failure policies.

Standard library and ``opentrons`` only; see ``docs/reference/keyframes.md``.
"""

from .descriptions import about_layer1
from .objecting import Bystander, RunControl
from .planner import Planner
from .recovering import TipKnowledge
from .rejection import tell_of_rejection
from .sidecar_client import SidecarClient
from .spare_tips import TipForecast
from .tracker import Tracker
from .watch import Watcher

__all__ = [
    "Bystander",
    "Planner",
    "RunControl",
    "SidecarClient",
    "TipForecast",
    "TipKnowledge",
    "Tracker",
    "Watcher",
    "about_layer1",
    "tell_of_rejection",
]
