"""The words that every room shares, as frozen dataclasses. Standard library only.

Whatever crosses from one room to another, or from the robot to the workstation, is one of
these. They carry no behaviour beyond naming themselves and turning into plain JSON.
"""

from typing import TYPE_CHECKING

from ..lazy import door

if TYPE_CHECKING:
    from .addresses import without_secrets
    from .channels import (
        in_few_words,
        is_row,
        named_wells,
        unobserved,
        wells_with_places,
        with_places,
    )
    from .failures import FAILURES, FailureType
    from .findings import NOT_AS_REHEARSED, Finding, Remark, Severity, Site, Undecided, VerdictWord
    from .opinions import (
        Citation,
        DeckItem,
        Dossier,
        Opinion,
        RoleLine,
        RoleProposal,
        RuleAnswer,
        RuleBrief,
        is_known,
    )
    from .sentences import (
        counted,
        csv_cell,
        from_csv_cell,
        nearest,
        no_commands,
        one_line,
        printable,
    )
    from .trajectories import (
        ChannelOutcome,
        ChannelVerdict,
        Gate,
        Keyframe,
        KeyframeKind,
        Outcome,
        Route,
        Verdict,
    )
    from .wells import WellRef
    from .wire import from_json, to_json

__getattr__ = door(
    __name__,
    {
        "addresses": "without_secrets",
        "channels": "in_few_words is_row named_wells unobserved wells_with_places with_places",
        "failures": "FAILURES FailureType",
        "findings": "NOT_AS_REHEARSED Finding Remark Severity Site Undecided VerdictWord",
        "opinions": "Citation DeckItem Dossier Opinion RoleLine RoleProposal RuleAnswer RuleBrief "
        "is_known",
        "sentences": "counted nearest csv_cell from_csv_cell no_commands one_line printable",
        "trajectories": "ChannelOutcome ChannelVerdict Gate Keyframe KeyframeKind Outcome Route "
        "Verdict",
        "wells": "WellRef",
        "wire": "from_json to_json",
    },
)

__all__ = [
    "FAILURES",
    "NOT_AS_REHEARSED",
    "ChannelOutcome",
    "ChannelVerdict",
    "Citation",
    "DeckItem",
    "Dossier",
    "FailureType",
    "Finding",
    "Gate",
    "Keyframe",
    "KeyframeKind",
    "Opinion",
    "Outcome",
    "Remark",
    "RoleLine",
    "RoleProposal",
    "Route",
    "RuleAnswer",
    "RuleBrief",
    "Severity",
    "Site",
    "Undecided",
    "Verdict",
    "VerdictWord",
    "WellRef",
    "counted",
    "csv_cell",
    "from_csv_cell",
    "from_json",
    "in_few_words",
    "is_known",
    "is_row",
    "named_wells",
    "nearest",
    "no_commands",
    "one_line",
    "printable",
    "to_json",
    "unobserved",
    "wells_with_places",
    "with_places",
    "without_secrets",
]
