"""Trouble is kept with its run, whatever it was, and named in the report."""

from __future__ import annotations

import time
from typing import Any

import pytest

from aegis_ot.errors import StoreError
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.clocks import ClockWatch
from aegis_ot.sidecar.store import Store
from tests.runtime.test_live import in_time

from .helpers import Robot, StubAnalyser, StubCamera


def incidents(robot: Robot) -> list[tuple[str, bool]]:
    return [(one["kind"], one["ended"] is not None) for one in robot.overview()["incidents"]]


def test_a_full_disk_is_named_when_it_is_over_and_its_verdicts_are_kept(
    config: SidecarConfig, monkeypatch: pytest.MonkeyPatch
) -> None:
    write, full = Store._write, [False]

    def maybe(self: Store, *written: Any) -> int:
        if full[0]:
            raise StoreError("No space left on device.")
        return write(self, *written)

    monkeypatch.setattr(Store, "_write", maybe)
    analyser = StubAnalyser()
    analyser.gate.clear()
    with running_sidecar(config, StubCamera(), analyser) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        full[0] = True
        analyser.gate.set()
        assert robot.verdict(0)["verdict"]["outcome"] == "pass"  # the robot need not wait
        answer = robot.send(4)
        assert (answer.status_code, answer.json()["error"]["code"]) == (503, "store")
        full[0] = False
        assert robot.send(4).status_code == 200
        assert incidents(robot) == [("store", True)]
    store = Store(config.data)
    assert [verdict.trajectory for verdict, _, _ in store.verdicts("run-1")] == [0]
    store.close()


def test_a_vision_model_that_is_down_is_told_once_until_it_answers(config: SidecarConfig) -> None:
    cost = {"model": "m", "calls": 1, "tokens_in": 1, "tokens_out": 1, "amount": None,
            "currency": "USD", "seconds": 0.1}  # fmt: skip
    said = [{"model_trouble": "It is down."}, {"model_trouble": "Still."}, {"costs": [cost]}]

    class Judge(StubAnalyser):
        def begin(self, run: str, history: Any = ()) -> Any:
            inner = super().begin(run, history)
            judge = inner.judge
            inner.judge = lambda number: (judge(number)[0], said[number])  # type: ignore[method-assign]
            return inner

    with running_sidecar(config, StubCamera(), Judge()) as url, Robot(url) as robot:
        robot.register()
        for number in range(3):
            robot.cycle(number)
            in_time(lambda: incidents(robot) == [("model", number == 2)])  # noqa: B023


def test_a_robots_clock_that_is_set_is_named(robot: Robot) -> None:
    for sequence in range(4):
        now = time.time() + (3600 if sequence >= 2 else 0)
        robot.send(sequence, robot_time=now, robot_uptime=time.monotonic())
    (one,) = robot.overview()["incidents"]
    assert one["kind"] == "clock"
    assert "robot's clock was set 3600 s ahead" in one["text"]


def test_keyframes_that_were_long_under_way_set_no_clock(robot: Robot) -> None:
    """The sidecar was away for 9 s; the keyframes that waited for it carry earlier times."""
    for sequence, waited_s in enumerate((9.0, 9.0, 0.0, 0.0)):
        sent = time.monotonic() - waited_s
        robot.send(sequence, robot_time=time.time() - waited_s, robot_uptime=sent)
    assert robot.overview()["incidents"] == []


def test_one_late_word_is_no_leap() -> None:
    clock = ClockWatch()
    said = [(100.0, 0.0), (101.0, 1.0), (102.0, 12.0), (113.0, 13.0), (4000.0, 14.0)]
    assert [clock.look(*one) for one in said] == [0.0] * 5
    assert clock.look(4001.0, 15.0) == pytest.approx(3886.0)
    assert clock.look(4002.0, 16.0) == 0.0


def test_a_lost_link_is_told_by_the_robot(robot: Robot) -> None:
    body = {"kind": "link", "seconds": 31.0, "text": "It gave no answer."}
    assert robot.post("incident", body).status_code == 200
    (one,) = robot.overview()["incidents"]
    assert one["ended"] - one["at"] == pytest.approx(31.0)
    assert "The robot was not served for 31 s." in one["text"]
    assert robot.post("incident", body | {"kind": "else"}).status_code == 422


def test_a_run_that_is_not_as_rehearsed_is_trouble_until_it_ends(robot: Robot) -> None:
    text = "The run did otherwise than its rehearsal."
    body = {"kind": "layer1", "seconds": 0.0, "text": text}
    assert robot.post("incident", body).status_code == 200
    assert incidents(robot) == [("layer1", False)]
    words = {"verdict": "not as rehearsed", "note": f"{text} What was run ..."}
    ended = {"outcome": "succeeded", "detail": "", "layer1": words}
    assert robot.post("finish", ended).status_code == 200
    assert incidents(robot) == [("layer1", True)]
    assert robot.overview()["layer1"]["verdict"] == "not as rehearsed"
    report = robot.http.get(f"/runs/{robot.run}/report.html").text
    assert "Not as rehearsed." in report
    for page in (report, robot.http.get("/runs").text):
        assert "ended, not as rehearsed" in page
        assert 'class="badge succeeded"' not in page
    assert "No findings" not in report


def test_a_pause_of_layer_1_is_shown_as_one(robot: Robot) -> None:
    robot.cycle(0)
    hold = {"number": 0, "trajectory": 0, "seconds": 0.0, "resolution": "layer1", "policy": "pause"}
    assert robot.post("hold", hold).status_code == 200
    assert "The next step breaks a rule" in robot.http.get(f"/runs/{robot.run}").text
