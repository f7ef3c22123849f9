"""Layer 1 on the workstation: many protocol files, a project's configuration, a baseline.

Doors: :func:`check_files`, and :func:`check_projects` where protocols are judged in different ways;
both give a :class:`CheckRun`.
"""

from typing import TYPE_CHECKING

from ..lazy import door

if TYPE_CHECKING:
    from .configuration import Configuration, configurations_of
    from .projects import Project, check_files, check_projects
    from .rehearser import Rehearser, TaskFailed
    from .result import CheckedProtocol, CheckRun, Exploration, Problem
    from .run import CheckSettings
    from .with_model import Asking

__getattr__ = door(
    __name__,
    {
        "configuration": "Configuration configurations_of",
        "with_model": "Asking",
        "projects": "Project check_files check_projects",
        "rehearser": "Rehearser TaskFailed",
        "result": "CheckRun CheckedProtocol Exploration Problem",
        "run": "CheckSettings",
    },
)

__all__ = [
    "Asking",
    "CheckRun",
    "CheckSettings",
    "CheckedProtocol",
    "Configuration",
    "Exploration",
    "Problem",
    "Project",
    "Rehearser",
    "TaskFailed",
    "check_files",
    "check_projects",
    "configurations_of",
]
