"""A paused run is resumed or stopped from the sidecar's page, through the robot's own server."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import pytest

from aegis_ot.runtime import page_answers

from .fake_sidecar import FakeSidecar
from .live import LiveRun
from .test_live import in_time, settings, two_wells


class RobotServer:
    """In place of the robot's own HTTP server, which no registry has; does as it is told."""

    def __init__(self) -> None:
        self.run: LiveRun | None = None
        self.told: list[tuple[str, str]] = []
        self.status = 201
        self.hangs_up = False
        owner = self

        class Answers(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_GET(self) -> None:
                assert self.headers["Opentrons-Version"] == "*"
                self.say(200, {"links": {"current": {"href": "/runs/abc"}}})

            def do_POST(self) -> None:
                body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
                owner.told.append((self.path, body["data"]["actionType"]))
                if owner.hangs_up:
                    self.close_connection = True
                    return
                assert owner.run is not None
                self.say(owner.status, {})
                if owner.status == 201:
                    owner.run.play() if owner.told[-1][1] == "play" else owner.run.stop()

            def say(self, status: int, body: Any) -> None:
                data = json.dumps(body).encode()
                self.send_response(status)
                self.send_header("Content-Length", str(len(data)))
                self.end_headers()
                self.wfile.write(data)

            def log_message(self, *_: object) -> None:
                """Quiet."""

        self.server = ThreadingHTTPServer(("127.0.0.1", 0), Answers)


@pytest.fixture
def robot(monkeypatch: pytest.MonkeyPatch) -> Iterator[RobotServer]:
    robot = RobotServer()
    threading.Thread(target=robot.server.serve_forever, args=(0.02,), daemon=True).start()
    host, port = robot.server.server_address[:2]
    monkeypatch.setattr(page_answers, "ROBOT_SERVER", f"http://{host}:{port}")
    yield robot
    robot.server.shutdown()
    robot.server.server_close()


@pytest.fixture
def paused(robot: RobotServer) -> Iterator[tuple[LiveRun, FakeSidecar]]:
    with FakeSidecar() as sidecar:
        sidecar.outcomes[0] = "fail"
        run = robot.run = LiveRun(two_wells, settings(sidecar)).start()
        run.wait_for_status("paused")
        yield run, sidecar


def test_resume_on_the_page_plays_the_run(
    robot: RobotServer, paused: tuple[LiveRun, FakeSidecar]
) -> None:
    run, sidecar = paused
    sidecar.actions[0] = "resume"
    run.join()
    assert run.error is None
    assert robot.told == [("/runs/abc/actions", "play")]
    told = [hold for hold in sidecar.holds if "answered" in hold]
    assert [hold["answered"] for hold in told] == ["page"]
    assert told[0]["paused_s"] > 0


def test_stop_on_the_page_stops_the_run(
    robot: RobotServer, paused: tuple[LiveRun, FakeSidecar]
) -> None:
    run, sidecar = paused
    sidecar.actions[0] = "stop"
    run.join()
    assert run.error is not None
    assert robot.told == [("/runs/abc/actions", "stop")]
    assert [finish["outcome"] for finish in sidecar.finished] == ["stopped"]


def test_the_robots_own_screen_still_resumes(
    robot: RobotServer, paused: tuple[LiveRun, FakeSidecar]
) -> None:
    run, sidecar = paused
    run.play()
    run.join()
    assert run.error is None
    assert robot.told == []
    assert [hold["answered"] for hold in sidecar.holds if "answered" in hold] == ["robot"]


def test_a_robot_that_refuses_is_asked_again(
    robot: RobotServer, paused: tuple[LiveRun, FakeSidecar]
) -> None:
    run, sidecar = paused
    robot.status = 409
    sidecar.actions[0] = "resume"
    in_time(lambda: len(robot.told) >= 1)
    robot.status = 201
    run.join()
    assert run.error is None


def test_an_order_that_was_taken_without_an_answer_is_not_given_twice(robot: RobotServer) -> None:
    robot.hangs_up = True
    assert not page_answers.act_on_current_run("play")
    assert robot.told == [("/runs/abc/actions", "play")]
