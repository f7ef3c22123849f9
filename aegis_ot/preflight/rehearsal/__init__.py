"""A protocol run in Opentrons' own simulator, and everything that it did written down.

Door: :func:`rehearse` runs a :class:`Script` with listeners; a :class:`Recorder` is one.
"""

from .interruption import interrupted_after, second_clock
from .loading import load
from .parameters import Parameter, declared_parameters, plain_values, undeclared
from .recorder import Record, Recorder, Step
from .recording import Recording, record, recording_of
from .refusals import in_words, line_of
from .rehearsing import Rehearsal, is_rehearsing, play, rehearse
from .script import Script, find_home, find_script

__all__ = [
    "Parameter",
    "Record",
    "Recorder",
    "Recording",
    "Rehearsal",
    "Script",
    "Step",
    "declared_parameters",
    "find_home",
    "find_script",
    "in_words",
    "interrupted_after",
    "is_rehearsing",
    "line_of",
    "load",
    "plain_values",
    "play",
    "record",
    "recording_of",
    "rehearse",
    "second_clock",
    "undeclared",
]
