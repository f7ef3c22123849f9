"""A rehearsal on record: all that the judgement of a protocol starts from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ...instrumentation import LabwareInfo, NameBinding
from .recorder import Record, Recorder
from .rehearsing import Rehearsal, rehearse
from .script import Script


@dataclass(frozen=True)
class Recording:
    """What a rehearsal yields.

    Attributes:
        file: Name of the protocol file.
        text: Its source.
        log: Steps and events, from a :class:`Recorder`.
        labware: Facts of each labware, by key.
        names: Names that held wells.
        parameters: The numbers and texts that its runtime parameters had.
    """

    file: str
    text: str
    log: Sequence[Record]
    labware: Mapping[str, LabwareInfo]
    names: Sequence[NameBinding] = ()
    parameters: Mapping[str, int | float | str] = field(default_factory=dict)


def record(script: Script, timeout_s: float = 120.0) -> Recording:
    """Rehearse a protocol.

    Raises:
        RehearsalError: It cannot be rehearsed.
    """
    recorder = Recorder()
    rehearsal = rehearse(script, [recorder], timeout_s=timeout_s)
    return recording_of(script, recorder, rehearsal)


def recording_of(script: Script, recorder: Recorder, rehearsal: Rehearsal) -> Recording:
    """What ``recorder`` heard of a rehearsal, with what the rehearsal yields."""
    return Recording(
        script.file_name,
        script.text,
        recorder.log,
        rehearsal.labware,
        rehearsal.names,
        rehearsal.parameters,
    )
