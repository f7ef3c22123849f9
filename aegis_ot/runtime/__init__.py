"""The robot half of Layer 2: keyframes, boundaries, the link, failure policies.

Standard library and ``opentrons`` only; see ``docs/reference/keyframes.md``.
"""

from .link import SidecarLink
from .summary import WatchSummary
from .tracker import Tracker
from .watch import Watcher

__all__ = ["SidecarLink", "Tracker", "WatchSummary", "Watcher"]
