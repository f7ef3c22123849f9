"""Watch mode: what the list of a run's commands says of liquid probes."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from aegis_ot.adapters.opentrons.instrumentation import PipetteInfo
from aegis_ot.robot import RobotClient
from aegis_ot.robot.deck import Deck
from aegis_ot.robot.operations import OperationReader
from aegis_ot.robot.server_answers import Command
from aegis_ot.runtime import Tracker
from aegis_ot.runtime.steps import Capture
from aegis_ot.vocabulary import WellRef


class OneFlex:
    """A deck with one pipette on which nothing is a trash."""

    def pipette(self, _id: str) -> PipetteInfo:
        return PipetteInfo("left", "flex_1channel_1000", "left", 1, 1000.0)

    def wells(self, labware: str, well: str, _channels: int) -> tuple[WellRef, ...]:
        return (WellRef(labware, well, labware),)

    def is_trash(self, _labware: str) -> bool:
        return False

    def depth(self, _labware: str, _well: str) -> float:
        return 10.0

    def liquid_found(self, command: str) -> bool | None:
        return {"found": True, "none": False}.get(command)

    def tip_volume(self, _labware: str, _well: str) -> float:
        return 200.0


DONE, FAILED = "succeeded", "failed"


def did(kind: str, place: str, status: str = DONE, error: str = "", name: str = "") -> Command:
    labware, well = place.split(":")
    inside = {"origin": "bottom", "offset": {"z": 1.0}}
    params = {"pipetteId": "p", "labwareId": labware, "wellName": well, "volume": 50.0}
    return Command(0, kind, status, params | {"wellLocation": inside}, error_kind=error, id=name)


def told(*commands: Command | None) -> set[bool | None]:
    """What the keyframes say; ``None`` for a person who deals with the robot."""
    reader: Any = OperationReader(OneFlex())  # type: ignore[arg-type]
    tracker = Tracker("run", "off", False, reader.capacity, reader.liquid_found)
    steps = []
    for command in commands:
        if command is None:
            tracker.deck_touched()
            continue
        operation = reader.operation(command)
        steps += tracker.before(operation)
        if reader.is_done(operation, command):
            steps += tracker.after(operation)
    steps += tracker.finish()
    return {step.keyframe.liquid_found for step in steps if isinstance(step, Capture)}


def delivery(*between: Command | None) -> list[Command | None]:
    return [
        did("pickUpTip", "rack:A1"),
        *between,
        did("aspirate", "reservoir:A1"),
        did("dispense", "plate:A1"),
        did("dropTip", "rack:A1"),
    ]


def probe(status: str = DONE, error: str = "") -> Command:
    return did("liquidProbe", "reservoir:A1", status, error)


def tried(name: str, status: str = DONE, error: str = "") -> Command:
    return did("tryLiquidProbe", "reservoir:A1", status, error, name)


def test_a_probe_that_had_to_find_liquid_and_succeeded_did() -> None:
    assert told(*delivery(probe())) == {True}


def test_one_that_may_find_none_is_asked_what_it_found() -> None:
    assert told(*delivery(tried("found"))) == {True}
    assert told(*delivery(tried("none"))) == {False}
    assert told(*delivery(tried("gone"))) == {None}
    assert told(*delivery(tried("found"), tried("none"))) == {False}


def test_one_that_failed_for_want_of_liquid_found_none() -> None:
    missing = probe(FAILED, "liquidNotFound")
    assert told(*delivery(missing)) == {False}
    assert told(*delivery(missing, probe())) == {True}


def test_what_a_person_dealt_with_is_unknown_until_asked_again() -> None:
    missing = probe(FAILED, "liquidNotFound")
    assert told(*delivery(missing, None)) == {None}
    assert told(*delivery(missing, None, probe())) == {True}


def test_one_that_failed_otherwise_says_nothing() -> None:
    assert told(*delivery()) == {None}
    assert told(*delivery(probe(), probe(FAILED, "overpressure"))) == {None}
    assert told(*delivery(tried("found", FAILED, "stallOrCollision"))) == {None}


@pytest.mark.parametrize(
    ("status", "data", "said"),
    [
        (200, {"result": {"z_position": 12.5, "position": {"x": 1, "y": 2, "z": 3}}}, True),
        (200, {"result": {"z_position": None, "position": {"x": 1, "y": 2, "z": 3}}}, False),
        (200, {"result": {"position": {"x": 1, "y": 2, "z": 3}}}, False),
        (200, {}, None),
        (404, {}, None),
    ],
)
def test_what_the_robot_says_of_a_probe(status: int, data: Any, said: bool | None) -> None:
    def answer(request: httpx.Request) -> httpx.Response:
        assert request.url.path == "/runs/r/commands/c"
        return httpx.Response(status, json={"data": data})

    with RobotClient("127.0.0.1", httpx.MockTransport(answer)) as client:
        assert Deck(client, "r").liquid_found("c") is said


def test_a_robot_that_gives_no_answer_does_not_hold_up_the_watch() -> None:
    def answer(request: httpx.Request) -> httpx.Response:
        raise httpx.ConnectError("gone", request=request)

    with RobotClient("127.0.0.1", httpx.MockTransport(answer)) as client:
        assert Deck(client, "r").liquid_found("c") is None
