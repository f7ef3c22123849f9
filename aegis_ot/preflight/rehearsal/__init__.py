"""A protocol run in Opentrons' own simulator, and everything that it did written down.

Door: :func:`rehearse` runs a :class:`Script` with listeners; a :class:`Recorder` is one.
"""

from .loading import line_of, load
from .recorder import Record, Recorder, Step
from .recording import Recording, record
from .rehearsing import Rehearsal, is_rehearsing, play, rehearse
from .script import Script, find_script

__all__ = [
    "Record",
    "Recorder",
    "Recording",
    "Rehearsal",
    "Script",
    "Step",
    "find_script",
    "is_rehearsing",
    "line_of",
    "load",
    "play",
    "record",
    "rehearse",
]
