"""A rehearsal on record: all that the judgement of a protocol starts from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from ..instrumentation import Event, EventKind, LabwareInfo, NameBinding, Operation, OperationKind

Record: TypeAlias = "Operation | Event"


class Recorder:
    """A listener that keeps the whole run, in order.

    Attributes:
        log: Operations and events as they happened.
        labware: What is known of each labware, by key.
    """

    def __init__(self) -> None:
        self.log: list[Record] = []
        self.labware: dict[str, LabwareInfo] = {}

    def before(self, operation: Operation) -> None:
        """Nothing yet: an operation that raises never happened."""

    def after(self, operation: Operation) -> None:
        """Keep one operation; of mere moves those below a well's bottom."""
        if operation.kind is not OperationKind.MOVE or (operation.from_bottom or 0.0) < 0:
            self.log.append(operation.detached())

    def event(self, event: Event) -> None:
        """Keep one event."""
        if event.kind is EventKind.LABWARE_LOADED and event.labware_info is not None:
            self.labware[event.labware] = event.labware_info
        self.log.append(event)


@dataclass(frozen=True)
class Recording:
    """What a rehearsal yields.

    Attributes:
        text: Source of the protocol.
        file: Name of its file.
        log: Operations and events, from a :class:`Recorder`.
        labware: Facts of each labware, by key.
        names: Names that held wells.
        parameters: The numbers and texts that its runtime parameters had.
    """

    text: str
    file: str
    log: Sequence[Record]
    labware: Mapping[str, LabwareInfo]
    names: Sequence[NameBinding] = ()
    parameters: Mapping[str, int | float | str] = field(default_factory=dict)
