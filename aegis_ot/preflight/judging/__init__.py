"""From a recording to a verdict: every rule judged, its findings joined, waivers applied."""

from .doubts import spelled, unnamed_wells
from .judging import judge
from .options import Options
from .reading import Reading, read_recording
from .report import Report, RoleEvidence, verdict_of
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
    "read_recording",
    "read_waivers",
    "spelled",
    "unnamed_wells",
    "verdict_of",
]
