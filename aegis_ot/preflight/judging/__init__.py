"""From a recording to a verdict: every rule judged, its findings joined, waivers applied."""

from typing import TYPE_CHECKING

from ...lazy import door

if TYPE_CHECKING:
    from .doubts import missing_needs, pasted, spelled
    from .interpretation import Interpretation, uncollected
    from .options import Options
    from .report import Report, RoleEvidence, unanswered, verdict_of
    from .rule_judging import judge
    from .waivers import MODEL, Waived, Waiver, apply_waivers, read_waivers

# A report is shown without what it was made with.
__getattr__ = door(
    __name__,
    {
        "doubts": "missing_needs pasted spelled",
        "interpretation": "Interpretation uncollected",
        "options": "Options",
        "report": "Report RoleEvidence unanswered verdict_of",
        "rule_judging": "judge",
        "waivers": "MODEL Waived Waiver apply_waivers read_waivers",
    },
)

__all__ = [
    "MODEL",
    "Interpretation",
    "Options",
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
