"""A guarded run on Opentrons' own engine, a real sidecar, and an operator at its page."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

import httpx
import pytest

from aegis_ot.errors import CameraError
from aegis_ot.run_view.situation import situations
from aegis_ot.runtime.sidecar_client import SidecarClient
from aegis_ot.settings import Settings
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from tests.runtime.fake_sidecar import free_port
from tests.runtime.live import LiveRun
from tests.runtime.test_live import in_time, two_wells
from tests.runtime.test_page_answers import RobotServer, robot

from .browser import CHROMIUM, chromium
from .helpers import StubAnalyser, StubCamera

__all__ = ["robot"]  # a fixture


class Stage:
    """The run, and the page that a person has open."""

    def __init__(self, url: str, run: LiveRun) -> None:
        self.run = run
        self.http = httpx.Client(base_url=url, trust_env=False, timeout=60)

    def overview(self) -> dict[str, Any]:
        answer: dict[str, Any] = self.http.get("/v1/runs/run").json()
        return answer

    def asked(self) -> list[str]:
        """What the page asks; nothing while the sidecar has not heard of the run."""
        answer = self.http.get("/v1/runs/run")
        known = answer.status_code == 200
        return [one.kind for one in situations(answer.json(), time.time())] if known else []

    def answer(self, words: str) -> None:
        form = {"by": "Ada", "note": "a drop", "answer": words}
        assert self.http.post("/runs/run/wells/0", data=form).status_code == 303


@pytest.fixture
def stage(config: SidecarConfig, robot: RobotServer) -> Iterator[Stage]:
    with running_sidecar(config, StubCamera(), StubAnalyser(fails=[0])) as url:
        settings = Settings(sidecar=url, run_id="run")
        run = robot.run = LiveRun(two_wells, settings).start()
        run.wait_for_status("paused")
        stage = Stage(url, run)
        in_time(lambda: stage.asked() == ["paused"])
        yield stage
        stage.http.close()


def test_a_well_is_put_right_and_the_run_resumed_from_the_page(
    stage: Stage, robot: RobotServer
) -> None:
    assert "partial dispense" in stage.http.get("/").text
    stage.answer("pass resume")
    stage.run.join()
    assert stage.run.error is None
    assert robot.told == [("/runs/abc/actions", "play")]
    first = stage.overview()["trajectories"][0]
    assert (first["verdict"]["outcome"], first["decisions"][0]["by"]) == ("pass", "Ada")
    assert first["holds"][0]["answered"] == "page"
    assert stage.asked() == []
    assert stage.run.watcher is not None
    assert "2 passed" in stage.run.watcher.summary()
    report = stage.http.get("/runs/run/report.html").text
    assert "Ada" in report
    assert "answered at the page" in report


def test_a_run_is_stopped_from_the_page(stage: Stage, robot: RobotServer) -> None:
    stage.answer("stop")
    stage.run.join()
    assert stage.run.error is not None
    in_time(lambda: stage.overview()["finished"] is not None)
    overview = stage.overview()
    assert overview["finished"]["outcome"] == "stopped"
    assert [(one["action"], one["by"]) for one in overview["actions"]] == [("stop", "Ada")]


def test_a_moving_robot_is_paused_and_resumed_and_an_old_answer_does_not_count(
    config: SidecarConfig, robot: RobotServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    camera = StubCamera()
    camera.gate.clear()
    asked: list[int] = []
    action = SidecarClient.action

    def ask(link: SidecarClient, *told: Any) -> str | None:
        answer = action(link, *told)
        asked.append(told[1])
        return answer

    monkeypatch.setattr(SidecarClient, "action", ask)
    with running_sidecar(config, camera, StubAnalyser(fails=[0])) as url:
        run = robot.run = LiveRun(two_wells, Settings(sidecar=url, run_id="run")).start()
        stage = Stage(url, run)
        in_time(lambda: stage.http.get("/v1/runs/run").status_code == 200)
        form = {"by": "Ada", "note": "wrong plate?", "answer": "pause"}
        assert stage.http.post("/runs/run/order", data=form).status_code == 303
        assert stage.asked() == ["ordered"]
        camera.gate.set()
        run.wait_for_status("paused")
        in_time(lambda: stage.asked() == ["paused"])
        assert "Ada paused the robot" in stage.http.get("/").text
        stage.answer("resume")
        # The same delivery fails later: what was said to the first pause must not end this one.
        in_time(lambda: any("failed" in c.params.message for c in pauses(run)))
        in_time(lambda: stage.asked() == ["paused"])
        before = len(asked)
        in_time(lambda: len(asked) > before + 1)
        assert run.status == "paused"
        assert [action for _, action in robot.told] == ["play"]
        stage.answer("stop")
        run.join()
        in_time(lambda: stage.overview()["finished"] is not None)
        assert [(a["action"], a["by"]) for a in stage.overview()["actions"]] == [
            ("pause", "Ada"), ("resume", "Ada"), ("stop", "Ada"),
        ]  # fmt: skip
        stage.http.close()


@pytest.fixture
def unseen(config: SidecarConfig, robot: RobotServer) -> Iterator[tuple[Stage, StubCamera]]:
    """A run whose camera was unplugged before the first frame."""
    camera = StubCamera()
    camera.failure = CameraError("the cable is out")
    with running_sidecar(config, camera, StubAnalyser()) as url:
        settings = Settings(sidecar=url, run_id="run", capture_timeout_s=1.0)
        run = robot.run = LiveRun(two_wells, settings).start()
        stage = Stage(url, run)
        yield stage, camera
        stage.http.close()


def test_a_robot_that_its_camera_paused_is_shown_and_resumed_from_the_page(
    unseen: tuple[Stage, StubCamera], robot: RobotServer
) -> None:
    stage, camera = unseen
    in_time(lambda: stage.asked() == ["paused", "camera"])
    page = stage.http.get("/").text
    assert "The camera gave no frame" in page
    assert "the cable is out" in page
    camera.failure = None
    stage.answer("resume")
    stage.run.join()
    assert stage.run.error is None
    assert [action for _, action in robot.told] == ["play"]
    holds = stage.overview()["trajectories"][0]["holds"]
    assert [(h["resolution"], h["answered"]) for h in holds[:1]] == [("camera", "page")]
    assert stage.run.watcher is not None
    assert "2 passed" in stage.run.watcher.summary()


def test_a_robot_that_its_camera_paused_is_stopped_from_the_page(
    unseen: tuple[Stage, StubCamera], robot: RobotServer
) -> None:
    stage, _ = unseen
    in_time(lambda: "paused" in stage.asked())
    stage.answer("stop")
    stage.run.join()
    assert [action for _, action in robot.told] == ["stop"]
    in_time(lambda: stage.overview()["finished"] is not None)
    assert stage.overview()["finished"]["outcome"] == "stopped"


def test_a_stop_is_heard_while_the_robot_tries_its_camera_again(
    config: SidecarConfig, robot: RobotServer
) -> None:
    camera = StubCamera()
    camera.failure = CameraError("the cable is out")
    with running_sidecar(config, camera, StubAnalyser()) as url:
        settings = Settings(sidecar=url, run_id="run", capture_timeout_s=600.0)
        run = robot.run = LiveRun(two_wells, settings).start()
        stage = Stage(url, run)
        in_time(lambda: len(camera.announced) > 1)
        form = {"by": "Ada", "answer": "stop"}
        assert stage.http.post("/runs/run/order", data=form).status_code == 303
        run.join()
        assert [action for _, action in robot.told] == ["stop"]
        stage.http.close()


def test_a_robot_that_lost_its_sidecar_is_shown_as_paused_once_that_is_back(
    config: SidecarConfig, robot: RobotServer
) -> None:
    camera = StubCamera()
    camera.gate.clear()
    port = free_port()
    config = config.model_copy(update={"port": port})
    with running_sidecar(config, camera, StubAnalyser()) as url:
        settings = Settings(sidecar=url, run_id="run", capture_timeout_s=1.0)
        run = robot.run = LiveRun(two_wells, settings).start()
        in_time(lambda: len(camera.announced) > 0)
    run.wait_for_status("paused")
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
        stage = Stage(url, run)
        in_time(lambda: stage.asked() == ["paused"])
        assert "The robot had no link" in stage.http.get("/").text
        stage.answer("resume")
        run.join()
        assert run.error is None
        assert [action for _, action in robot.told] == ["play"]
        assert run.watcher is not None
        assert "2 passed" in run.watcher.summary()
        stage.http.close()


def pauses(run: LiveRun) -> list[Any]:
    return [command for command in run.seen() if command.commandType == "waitForResume"]


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on this machine")
def test_pause_resume_and_stop_are_pressed_while_the_robot_moves(
    config: SidecarConfig, robot: RobotServer
) -> None:
    camera = StubCamera()
    camera.gate.clear()
    with running_sidecar(config, camera, StubAnalyser()) as url, chromium() as tab:
        run = robot.run = LiveRun(two_wells, Settings(sidecar=url, run_id="run")).start()
        tab.open(url)
        tab.until("document.querySelector('#order button[value=pause]')")
        tab.run("document.querySelector('#order input[name=by]').value = 'Ada'")
        tab.run("document.querySelector('#order button[value=pause]').click()")
        tab.until("document.querySelector('.ask.ordered').textContent.includes('Ada told')")
        camera.gate.set()
        tab.until("document.querySelector('.ask.paused button[value=resume]')")
        assert run.status == "paused"
        assert tab.run("document.querySelector('#order button')") is None
        camera.gate.clear()  # the robot stands at its next keyframe
        tab.run("document.querySelector('.ask.paused button[value=resume]').click()")
        in_time(lambda: bool(robot.told))  # a stop that comes sooner is all that it hears
        tab.until("document.querySelector('#order button[value=stop]')")
        # The name is remembered; the second press needs the fold opened.
        tab.run("document.querySelector('#stop summary').click()")
        tab.run("document.querySelector('#order button[value=stop]').click()")
        tab.until("document.querySelector('.ask.ordered').textContent.includes('end the run')")
        camera.gate.set()
        run.join()
        tab.until("document.querySelector('#state').textContent.includes('Stopped by a person')")
        assert [action for _, action in robot.told] == ["play", "stop"]
        assert tab.errors == []
