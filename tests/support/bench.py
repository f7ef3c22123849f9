"""Traces built by hand, step by step, for tests of trace and checks without a simulator."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aegis_ot.adapters.opentrons.instrumentation import (
    Event,
    EventKind,
    LabwareInfo,
    Operation,
    OperationKind,
    PipetteInfo,
    WellInfo,
)
from aegis_ot.adapters.opentrons.rehearsal import Recorder
from aegis_ot.preflight.rule_set import load_rules
from aegis_ot.preflight.trace import Trace, Well, build_trace
from aegis_ot.vocabulary import WellRef

PIPETTE = PipetteInfo("left", "p300_single_gen2", "left", 1, 300.0)
DEPTH, CAPACITY, DIAMETER = 10.0, 200.0, 6.0


def plate(key: str, wells: Sequence[str], label: str = "") -> LabwareInfo:
    """A plate of round wells, 10 mm deep, 200 µL."""
    info = WellInfo(CAPACITY, DEPTH, diameter=DIAMETER)
    return LabwareInfo(
        key, "plate", "Plate", label, "1", False, False, wells=dict.fromkeys(wells, info)
    )


class Bench:
    """Records a run step by step; each step stands on the line of its number.

    Args:
        troughs: Which of ``plate`` and ``source`` are reservoirs.
    """

    def __init__(self, troughs: Sequence[str] = ()) -> None:
        self.recorder = Recorder()
        self.line = 0
        for key in ("plate", "source"):
            info = plate(key, [f"{row}{column}" for column in range(1, 13) for row in "ABCDEFGH"])
            info = replace(info, centers_channels=key in troughs)
            self.recorder.event(
                Event(EventKind.LABWARE_LOADED, 0, key, text="1", labware_info=info)
            )

    def pick(self, tip: str = "A1") -> None:
        self._do(OperationKind.PICK_UP_TIP, WellRef("rack", tip))

    def drop(self, back: str = "") -> None:
        self._do(OperationKind.DROP_TIP, WellRef("rack", back) if back else None, disposal=not back)

    def draw(self, well: str, volume: float, top: float = -9.0, mixing: bool = False) -> None:
        self._do(OperationKind.ASPIRATE, _ref(well), volume, top, mixing=mixing)

    def give(self, well: str, volume: float, top: float = -9.0, mixing: bool = False) -> None:
        self._do(OperationKind.DISPENSE, _ref(well), volume, top, mixing=mixing)

    def mix(self, well: str, volume: float, top: float = -9.5) -> None:
        self.draw(well, volume, top, mixing=True)
        self.give(well, volume, top, mixing=True)

    def air(self, volume: float) -> None:
        self._do(OperationKind.AIR_GAP, None, volume)

    def blow_out(self, well: str, top: float = -1.0) -> None:
        self._do(OperationKind.BLOW_OUT, _ref(well), top=top)

    def touch_tip(self, well: str) -> None:
        self._do(OperationKind.TOUCH_TIP, _ref(well), top=-1.0)

    def say(self, kind: EventKind, text: str, labware: str = "") -> None:
        self.line += 1
        self.recorder.event(Event(kind, self.line, labware, text=text))

    def load(self, well: str, volume: float | None, name: str = "liquid") -> None:
        ref = _ref(well)
        self.recorder.event(Event(EventKind.LIQUID_LOADED, 0, ref.labware, (ref,), name, volume))

    def trace(self) -> Trace:
        words = load_rules().common.pauses
        return build_trace(self.recorder.log, self.recorder.labware, words)

    def _do(
        self,
        kind: OperationKind,
        ref: WellRef | None,
        volume: float = 0.0,
        top: float | None = None,
        disposal: bool = False,
        mixing: bool = False,
    ) -> None:
        self.line += 1
        self.recorder.after(
            Operation(
                kind,
                PIPETTE,
                ("A1",),
                (ref,),
                disposal,
                volume,
                top,
                None if top is None else DEPTH + top,
                line=self.line,
                lines=(self.line,),
                mixing=mixing,
            )
        )


def _ref(place: str) -> WellRef:
    labware, _, name = place.partition(":")
    return WellRef(labware, name)


def well(trace: Trace, place: str, generation: int = 0) -> Well:
    """A well of a trace by ``"plate:A1"``."""
    labware, _, name = place.partition(":")
    return trace.wells[(labware, generation, name)]


def carried(trace: Trace, tip: int = 0) -> list[str]:
    """The liquids that a tip has met, as ``"source:A1"``."""
    return [f"{origin.ref.labware}:{origin.ref.name}" for origin in trace.tips[tip].origins]
