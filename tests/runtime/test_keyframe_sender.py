"""The sender against a real server: no wait is endless, no keyframe is lost or counted twice."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest

from aegis_ot.errors import SidecarUnreachable
from aegis_ot.http_client import HttpClient
from aegis_ot.runtime import keyframe_sender as module
from aegis_ot.runtime import outbox, retrying
from aegis_ot.runtime.keyframe_sender import KeyframeSender
from aegis_ot.runtime.sidecar_client import CameraSilent, SidecarClient

from .fake_sidecar import FakeSidecar, Handler, once
from .test_sidecar_client import keyframe


class Hanging:
    """A fault: requests whose path ends so get no answer until they are released."""

    def __init__(self, *ends: str) -> None:
        self.ends = ends
        self.release = threading.Event()

    def __call__(self, handler: Handler) -> bool:
        if not handler.path.endswith(self.ends) or self.release.is_set():
            return False
        self.release.wait(60)
        handler.drop()
        return True


@pytest.fixture
def sidecar() -> Iterator[FakeSidecar]:
    with FakeSidecar() as server:
        yield server
        if isinstance(server.fault, Hanging):
            server.fault.release.set()


@pytest.fixture
def sender(sidecar: FakeSidecar, monkeypatch: pytest.MonkeyPatch) -> Iterator[KeyframeSender]:
    monkeypatch.setattr(module, "_FIRST_REST_S", 0.0)
    monkeypatch.setattr(module, "_LONGEST_REST_S", 0.0)
    made = KeyframeSender(
        SidecarClient(sidecar.url, None, lambda: None), "run", {"run": "run"}, time.sleep
    )
    yield made
    made.close()


@pytest.fixture
def patience(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, float]]:
    """How long each request was allowed to take, s, by the end of its path.

    A glance at a sidecar's health has more in truth: a busy machine answers late.
    """
    given: list[tuple[str, float]] = []
    request = HttpClient.request

    def noted(self: HttpClient, method: str, path: str, body: Any, timeout_s: float) -> Any:
        given.append((path.partition("?")[0].rpartition("/")[2], timeout_s))
        return request(self, method, path, body, 60.0 if path.endswith("health") else timeout_s)

    monkeypatch.setattr(HttpClient, "request", noted)
    return given


def test_a_look_at_a_sidecar_with_a_dead_camera_is_short(
    sidecar: FakeSidecar, sender: KeyframeSender, patience: list[tuple[str, float]]
) -> None:
    sender.register(60.0)
    sidecar.fault = Hanging("/keyframes")
    sender.give_up()
    patience.clear()
    for number in range(3):
        sender.offer(keyframe(number))
    assert not sender.look(10.0)
    assert patience == [("health", 0.25), ("keyframes", 1.0)]  # and not the ten of a capture
    assert sender.away
    sidecar.fault.release.set()
    sender.move_on()
    assert sender.look(10.0)
    assert [f["sequence"] for f in sidecar.stored()] == [0, 1, 2]
    assert all(f["late"] for f in sidecar.stored())
    assert sender.acknowledged == 3


@pytest.mark.usefixtures("patience")
def test_what_was_missed_is_sent_though_each_takes_its_time(
    sidecar: FakeSidecar, sender: KeyframeSender
) -> None:
    def slow(handler: Handler) -> bool:
        if handler.path.endswith("/keyframes"):
            time.sleep(0.2)
        return False

    sender.register(60.0)
    sender.give_up()
    for number in range(8):
        sender.offer(keyframe(number))
    sidecar.fault = slow
    assert sender.look(60.0)
    assert len(sidecar.stored()) == 8


@pytest.mark.usefixtures("patience")
def test_a_camera_slower_than_the_patience_is_named(
    sidecar: FakeSidecar, sender: KeyframeSender
) -> None:
    sender.register(60.0)
    hanging = Hanging("/keyframes")

    def dead_camera(handler: Handler) -> bool:
        if handler.path != "/v1/health":
            return hanging(handler)
        camera = {"kind": "usb", "ok": False, "detail": "The camera has sent nothing for 9 s."}
        handler.answer(200, {"name": "aegis-ot", "wire": 1, "camera": camera})
        return True

    sidecar.fault = dead_camera
    sender.offer(keyframe(0))
    with pytest.raises(CameraSilent, match=r"is there, but.*sent nothing for 9 s\)\. Look at"):
        sender.deliver(0.3)
    hanging.release.set()


def test_a_sidecar_that_is_gone_is_not_taken_for_a_dead_camera(
    sidecar: FakeSidecar, sender: KeyframeSender, patience: list[tuple[str, float]]
) -> None:
    sender.register(60.0)
    sidecar.die()
    sender.offer(keyframe(0))
    patience.clear()
    with pytest.raises(SidecarUnreachable, match="Check that it runs"):
        sender.deliver(0.3)
    assert max(seconds for _, seconds in patience) <= 0.3


@pytest.mark.parametrize(
    ("status", "body"),
    [
        (503, {"error": {"code": "crowded", "message": "Full.", "hint": ""}}),
        (503, "Service Unavailable"),
        (429, {"error": {"code": "rate", "message": "Too often.", "hint": ""}}),
    ],
)
def test_a_sidecar_that_is_too_busy_is_named_and_noted(
    status: int, body: object, sidecar: FakeSidecar, sender: KeyframeSender,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.setattr(retrying, "_SILENT_S", 0.1)
    told: list[str] = []
    sender.retrying.on_trouble = lambda error, left: told.append(str(error))
    sender.register(60.0)
    sidecar.fault = once("/keyframes", lambda handler: handler.answer(status, body), 2)
    sender.offer(keyframe(0))
    sender.deliver(60.0)
    assert "too busy to serve this robot" in told[0]
    sender.abandon(0, "told with what waits")
    (incident,) = sidecar.incidents
    assert "too busy" in incident["text"]


def test_messages_that_nobody_takes_hold_the_robot_up_once(
    sidecar: FakeSidecar, sender: KeyframeSender, patience: list[tuple[str, float]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.setattr(module, "REQUEST_S", 0.3)
    sender.register(60.0)
    sidecar.fault = Hanging("/hold")
    for number in range(5):
        sender.report_hold(number, 0.1, "verdict", None)
    assert [path for path, _ in patience].count("hold") == 1
    sidecar.fault.release.set()
    monkeypatch.setattr(module, "REQUEST_S", 60.0)
    sender.offer(keyframe(0))
    sender.deliver(60.0)  # it is there: what was not said is said next time
    sender.report_hold(5, 0.1, "verdict", None)
    assert [hold["trajectory"] for hold in sidecar.holds] == [0, 1, 2, 3, 4, 5]


def test_a_message_that_is_refused_keeps_no_other_from_being_told(
    sidecar: FakeSidecar, sender: KeyframeSender
) -> None:
    sender.register(60.0)
    sidecar.fault = once("/hold", lambda handler: handler.answer(422, {"error": {"code": "bad"}}))
    sender.report_hold(0, 0.1, "verdict", None)
    sender.report_hold(1, 0.1, "verdict", None)
    sender.finish("succeeded", "", {}, 60.0)
    assert [hold["trajectory"] for hold in sidecar.holds] == [1]
    assert sidecar.finished


def test_a_goodbye_that_nobody_takes_ends_in_time(
    sidecar: FakeSidecar, sender: KeyframeSender, patience: list[tuple[str, float]]
) -> None:
    sender.register(60.0)
    sidecar.fault = Hanging("/abandon", "/finish")
    patience.clear()
    with pytest.raises(SidecarUnreachable):
        sender.finish("failed", "", {0: "the run failed", 1: "the run failed"}, 0.5)
    assert sum(seconds for _, seconds in patience) <= 0.5


def test_a_goodbye_says_everything(sidecar: FakeSidecar, sender: KeyframeSender) -> None:
    sender.register(60.0)
    sender.finish("failed", "why", {0: "the run failed", 1: "the run failed"}, 60.0)
    assert sidecar.abandoned == [0, 1]
    assert sidecar.finished == [{"outcome": "failed", "detail": "why"}]


def test_a_goodbye_counts_what_nobody_captured(
    sidecar: FakeSidecar, sender: KeyframeSender
) -> None:
    sender.register(60.0)
    sender.offer(keyframe(0))
    sender.deliver(60.0)
    sender.offer(keyframe(1))
    sender.give_up()
    sender.finish("stopped", "", {}, 60.0, begun=3)
    ended = {"outcome": "stopped", "detail": "", "trajectories": 3, "keyframes": 2}
    assert sidecar.finished == [ended]


def test_the_end_is_told_where_nothing_else_is_taken(
    sidecar: FakeSidecar, sender: KeyframeSender
) -> None:
    sender.register(60.0)
    full = {"error": {"code": "store", "message": "The disk is full."}}
    sidecar.fault = once("/abandon", lambda handler: handler.answer(503, full), 9)
    sender.finish("aborted", "why", {0: "the run was aborted"}, 60.0)
    assert sidecar.finished == [{"outcome": "aborted", "detail": "why"}]


@pytest.mark.usefixtures("patience")
def test_a_sidecar_that_waits_for_its_camera_is_no_lost_link(
    sidecar: FakeSidecar, sender: KeyframeSender, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(retrying, "_SILENT_S", 0.1)
    monkeypatch.setattr(retrying, "_FIRST_TRY_S", 0.3)
    sender.register(60.0)
    sidecar.fault = fault = Hanging("/keyframes")  # its camera is unplugged; all else is answered
    threading.Timer(0.8, fault.release.set).start()
    sender.offer(keyframe(0))
    sender.deliver(60.0)
    sender.abandon(0, "told with what waits")
    assert sidecar.incidents == []


class Clock:
    """Time that passes only while the sender rests, s."""

    def __init__(self) -> None:
        self.now = 100.0

    def monotonic(self) -> float:
        return self.now

    def rest(self, seconds: float) -> None:
        self.now += seconds


def test_an_outage_ends_when_the_sidecar_says_what_else_is_wrong(
    sidecar: FakeSidecar, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(retrying, "_SILENT_S", 0.0)
    clock = Clock()
    link = SidecarClient(sidecar.url, None, lambda: None)
    sender = KeyframeSender(link, "run", {"run": "run"}, clock.rest)
    sender.register(60.0)
    for timed in (module, outbox, retrying):
        monkeypatch.setattr(timed, "time", clock)
    answers: list[float] = []

    def gone_then_without_a_camera(handler: Handler) -> bool:
        number = len(answers)
        is_dark = handler.path.endswith("/keyframes")
        if number >= 8 or (number >= 4 and not is_dark):
            return False
        answers.append(clock.now)  # first: once it is answered, the robot's clock goes on
        if number < 4:
            handler.drop()
        else:
            handler.answer(503, {"error": {"code": "camera", "message": "It is dark."}})
        return True

    sidecar.fault = gone_then_without_a_camera
    began = clock.now
    sender.offer(keyframe(0))
    sender.deliver(20.0)
    sender.abandon(0, "told with what waits")
    (incident,) = sidecar.incidents
    assert incident["seconds"] == pytest.approx(answers[4] - began, abs=0.05)  # told in tenths
    assert answers[-1] > answers[4]
    sender.close()
