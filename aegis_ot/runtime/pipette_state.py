"""One pipette as the tracker follows it: its tip, where that stands, what it holds."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..adapters.opentrons.instrumentation import Operation, OperationKind, PipetteInfo
from ..vocabulary import WellRef
from .steps import Trajectory
from .tip_contents import Contents, DrawnLayer, liquid_of

Place = frozenset[WellRef] | None
"""Wells under the tips; empty for a place without wells; ``None`` if it cannot be known."""

_INSIDE_KINDS = (OperationKind.DISPENSE, OperationKind.BLOW_OUT, OperationKind.TOUCH_TIP)


@dataclass
class PipetteState:
    """State of one pipette.

    Attributes:
        pipette: Which one.
        tip: Tip rack and tip of the first channel, ``"1:A1"``; ``""`` without a tip.
        capacity: Working volume of the tip, µL; ``None`` until asked for.
        contents: What the tip holds.
        place: Where the tip stands.
        above: Whether it stands at or above the top of the wells there.
        aimed: Last operation that was aimed at the wells there, to lift from.
        position: Tip end on the deck, mm, or ``None``.
        nozzles: Those that took part in its last operation.
        draw: The last draw whose ASPIRATE keyframe is still owed.
        current: The trajectory that is under way.
    """

    pipette: PipetteInfo
    tip: str = ""
    capacity: float | None = None
    contents: Contents = field(default_factory=Contents)
    place: Place = None
    above: bool = False
    aimed: Operation | None = None
    position: tuple[float, float, float] | None = None
    nozzles: tuple[str, ...] = ()
    draw: Operation | None = None
    current: Trajectory | None = None

    def stays(self, operation: Operation) -> bool:
        """Whether the tip is at the place of ``operation`` already."""
        if operation.kind in (OperationKind.DROP_TIP, OperationKind.PICK_UP_TIP):
            return False
        if in_place(operation):
            return True
        wells = wells_of(operation)
        return bool(wells) and not operation.disposal and wells == self.place

    def target(self, operation: Operation) -> Place:
        """Where ``operation`` takes place."""
        wells = wells_of(operation)
        if wells or not in_place(operation):
            return wells
        return self.place

    def enters(self, operation: Operation) -> bool:
        """Whether ``operation`` brings this tip, or what leaves it, into wells."""
        kind = operation.kind
        if operation.disposal or not self.target(operation):
            return False
        if kind is OperationKind.MOVE:
            return operation.from_top is None or operation.from_top < 0
        return kind in _INSIDE_KINDS or (kind is OperationKind.ASPIRATE and not operation.is_air)

    def leaving(self, operation: Operation) -> tuple[DrawnLayer, ...]:
        """What leaves the tip by ``operation``."""
        if operation.kind is OperationKind.BLOW_OUT:
            return self.contents.peek()
        if operation.kind is OperationKind.DISPENSE:
            return self.contents.peek(operation.volume)
        return ()

    def delivers(self, operation: Operation) -> bool:
        """Whether ``operation`` brings liquid to another place than it was drawn from."""
        if operation.disposal or operation.mixing:
            return False
        leaving = self.leaving(operation)
        place = self.target(operation)
        return liquid_of(leaving) > 1e-3 and any(
            layer.liquid and frozenset(layer.sources) != place for layer in leaving
        )

    def brings_home(self, operation: Operation) -> bool:
        """Whether ``operation`` takes place in the one source of all that the tip holds."""
        return frozenset(self.contents.sources) == self.target(operation)

    def aim(self, trajectory: Trajectory, operation: Operation) -> None:
        """Note the wells that ``operation`` delivers to, in the order of the channels."""
        aimed = self.aimed if in_place(operation) and operation.well is None else operation
        wells = aimed.wells if aimed is not None else ()
        trajectory.destinations = unique(wells)
        several = trajectory.channels > 1 and len(wells) == len(trajectory.nozzles)
        trajectory.targets = wells if several else ()

    def displaced(self) -> None:
        """Another pipette moved, and this one with it."""
        self.place, self.above, self.aimed = None, False, None


def unique(wells: tuple[WellRef | None, ...]) -> tuple[WellRef, ...]:
    """Each well once, in order."""
    return tuple(dict.fromkeys(well for well in wells if well is not None))


def wells_of(operation: Operation) -> frozenset[WellRef]:
    """The wells at which an operation is aimed."""
    return frozenset(well for well in operation.wells if well is not None)


def in_place(operation: Operation) -> bool:
    """Whether the tip stays where it is; the engine's air gap knows no other way."""
    return operation.in_place or (
        operation.kind is OperationKind.AIR_GAP and operation.well is None
    )
