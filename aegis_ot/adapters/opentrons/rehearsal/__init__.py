"""A protocol run in Opentrons' own simulator, and everything that it did written down.

Door: :func:`record` runs a :class:`Script`, with further listeners if there are any.
"""

from typing import TYPE_CHECKING

from ....lazy import door

if TYPE_CHECKING:
    from .interruption import interrupted_after, second_clock
    from .loading import load
    from .parameters import Parameter, declared_parameters, plain_values, undeclared
    from .recording import Record, Recorder, Recording
    from .refusals import in_words, line_of
    from .rehearsing import play, record, rehearsal_under_way
    from .run_plan import Comparison, RunPlan
    from .script import Script, find_home, find_script

# Who sends a script to be rehearsed does not rehearse.
__getattr__ = door(
    __name__,
    {
        "interruption": "interrupted_after second_clock",
        "loading": "load",
        "parameters": "Parameter declared_parameters plain_values undeclared",
        "recording": "Record Recorder Recording",
        "refusals": "in_words line_of",
        "rehearsing": "play record rehearsal_under_way",
        "run_plan": "Comparison RunPlan",
        "script": "Script find_home find_script",
    },
)

__all__ = [
    "Comparison",
    "Parameter",
    "Record",
    "Recorder",
    "Recording",
    "RunPlan",
    "Script",
    "declared_parameters",
    "find_home",
    "find_script",
    "in_words",
    "interrupted_after",
    "line_of",
    "load",
    "plain_values",
    "play",
    "record",
    "rehearsal_under_way",
    "second_clock",
    "undeclared",
]
