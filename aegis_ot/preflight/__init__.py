"""Layer 1: a protocol is rehearsed, read as a trace, and judged by the rules. Robot side.

Each step is a room of its own, and imports run down this list only (a contract in
``pyproject.toml``)::

    asking      the robot asks the sidecar's model
    live_judging  the run beside its rehearsal
    opinion     what a model gets to know, what it answers, what of that counts
    check_protocol  a protocol, or what a guard recorded, to a report
    judging     a recording to a reading and a verdict: cases, findings, waivers
    rule_set    the rules in force: the shipped ones, and a laboratory's own
    checks      predicates over trace and roles, of which rules are made
    roles       what each well is for, and which assay it is
    evidence    all that speaks for the role of a well: names, plate maps, labels
    trace       the recording read as tips, wells and liquids
    source      what the protocol's text says as Python
    rules       what a rule file may say

The recording itself is made in :mod:`aegis_ot.adapters.opentrons.rehearsal`.
"""

from typing import TYPE_CHECKING

from ..lazy import door

if TYPE_CHECKING:
    from ..adapters.opentrons.rehearsal import Script, record
    from .check_protocol import check_script
    from .judging import Interpretation, Options, Report, judge
    from .rule_set import RuleSet, load_rules

__getattr__ = door(
    __name__,
    {
        ".adapters.opentrons.rehearsal": "Script record",
        "check_protocol": "check_script",
        "judging": "Options Interpretation Report judge",
        "rule_set": "RuleSet load_rules",
    },
)

__all__ = [
    "Interpretation",
    "Options",
    "Report",
    "RuleSet",
    "Script",
    "check_script",
    "judge",
    "load_rules",
    "record",
]
