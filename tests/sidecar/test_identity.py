"""A run's name that is used twice: no verdict stands on frames of another start."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.errors import SidecarRefused
from aegis_ot.runtime.keyframe_sender import KeyframeSender
from aegis_ot.runtime.sidecar_client import SidecarClient
from aegis_ot.settings import Settings
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.store import Store
from aegis_ot.vocabulary import to_json

from ..runtime.live import LiveRun
from .helpers import Robot, StubAnalyser, StubCamera, make_keyframe

ABOUT = {"protocol": "demo.py", "robot": "OT-2", "robot_name": "ada", "started": 5.5}


def guard_of(url: str, nonce: str, run: str = "plate", **about: Any) -> KeyframeSender:
    link = SidecarClient(url, None, lambda: None, nonce)
    return KeyframeSender(link, run, ABOUT | about, time.sleep)


def deliver(
    sender: KeyframeSender, trajectory: int, timeout_s: float = 60.0, **changes: Any
) -> None:
    for number in range(4 * trajectory, 4 * trajectory + 4):
        sender.offer(make_keyframe("plate", number, robot_time=9.0, **changes))
        sender.deliver(timeout_s)


def fill(volume: float, wells: int = 2) -> Any:
    def protocol(context: Any) -> None:
        tips = context.load_labware("opentrons_96_tiprack_300ul", "1")
        source = context.load_labware("nest_12_reservoir_15ml", "2")["A1"]
        plate = context.load_labware("corning_96_wellplate_360ul_flat", "3")
        pipette = context.load_instrument("p300_single_gen2", "left", [tips])
        pipette.transfer(volume, source, plate.wells()[:wells], new_tip="always")

    return protocol


def test_a_second_run_of_the_same_name_is_looked_at(config: SidecarConfig) -> None:
    """Another plate, another volume, a dead camera, and the name of a run that passed."""
    camera = StubCamera()
    with running_sidecar(config, camera, StubAnalyser()) as url:
        settings = Settings(sidecar=url, run_id="plate", on_link_loss="continue")
        first = LiveRun(fill(100), settings).start().join()
        assert first.watcher is not None
        assert first.watcher.summary().startswith("Layer 2 watched 2 deliveries: 2 passed")
        camera.failure = OSError("unplugged")
        blind = replace(settings, capture_timeout_s=0.5)
        second = LiveRun(fill(50), blind).start().join()
        assert second.watcher is not None
        assert second.watcher.summary().startswith("Layer 2 watched 2 deliveries: 0 passed")
        comments = [c.params.message for c in second.commands if c.commandType == "comment"]
        assert any("another run 'plate'; this one is watched as 'plate-2'" in c for c in comments)
        with Robot(url, "plate-2") as reader:
            (told,) = [i for i in reader.overview()["incidents"] if i["kind"] == "identifier"]
            assert "began this run as 'plate', which names another run already" in told["text"]
            page = reader.http.get("/runs/plate-2").text
            report = reader.http.get("/runs/plate-2/report.html").text
        assert "began this run as" in page
        assert "began this run as" in report


def test_two_robots_with_one_name_are_two_runs(config: SidecarConfig) -> None:
    with running_sidecar(config, StubCamera(), StubAnalyser(fails=[1])) as url:
        a, b = guard_of(url, "a" * 32), guard_of(url, "b" * 32)
        for trajectory in range(2):
            deliver(a, trajectory)
            deliver(b, trajectory)
        assert (a.run, b.run) == ("plate", "plate-2")
        b.finish("succeeded", "", {}, 60.0)
        with Robot(url, "plate") as reader:
            assert reader.overview()["finished"] is None
    store = Store(config.data)
    assert len(store.keyframes("plate")) == len(store.keyframes("plate-2")) == 8
    store.close()


def test_the_same_start_told_again_goes_on(config: SidecarConfig) -> None:
    for number in range(3):
        with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
            again = guard_of(url, "a" * 32)
            again.register(60.0)
            again.register(60.0)
            again._sent = [make_keyframe("plate", n, robot_time=9.0) for n in range(4 * number)]
            deliver(again, number)
            assert again.run == "plate"
    store = Store(config.data)
    assert [row["run"] for row in store.runs()] == ["plate"]
    assert len(store.keyframes("plate")) == 12
    store.close()


def test_after_the_store_was_lost_no_robot_speaks_into_the_run_of_another(
    config: SidecarConfig, tmp_path: Path
) -> None:
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
        port = int(url.rsplit(":", 1)[1])
        a, b = guard_of(url, "a" * 32), guard_of(url, "b" * 32)
        deliver(a, 0)
        deliver(b, 0)
    lost = config.model_copy(update={"data": tmp_path / "lost", "port": port})
    with running_sidecar(lost, StubCamera(), StubAnalyser()) as url:
        b.run = "plate"  # as a robot that was quicker
        b.register(60.0)
        deliver(a, 1)
        deliver(b, 1)
        assert (a.run, b.run) == ("plate-2", "plate")
        assert a.forgotten == b.forgotten == {0}
        with Robot(url, "plate-2") as reader:
            lateness = [
                [k["late"] for k in t["keyframes"]] for t in reader.overview()["trajectories"]
            ]
    assert lateness == [[True] * 4, [False] * 4]


class TestOlderGuards:
    """Without a nonce a start is known by its robot, its protocol and its moment."""

    def test_the_same_start_goes_on(self, config: SidecarConfig) -> None:
        with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
            robot.register()
            robot.cycle(0)
            assert robot.register().status_code == 200
            robot.cycle(1)

    def test_another_start_is_refused(self, config: SidecarConfig) -> None:
        with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
            guard_of(url, "", "plate").register(60.0)
            second = guard_of(url, "", "plate", started=6.5)
            with pytest.raises(
                SidecarRefused, match=r"another one already \(demo.py, on ada, begun"
            ):
                second.register(60.0)

    def test_they_do_not_speak_into_the_run_of_a_newer_guard(self, config: SidecarConfig) -> None:
        with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
            deliver(guard_of(url, "a" * 32), 0)
            with Robot(url, "plate") as older:
                for answer in (
                    older.send(0), older.send(4), older.post("finish", {"outcome": "succeeded"}),
                    older.http.get("/v1/runs/plate/trajectories/0/verdict"),
                ):  # fmt: skip
                    assert (answer.status_code, answer.json()["error"]["code"]) == (
                        409, "other_start",
                    )  # fmt: skip


@pytest.mark.parametrize(
    "changes",
    [{"commanded_ul": 50.0}, {"tip": "1:B1"}, {"robot_time": 7.0}, {"position": (1.0, 2.0, 3.0)}],
)
def test_a_keyframe_is_the_same_only_if_all_of_it_is(robot: Robot, changes: dict[str, Any]) -> None:
    assert robot.send(0).status_code == 200
    answer = robot.send(0, **changes)
    assert (answer.status_code, answer.json()["error"]["code"]) == (409, "taken")


@pytest.mark.parametrize("judged", [True, False])
def test_a_capture_that_the_robot_did_not_wait_for_passes_nothing(
    robot: Robot, judged: bool, analyser: StubAnalyser
) -> None:
    """The camera was slow: the robot moved on, and the frame came after all."""
    if not judged:
        analyser.gate.clear()
    robot.cycle(0)
    if judged:
        assert robot.verdict(0)["verdict"]["outcome"] == "pass"
    assert robot.send(3, late=True).status_code == 200
    analyser.gate.set()
    assert robot.verdict(0)["verdict"]["outcome"] == "undecided"
    (trajectory,) = robot.overview()["trajectories"]
    assert trajectory["verdict"]["outcome"] == "undecided"
    assert "moved on" in trajectory["verdict"]["reason"]


def test_a_frame_that_came_after_the_robot_had_gone_on_is_none(
    robot: Robot, camera: StubCamera
) -> None:
    """The last keyframe of the last delivery: nobody sends it again."""
    for sequence in range(3):
        robot.send(sequence)
    camera.age = -1.0
    late = to_json(make_keyframe("run-1", 3))
    answer = robot.http.post("/v1/runs/run-1/keyframes", params={"stands": 0.5}, json=late)
    assert (answer.status_code, answer.json()["error"]["code"]) == (503, "camera")
    assert "after the robot may have gone on" in answer.json()["error"]["message"]
    (trajectory,) = robot.overview()["trajectories"]
    assert trajectory["verdict"] is None
    camera.age = 0.0
    assert robot.send(3).status_code == 200
    assert robot.verdict(0)["verdict"]["outcome"] == "pass"
