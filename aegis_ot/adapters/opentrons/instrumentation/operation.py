"""One pipetting operation as it passes through an instrument's core, seen by listeners.

The core of an ``InstrumentContext`` is where every path meets, at every apiLevel: plain calls,
``transfer`` and its siblings, the liquid-class transfers. An operation is told twice: to
:meth:`Listener.before` when the robot is about to do it (nothing has moved yet), and to
:meth:`Listener.after` when it is done.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, Protocol

from ....vocabulary import WellRef
from .labware import LabwareInfo


class OperationKind(str, Enum):
    """What an instrument can do to a tip or a liquid."""

    PICK_UP_TIP = "pick_up_tip"
    DROP_TIP = "drop_tip"
    ASPIRATE = "aspirate"
    DISPENSE = "dispense"
    BLOW_OUT = "blow_out"
    AIR_GAP = "air_gap"
    TOUCH_TIP = "touch_tip"
    MOVE = "move"


@dataclass(frozen=True)
class PipetteInfo:
    """One loaded pipette.

    Attributes:
        key: Unique within a run (the mount).
        name: Opentrons name, ``"p300_multi_gen2"``.
        mount: ``"left"`` or ``"right"``.
        channels: Number of nozzles it has.
        max_volume: µL.
        min_volume: The least it is made to move as it is set now, µL.
    """

    key: str
    name: str
    mount: str
    channels: int
    max_volume: float
    min_volume: float = 0.0


class _NoCore:
    """Stands for the core of an operation that was made by hand, or comes from elsewhere.

    No function: who receives a recording from another process takes objects only.
    """

    def __call__(self) -> None:
        return None


@dataclass(frozen=True)
class Operation:
    """One operation of one pipette.

    Attributes:
        kind: What is done.
        pipette: By which pipette.
        nozzles: The active nozzles that take part, ``("A1", ..., "H1")``; each holds one tip.
        wells: The well at each of those nozzles, same order; ``None`` where a nozzle is over
            no well. All ``None`` for trash, waste chute or a bare coordinate.
        disposal: Whether the place is a trash bin, a waste chute or trash labware.
        volume: Per nozzle, µL; 0 where it means nothing. ``BLOW_OUT`` has 0: it empties.
        from_top: Height of the tip end over the well's top, mm (negative: inside the well);
            ``None`` if unknown or if there is no well.
        from_bottom: Height of the tip end over the well's bottom, mm; likewise.
        from_liquid: Height of the tip end over the liquid that stands there afterwards, mm, where
            the protocol says it so (``well.meniscus(...)``); else ``None``.
        position: Tip end on the deck (x, y, z), mm, or ``None``.
        in_place: Whether the core was told not to move first.
        line: Source line of the protocol that the innermost protocol frame stands on.
        lines: All protocol lines on the stack, innermost first.
        call: Name of the ``InstrumentContext`` method that the protocol called:
            ``"transfer"``, ``"mix"``, ``"aspirate"``, ``"transfer_with_liquid_class"``...
        mixing: Whether it is part of a mix (``mix``, ``mix_before``, ``mix_after``, or the mix
            step of a liquid class).
        written: What the protocol asks for, µL, where older apiLevels move another volume; else
            ``None``.
        lead: Which of the nozzles is sent to the place that the protocol names.
        probes: Whether it looks for liquid with the pipette's pressure sensor (Flex).
    """

    kind: OperationKind
    pipette: PipetteInfo
    nozzles: tuple[str, ...]
    wells: tuple[WellRef | None, ...]
    disposal: bool = False
    volume: float = 0.0
    from_top: float | None = None
    from_bottom: float | None = None
    from_liquid: float | None = None
    position: tuple[float, float, float] | None = None
    in_place: bool = False
    line: int | None = None
    lines: tuple[int, ...] = ()
    call: str = ""
    mixing: bool = False
    written: float | None = None
    lead: int = 0
    probes: bool = False
    core: Callable[[], Any] = field(default=_NoCore(), repr=False, compare=False)
    """Gives the instrument core, as a weak reference does: ``None`` once the run is over."""
    method: str = field(default="", repr=False, compare=False)
    """Name of the core's method that was called."""
    arguments: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)
    """What it was called with, by name: enough to do the same again."""

    def detached(self) -> Operation:
        """The same without its core, to be kept after the run or sent to another process."""
        # Not by ``dataclasses.replace``: that is a third of what it takes to record an operation.
        copied = object.__new__(Operation)
        copied.__dict__.update(self.__dict__, core=Operation.core, arguments={})
        return copied

    @property
    def well(self) -> WellRef | None:
        """The first nozzle's well, or the first there is."""
        return next(filter(None, self.wells), None)

    @property
    def is_air(self) -> bool:
        """Whether an aspirate draws air: at or above the top of its well, or over no well."""
        if self.kind is OperationKind.AIR_GAP:
            return True
        if self.kind is not OperationKind.ASPIRATE:
            return False
        return (self.from_top is not None and self.from_top >= 0) or not any(self.wells)


class Listener(Protocol):
    """Hears of every operation of every instrument of one protocol run, in its thread.

    An exception raised by a listener reaches the protocol: listeners raise only on purpose.
    """

    def before(self, operation: Operation) -> None:
        """The operation is about to be done; the robot stands still."""

    def after(self, operation: Operation) -> None:
        """The operation is done; not called if it raised."""

    def event(self, event: Event) -> None:
        """Something happened that is not a pipetting operation."""


class EventKind(str, Enum):
    """What else in a protocol changes the meaning of wells and tips.

    ``PAUSED`` and ``LABWARE_MOVING`` are told before the robot pauses or the labware leaves;
    everything else is told after it happened.
    """

    LABWARE_LOADED = "labware_loaded"
    LABWARE_MOVING = "labware_moving"
    LABWARE_MOVED = "labware_moved"
    LIQUID_LOADED = "liquid_loaded"
    TIPS_RESET = "tips_reset"
    PAUSED = "paused"
    COMMENT = "comment"
    MODULE = "module"
    CUT_SHORT = "cut_short"


@dataclass(frozen=True)
class Event:
    """Something besides pipetting: a plate moved, a liquid declared, a pause, a comment.

    Attributes:
        kind: What happened.
        line: Source line of the protocol.
        labware: Key of the labware concerned (see :class:`WellRef`), or ``""``.
        wells: The wells concerned; those that a call which was cut short left out.
        text: Message of a pause or comment; name of a liquid, or of a method that was cut short;
            new slot of a moved labware; what a module did (``"set and wait for shake speed 500"``),
            ``labware`` being the plate on it.
        volume: Declared volume of a loaded liquid, or what was written for the first of the wells
            left out, µL, or ``None``.
        labware_info: What is known of a labware just loaded.
        description: What the protocol says of a loaded liquid besides its name.
    """

    kind: EventKind
    line: int | None = None
    labware: str = ""
    wells: tuple[WellRef, ...] = ()
    text: str = ""
    volume: float | None = None
    labware_info: LabwareInfo | None = None
    description: str = ""
