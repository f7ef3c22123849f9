"""What a pipette did for each delivery, so that it can be done again."""

from __future__ import annotations

from dataclasses import dataclass

from ..adapters.opentrons.instrumentation import Operation, OperationKind
from ..vocabulary import Keyframe, KeyframeKind, WellRef
from .pipette_state import unique, wells_of
from .tip_contents import Contents, DrawnLayer, liquid_of

_EXPELS = (OperationKind.DISPENSE, OperationKind.BLOW_OUT)


@dataclass(frozen=True)
class RecordedDelivery:
    """One delivery, and the operations that made it.

    Attributes:
        keyframe: Its POST_DISPENSE.
        strokes: From the first operation at one of its sources up to that keyframe.
        since: What the pipette did after the keyframe, without leaving the destination.
    """

    keyframe: Keyframe
    strokes: tuple[Operation, ...]
    since: tuple[Operation, ...] = ()

    @property
    def destination(self) -> WellRef | None:
        """The one well delivered to; ``None`` for several, or none known."""
        wells = self.keyframe.destinations
        return wells[0] if len(wells) == 1 else None

    @property
    def draws(self) -> tuple[Operation, ...]:
        """The draws that are no air and no mixing."""
        return tuple(
            stroke
            for stroke in self.strokes
            if stroke.kind is OperationKind.ASPIRATE and not (stroke.is_air or stroke.mixing)
        )

    @property
    def deliveries(self) -> tuple[int, ...]:
        """Places in ``strokes`` of the dispenses into the destination that are no mixing."""
        there = frozenset(self.keyframe.destinations)
        return tuple(
            place
            for place, stroke in enumerate(self.strokes)
            if stroke.kind is OperationKind.DISPENSE
            and not stroke.mixing
            and wells_of(stroke) == there
        )

    @property
    def is_whole(self) -> bool:
        """Whether the strokes draw what was delivered, all of it and nothing else."""
        there = frozenset(self.keyframe.destinations)
        tip = Contents()
        for stroke in self.strokes:
            if stroke.kind in _EXPELS and not stroke.mixing and wells_of(stroke) == there:
                break
            if stroke.kind in _EXPELS:
                tip.expel(None if stroke.kind is OperationKind.BLOW_OUT else stroke.volume)
            elif stroke.is_air:
                tip.draw(DrawnLayer(stroke.volume, liquid=False))
            elif stroke.kind is OperationKind.ASPIRATE:
                tip.draw(DrawnLayer(stroke.volume, unique(stroke.wells)))
        commanded = self.keyframe.commanded_ul
        loaded = liquid_of(tip.peek())
        return abs(loaded - commanded) <= 0.005 * commanded + 0.01 and set(tip.sources) == set(
            self.keyframe.sources
        )


class Strokes:
    """Listens to every pipette of a run; keeps the last delivery of each."""

    def __init__(self) -> None:
        self._open: dict[str, list[Operation]] = {}
        self._last: dict[str, tuple[Keyframe, tuple[Operation, ...]]] = {}

    def done(self, operation: Operation) -> None:
        """An operation was done."""
        key = operation.pipette.mount
        if operation.kind in (OperationKind.PICK_UP_TIP, OperationKind.DROP_TIP):
            self._open.pop(key, None)
            self._last.pop(key, None)
        else:
            self._open.setdefault(key, []).append(operation)

    def captured(self, keyframe: Keyframe) -> None:
        """A keyframe was taken; POST_DISPENSE ends a delivery."""
        if keyframe.kind is KeyframeKind.POST_DISPENSE:
            done = tuple(self._open.pop(keyframe.mount, ()))
            self._last[keyframe.mount] = (keyframe, _from_source(done, keyframe))

    def delivery(self, trajectory: int) -> RecordedDelivery | None:
        """The delivery with this number, if it is the last one of its pipette's tip."""
        for mount, (keyframe, strokes) in self._last.items():
            if keyframe.trajectory == trajectory:
                return RecordedDelivery(keyframe, strokes, tuple(self._open.get(mount, ())))
        return None


def _from_source(done: tuple[Operation, ...], keyframe: Keyframe) -> tuple[Operation, ...]:
    """Without what still belonged to the delivery before: a blow-out, a move to nowhere."""
    sources = frozenset(keyframe.sources)
    for place, operation in enumerate(done):
        if wells_of(operation) & sources:
            return done[place:]
    return ()
