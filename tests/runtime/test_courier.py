"""The courier against a real server: no wait is endless, no keyframe is lost or counted twice."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator

import pytest

from aegis_ot.errors import SidecarUnreachable
from aegis_ot.runtime import courier as module
from aegis_ot.runtime.courier import Courier
from aegis_ot.runtime.link import CameraSilent, SidecarLink

from .fake_sidecar import FakeSidecar, Handler, once
from .test_link import keyframe


class Hanging:
    """A fault: requests whose path ends so get no answer until they are released."""

    def __init__(self, *ends: str) -> None:
        self.ends = ends
        self.release = threading.Event()

    def __call__(self, handler: Handler) -> bool:
        if not handler.path.endswith(self.ends) or self.release.is_set():
            return False
        self.release.wait(10)
        handler.drop()
        return True


@pytest.fixture
def sidecar() -> Iterator[FakeSidecar]:
    with FakeSidecar() as server:
        yield server
        if isinstance(server.fault, Hanging):
            server.fault.release.set()


@pytest.fixture
def courier(sidecar: FakeSidecar, monkeypatch: pytest.MonkeyPatch) -> Iterator[Courier]:
    monkeypatch.setattr(module, "_FIRST_REST_S", 0.0)
    monkeypatch.setattr(module, "_LONGEST_REST_S", 0.0)
    made = Courier(SidecarLink(sidecar.url, None, lambda: None), "run", {"run": "run"}, time.sleep)
    yield made
    made.close()


def seconds_since(began: float) -> float:
    return time.monotonic() - began


def test_a_look_at_a_sidecar_with_a_dead_camera_is_short(
    sidecar: FakeSidecar, courier: Courier
) -> None:
    courier.register(1.0)
    sidecar.fault = Hanging("/keyframes")
    courier.give_up()
    for number in range(3):
        courier.offer(keyframe(number))
    began = time.monotonic()
    assert not courier.look(10.0)
    assert seconds_since(began) < 1.5  # and not the ten of a capture
    assert courier.away
    sidecar.fault.release.set()
    courier.move_on()
    assert courier.look(10.0)
    assert [f["sequence"] for f in sidecar.stored()] == [0, 1, 2]
    assert all(f["late"] for f in sidecar.stored())
    assert courier.acknowledged == 3


def test_what_was_missed_is_sent_though_each_takes_its_time(
    sidecar: FakeSidecar, courier: Courier
) -> None:
    def slow(handler: Handler) -> bool:
        if handler.path.endswith("/keyframes"):
            time.sleep(0.2)
        return False

    courier.register(1.0)
    courier.give_up()
    for number in range(8):
        courier.offer(keyframe(number))
    sidecar.fault = slow
    assert courier.look(10.0)
    assert len(sidecar.stored()) == 8


def test_a_camera_slower_than_the_patience_is_named(sidecar: FakeSidecar, courier: Courier) -> None:
    courier.register(1.0)
    hanging = Hanging("/keyframes")

    def dead_camera(handler: Handler) -> bool:
        if handler.path != "/v1/health":
            return hanging(handler)
        camera = {"kind": "usb", "ok": False, "detail": "The camera has sent nothing for 9 s."}
        handler.answer(200, {"name": "aegis-ot", "wire": 1, "camera": camera})
        return True

    sidecar.fault = dead_camera
    courier.offer(keyframe(0))
    with pytest.raises(CameraSilent, match=r"is there, but.*sent nothing for 9 s\)\. Look at"):
        courier.deliver(0.3)
    hanging.release.set()


def test_a_sidecar_that_is_gone_is_not_taken_for_a_dead_camera(
    sidecar: FakeSidecar, courier: Courier
) -> None:
    courier.register(1.0)
    sidecar.die()
    courier.offer(keyframe(0))
    began = time.monotonic()
    with pytest.raises(SidecarUnreachable, match="Check that it runs"):
        courier.deliver(0.3)
    assert seconds_since(began) < 1.0


@pytest.mark.parametrize(
    ("status", "body"),
    [
        (503, {"error": {"code": "crowded", "message": "Full.", "hint": ""}}),
        (503, "Service Unavailable"),
        (429, {"error": {"code": "rate", "message": "Too often.", "hint": ""}}),
    ],
)
def test_a_sidecar_that_is_too_busy_is_named_and_noted(
    status: int, body: object, sidecar: FakeSidecar, courier: Courier,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.setattr(module, "_SILENT_S", 0.1)
    told: list[str] = []
    courier.on_trouble = lambda error, left: told.append(str(error))
    courier.register(1.0)
    sidecar.fault = once("/keyframes", lambda handler: handler.answer(status, body), 2)
    courier.offer(keyframe(0))
    courier.deliver(5.0)
    assert "too busy to serve this robot" in told[0]
    courier.abandon(0, "told with what waits")
    (incident,) = sidecar.incidents
    assert "too busy" in incident["text"]


def test_messages_that_nobody_takes_hold_the_robot_up_once(
    sidecar: FakeSidecar, courier: Courier, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "REQUEST_S", 0.3)
    courier.register(1.0)
    sidecar.fault = Hanging("/hold")
    began = time.monotonic()
    for number in range(5):
        courier.report_hold(number, 0.1, "verdict", None)
    assert seconds_since(began) < 0.6
    sidecar.fault.release.set()
    courier.offer(keyframe(0))
    courier.deliver(1.0)  # it is there: what was not said is said next time
    courier.report_hold(5, 0.1, "verdict", None)
    assert [hold["trajectory"] for hold in sidecar.holds] == [0, 1, 2, 3, 4, 5]


def test_a_message_that_is_refused_keeps_no_other_from_being_told(
    sidecar: FakeSidecar, courier: Courier
) -> None:
    courier.register(1.0)
    sidecar.fault = once("/hold", lambda handler: handler.answer(422, {"error": {"code": "bad"}}))
    courier.report_hold(0, 0.1, "verdict", None)
    courier.report_hold(1, 0.1, "verdict", None)
    courier.finish("succeeded", "", {}, 2.0)
    assert [hold["trajectory"] for hold in sidecar.holds] == [1]
    assert sidecar.finished


def test_a_goodbye_that_nobody_takes_ends_in_time(sidecar: FakeSidecar, courier: Courier) -> None:
    courier.register(1.0)
    sidecar.fault = Hanging("/abandon", "/finish")
    began = time.monotonic()
    with pytest.raises(SidecarUnreachable):
        courier.finish("failed", "", {0: "the run failed", 1: "the run failed"}, 0.5)
    assert seconds_since(began) < 0.9


def test_a_goodbye_says_everything(sidecar: FakeSidecar, courier: Courier) -> None:
    courier.register(1.0)
    courier.finish("failed", "why", {0: "the run failed", 1: "the run failed"}, 1.0)
    assert sidecar.abandoned == [0, 1]
    assert sidecar.finished == [{"outcome": "failed", "detail": "why"}]


def test_a_sidecar_that_waits_for_its_camera_is_no_lost_link(
    sidecar: FakeSidecar, courier: Courier, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "_SILENT_S", 0.1)
    monkeypatch.setattr(module, "_FIRST_TRY_S", 0.3)
    courier.register(5.0)
    sidecar.fault = fault = Hanging("/keyframes")  # its camera is unplugged; all else is answered
    threading.Timer(0.8, fault.release.set).start()
    courier.offer(keyframe(0))
    courier.deliver(10.0)
    courier.abandon(0, "told with what waits")
    assert sidecar.incidents == []


def test_an_outage_ends_when_the_sidecar_says_what_else_is_wrong(
    sidecar: FakeSidecar, courier: Courier, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "_SILENT_S", 0.0)
    courier.register(5.0)
    answers: list[float] = []

    def gone_then_without_a_camera(handler: Handler) -> bool:
        if len(answers) < 4:
            handler.drop()
        elif handler.path.endswith("/keyframes") and len(answers) < 8:
            handler.answer(503, {"error": {"code": "camera", "message": "It is dark."}})
        else:
            return False
        answers.append(time.monotonic())
        return True

    sidecar.fault = gone_then_without_a_camera
    began = time.monotonic()
    courier.offer(keyframe(0))
    courier.deliver(20.0)
    courier.abandon(0, "told with what waits")
    (incident,) = sidecar.incidents
    assert incident["seconds"] <= answers[4] - began + 0.1  # told in tenths
    assert incident["seconds"] < answers[-1] - began
