"""A rehearsal on record: all that the judgement of a protocol starts from.

An :class:`Operation` carries the instrument core it came from; a recorder must not keep that
alive, so each operation is copied into a :class:`Step`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, TypeAlias

from ...instrumentation import (
    Event,
    EventKind,
    LabwareInfo,
    NameBinding,
    Operation,
    OperationKind,
)
from ...vocabulary import WellRef


class Step(NamedTuple):
    """One recorded operation: the fields of :class:`Operation` that the trace needs."""

    kind: OperationKind
    pipette: str
    nozzles: tuple[str, ...]
    wells: tuple[WellRef | None, ...]
    disposal: bool
    volume: float
    air: bool
    from_top: float | None
    from_bottom: float | None
    from_liquid: float | None
    line: int | None
    lines: tuple[int, ...]
    call: str
    mixing: bool


Record: TypeAlias = "Step | Event"


class Recorder:
    """A listener that keeps the whole run, in order.

    Attributes:
        log: Steps and events as they happened.
        labware: What is known of each labware, by key.
    """

    def __init__(self) -> None:
        self.log: list[Record] = []
        self.labware: dict[str, LabwareInfo] = {}

    def before(self, operation: Operation) -> None:
        """Nothing yet: an operation that raises never happened."""

    def after(self, operation: Operation) -> None:
        """Keep one operation."""
        if operation.kind is OperationKind.MOVE:
            return
        self.log.append(
            Step(
                operation.kind,
                operation.pipette.key,
                operation.nozzles,
                operation.wells,
                operation.disposal,
                operation.volume,
                operation.is_air,
                operation.from_top,
                operation.from_bottom,
                operation.from_liquid,
                operation.line,
                operation.lines,
                operation.call,
                operation.mixing,
            )
        )

    def event(self, event: Event) -> None:
        """Keep one event."""
        if event.kind is EventKind.LABWARE_LOADED and event.labware_info is not None:
            self.labware[event.labware] = event.labware_info
        self.log.append(event)


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
