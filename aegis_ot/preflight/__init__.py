"""Layer 1: a protocol is rehearsed, read as a trace, and judged by the rules. Robot side.

Each step is a room of its own, and imports run down this list only (a contract in
``pyproject.toml``)::

    asking      the robot asks the sidecar's model
    live_judging  the run beside its rehearsal
    opinion     what a model gets to know, what it answers, what of that counts
    checking    a protocol, or what a guard recorded, to a report
    database    the rule files: loaded, validated, their schema
    judging     a recording to a reading and a verdict: cases, findings, waivers
    checks      predicates over trace and roles, of which rules are made
    roles       what each well is for, and which assay it is
    evidence    all that speaks for the role of a well: names, plate maps, labels
    trace       the recording read as tips, wells and liquids
    source      what the protocol's text says as Python
    rules       what a rule file may say
    rehearsal   the protocol run in the simulator, and recorded
"""

from typing import TYPE_CHECKING

from ..lazy import door

if TYPE_CHECKING:
    from .check_protocol import check_script
    from .database import load_database
    from .judging import Options, Reading, Report, judge
    from .rehearsal import Script, record
    from .rules import Database

__getattr__ = door(
    __name__,
    {
        "Database": "rules",
        "Options": "judging",
        "Reading": "judging",
        "Report": "judging",
        "Script": "rehearsal",
        "check_script": "check_protocol",
        "judge": "judging",
        "load_database": "database",
        "record": "rehearsal",
    },
)

__all__ = [
    "Database",
    "Options",
    "Reading",
    "Report",
    "Script",
    "check_script",
    "judge",
    "load_database",
    "record",
]
