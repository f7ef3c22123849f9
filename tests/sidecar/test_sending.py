"""People are told, through Apprise, over a real socket."""

from __future__ import annotations

import base64
import json
import queue
import re
import threading
import time
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, HTTPServer
from typing import Any

import pytest
from pydantic import SecretStr

from aegis_ot.errors import CameraError, ConfigurationError
from aegis_ot.sidecar import SidecarConfig, create_app, running_sidecar
from aegis_ot.sidecar.alerts import Notice
from aegis_ot.sidecar.alerts.sending import Notification, Notifier
from aegis_ot.sidecar.config import NotificationSettings

from .helpers import Robot, StubAnalyser, StubCamera


class Inbox:
    """A web hook; ``broken`` makes it refuse, ``gate`` makes it wait."""

    def __init__(self) -> None:
        self.received: queue.Queue[dict[str, Any]] = queue.Queue()
        self.reached = threading.Event()
        self.tries = 0
        self.broken = False
        self.gate = threading.Event()
        self.gate.set()
        owner = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
                owner.reached.set()
                owner.gate.wait(60)
                owner.tries += 1
                if not owner.broken:
                    owner.received.put(body)
                self.send_response(500 if owner.broken else 200)
                self.end_headers()

            def log_message(self, *_: object) -> None:
                """Quiet."""

        self.server = HTTPServer(("127.0.0.1", 0), Handler)
        self.url = f"json://127.0.0.1:{self.server.server_port}/hook"

    def next(self) -> dict[str, Any]:
        return self.received.get(timeout=60)


@pytest.fixture
def inbox() -> Iterator[Inbox]:
    inbox = Inbox()
    threading.Thread(target=inbox.server.serve_forever, args=(0.02,), daemon=True).start()
    yield inbox
    inbox.gate.set()
    inbox.server.shutdown()
    inbox.server.server_close()


def told(config: SidecarConfig, *urls: str) -> SidecarConfig:
    settings = NotificationSettings(urls=tuple(map(SecretStr, urls)))
    return config.model_copy(update={"notifications": settings, "url": "http://lab:7645"})


def test_a_message_says_well_protocol_robot_what_was_seen_and_what_to_do(
    config: SidecarConfig, inbox: Inbox
) -> None:
    analyser = StubAnalyser(fails=[1])
    with running_sidecar(told(config, inbox.url), StubCamera(), analyser) as at, Robot(at) as robot:
        about = {"run": "run-1", "protocol": "demo.py", "robot_name": "lab-3"}
        robot.http.put("/v1/runs/run-1", json=about)
        for trajectory in (0, 1):
            robot.cycle(trajectory)
        message = inbox.next()
    for said in ("A2 of plate (slot 4)", "partial dispense", "demo.py"):
        assert said in message["title"]
    for said in ("demo.py on lab-3", "52 µL stayed", "confirm or correct",
                 "http://lab:7645/runs/run-1?well=1"):  # fmt: skip
        assert said in message["message"]
    pictures = message["attachments"]
    assert len(pictures) == 4
    assert base64.b64decode(pictures[0]["base64"]).startswith(b"\xff\xd8")


def test_people_who_heard_of_a_failure_hear_that_it_was_put_right(
    config: SidecarConfig, inbox: Inbox
) -> None:
    analyser = StubAnalyser(fails=[0])
    with running_sidecar(told(config, inbox.url), StubCamera(), analyser) as at, Robot(at) as robot:
        robot.register()
        for trajectory in (0, 1):
            robot.cycle(trajectory)
        assert "partial dispense" in inbox.next()["title"]
        about = {"trajectory": 0, "attempt": 1, "action": "retry", "text": "With a fresh tip."}
        for change in ({"state": "begun"}, {"state": "recovered", "by": 1}):
            robot.post("recovery", about | change).raise_for_status()
        message = inbox.next()
        assert "A1 of plate (slot 4): put right by the robot" in message["title"]
        assert "Nothing has to be done" in message["message"]
        assert inbox.received.empty()


def test_trouble_is_told_once_until_it_is_over(config: SidecarConfig, inbox: Inbox) -> None:
    camera = StubCamera()
    with (
        running_sidecar(told(config, inbox.url), camera, StubAnalyser()) as at,
        Robot(at) as robot,
    ):
        robot.register()
        camera.failure = CameraError("the cable is out")
        for _ in range(5):
            assert robot.send(0).status_code == 503
        assert "the camera gives no frame" in inbox.next()["title"]
        camera.failure = None
        robot.send(0)
        camera.failure = CameraError("out again")
        robot.send(1)
        assert "out again" in inbox.next()["message"]
        robot.post("hold", {"number": 0, "trajectory": 3, "seconds": 30, "resolution": "timeout"})
        assert "a hold ended without a verdict" in inbox.next()["title"]
        assert inbox.received.empty()
        incidents = robot.overview()["incidents"]
        assert [(one["kind"], one["ended"] is None) for one in incidents] == [
            ("camera", False), ("camera", True),
        ]  # fmt: skip


def test_what_waits_of_one_kind_goes_into_one_message_and_no_verdict_waits(
    config: SidecarConfig, inbox: Inbox
) -> None:
    inbox.gate.clear()
    analyser = StubAnalyser(fails=range(6))
    with running_sidecar(told(config, inbox.url), StubCamera(), analyser) as at, Robot(at) as robot:
        robot.register()
        robot.cycle(0)
        robot.verdict(0)
        assert inbox.reached.wait(60)  # the first is on its way; the others pile up behind it
        for trajectory in range(1, 6):
            robot.cycle(trajectory)
            assert robot.verdict(trajectory)["verdict"]["outcome"] == "fail"
        assert inbox.received.empty()
        inbox.gate.set()
        titles, wells = [], 0
        while wells < 6:  # what the last well has to tell may come a moment after its verdict
            titles.append(inbox.next()["title"])
            more = re.search(r"and (\d+) more", titles[-1])
            wells += 1 + int(more[1] if more else 0)
        assert len(titles) <= 3
        assert (wells, inbox.received.empty()) == (6, True)


def test_one_message_for_all_that_waits_of_one_kind(inbox: Inbox) -> None:
    inbox.gate.clear()
    notifier = Notifier(
        [SecretStr(inbox.url)], lambda ns: Notification(f"{len(ns)} {ns[0].kind}", "-")
    )
    notifier.send(Notice("run", "fail", "a well failed", "seen"))
    assert inbox.reached.wait(60)
    for kind in ("fail", "camera", "fail", "fail"):
        notifier.send(Notice("run", kind, "more", "seen"))
    inbox.gate.set()
    assert [inbox.next()["title"] for _ in range(3)] == ["1 fail", "3 fail", "1 camera"]
    notifier.close(20)


def test_a_wrong_address_is_refused_at_start_and_not_shown(config: SidecarConfig) -> None:
    with pytest.raises(ConfigurationError, match="number 2 is not one") as caught:
        create_app(told(config, "json://127.0.0.1/", "nonsense-s3cret"), StubCamera())
    assert "s3cret" not in str(caught.value)
    create_app(config, StubCamera()).state.sidecar.close()  # nothing was left locked


def test_what_cannot_be_sent_is_tried_again_and_shown(inbox: Inbox) -> None:
    inbox.broken = True
    failed: list[str] = []
    notifier = Notifier(
        [SecretStr(inbox.url)], None, lambda notice, why: failed.append(why), retries_s=(0.05, 0.05)
    )
    notifier.send(Notice("run", "fail", "a well failed", "seen"))
    until = time.monotonic() + 60
    while not failed and time.monotonic() < until:
        time.sleep(0.02)
    assert inbox.tries == 3
    assert "number 1 could not be reached" in notifier.trouble
    inbox.broken = False
    notifier.send(Notice("run", "fail", "another", "seen"))
    assert "another" in inbox.next()["title"]
    notifier.close(20)
    assert notifier.trouble == ""
