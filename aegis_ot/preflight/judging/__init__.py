"""From a recording to a verdict: every rule judged, its findings joined, waivers applied."""

from .doubts import missing_needs, pasted, spelled
from .options import Options
from .reading import Reading, uncollected
from .report import Report, RoleEvidence, unanswered, verdict_of
from .rule_judging import judge
from .waivers import MODEL, Waived, Waiver, apply_waivers, read_waivers

__all__ = [
    "MODEL",
    "Options",
    "Reading",
    "Report",
    "RoleEvidence",
    "Waived",
    "Waiver",
    "apply_waivers",
    "judge",
    "missing_needs",
    "pasted",
    "read_waivers",
    "spelled",
    "unanswered",
    "uncollected",
    "verdict_of",
]
