"""Layer 1 on the workstation: many protocol files, a project's configuration, a baseline.

Door: :func:`check_files`, which gives a :class:`CheckRun`.
"""

from .configuration import Configuration, find_configuration
from .modelled import Asking
from .rehearser import Rehearser, TaskFailed
from .result import Broken, CheckedProtocol, CheckRun, Exploration, Problem
from .run import CheckSettings, check_files

__all__ = [
    "Asking",
    "Broken",
    "CheckRun",
    "CheckSettings",
    "CheckedProtocol",
    "Configuration",
    "Exploration",
    "Problem",
    "Rehearser",
    "TaskFailed",
    "check_files",
    "find_configuration",
]
