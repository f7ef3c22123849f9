"""The words that every room shares, as frozen dataclasses. Standard library only.

Whatever crosses from one room to another, or from the robot to the workstation, is one of
these. They carry no behaviour beyond naming themselves and turning into plain JSON.
"""

from typing import TYPE_CHECKING

from ..lazy import door

if TYPE_CHECKING:
    from .addresses import without_secrets
    from .channels import is_row, named_wells, unobserved, with_places
    from .findings import Finding, Remark, Severity, Site, Undecided, VerdictWord
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
        FailureType,
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
        "ChannelOutcome": "trajectories",
        "ChannelVerdict": "trajectories",
        "Citation": "opinions",
        "DeckItem": "opinions",
        "Dossier": "opinions",
        "FailureType": "trajectories",
        "Finding": "findings",
        "Gate": "trajectories",
        "Keyframe": "trajectories",
        "KeyframeKind": "trajectories",
        "Opinion": "opinions",
        "Outcome": "trajectories",
        "Remark": "findings",
        "RoleLine": "opinions",
        "RoleProposal": "opinions",
        "Route": "trajectories",
        "RuleAnswer": "opinions",
        "RuleBrief": "opinions",
        "Severity": "findings",
        "Site": "findings",
        "Undecided": "findings",
        "Verdict": "trajectories",
        "VerdictWord": "findings",
        "WellRef": "wells",
        "counted": "sentences",
        "nearest": "sentences",
        "csv_cell": "sentences",
        "from_csv_cell": "sentences",
        "from_json": "wire",
        "is_known": "opinions",
        "is_row": "channels",
        "named_wells": "channels",
        "no_commands": "sentences",
        "one_line": "sentences",
        "printable": "sentences",
        "to_json": "wire",
        "unobserved": "channels",
        "with_places": "channels",
        "without_secrets": "addresses",
    },
)

__all__ = [
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
    "is_known",
    "is_row",
    "named_wells",
    "nearest",
    "no_commands",
    "one_line",
    "printable",
    "to_json",
    "unobserved",
    "with_places",
    "without_secrets",
]
