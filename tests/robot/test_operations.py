"""Watch mode: what the list of a run's commands says of liquid probes."""

from __future__ import annotations

from typing import Any

from aegis_ot.instrumentation import Pipette
from aegis_ot.robot.operations import OperationReader
from aegis_ot.robot.shapes import Command
from aegis_ot.runtime import Tracker
from aegis_ot.runtime.steps import Capture
from aegis_ot.vocabulary import WellRef


class OneFlex:
    """A deck with one pipette on which nothing is a trash."""

    def pipette(self, _id: str) -> Pipette:
        return Pipette("left", "flex_1channel_1000", "left", 1, 1000.0)

    def wells(self, labware: str, well: str, _channels: int) -> tuple[WellRef, ...]:
        return (WellRef(labware, well, labware),)

    def is_trash(self, _labware: str) -> bool:
        return False

    def depth(self, _labware: str, _well: str) -> float:
        return 10.0

    def tip_volume(self, _labware: str, _well: str) -> float:
        return 200.0


def told(*commands: tuple[str, str, str]) -> set[bool | None]:
    """What the keyframes say; a command is its kind, its well, and its status."""
    reader: Any = OperationReader(OneFlex())  # type: ignore[arg-type]
    tracker = Tracker("run", "off", False, reader.capacity, reader.liquid_found)
    steps = []
    for index, (kind, place, status) in enumerate(commands):
        labware, well = place.split(":")
        inside = {"origin": "bottom", "offset": {"z": 1.0}}
        params = {"pipetteId": "p", "labwareId": labware, "wellName": well, "volume": 50.0}
        command = Command(index, kind, status, params | {"wellLocation": inside})
        operation = reader.operation(command)
        steps += tracker.before(operation)
        if status == "succeeded":
            steps += tracker.after(operation)
    steps += tracker.finish()
    return {step.keyframe.liquid_found for step in steps if isinstance(step, Capture)}


def delivery(*probes: tuple[str, str]) -> list[tuple[str, str, str]]:
    done = "succeeded"
    return [
        ("pickUpTip", "rack:A1", done),
        *((kind, "reservoir:A1", status) for kind, status in probes),
        ("aspirate", "reservoir:A1", done),
        ("dispense", "plate:A1", done),
        ("dropTip", "rack:A1", done),
    ]


def test_a_probe_that_had_to_find_liquid_and_succeeded_did() -> None:
    assert told(*delivery(("liquidProbe", "succeeded"))) == {True}


def test_one_that_failed_or_may_find_none_says_nothing() -> None:
    assert told(*delivery()) == {None}
    assert told(*delivery(("tryLiquidProbe", "succeeded"))) == {None}
    assert told(*delivery(("liquidProbe", "succeeded"), ("liquidProbe", "failed"))) == {None}
