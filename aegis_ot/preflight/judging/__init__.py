"""From a recording to a verdict: every rule judged, its findings joined, waivers applied."""

from .judging import judge
from .options import Options
from .report import Report, RoleEvidence, verdict_of
from .waivers import Waived, Waiver, apply_waivers, first_statement, read_waivers, stale

__all__ = [
    "Options",
    "Report",
    "RoleEvidence",
    "Waived",
    "Waiver",
    "apply_waivers",
    "first_statement",
    "judge",
    "read_waivers",
    "stale",
    "verdict_of",
]
