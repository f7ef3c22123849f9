"""A dry run: both layers at work on one machine, with no robot, no camera and no key.

Door: :func:`dry_run`, which gives a :class:`DryRun`.
"""

from .runner import TRUSTING, DryRunProgress, DryRunSettings, dry_run
from .scripts import read_script
from .summary import DryRun, WellRow

__all__ = [
    "TRUSTING",
    "DryRun",
    "DryRunProgress",
    "DryRunSettings",
    "WellRow",
    "dry_run",
    "read_script",
]
