"""People are told, through Apprise, over a real socket."""

from __future__ import annotations

import json
import queue
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, HTTPServer
from typing import Any

import pytest
from pydantic import SecretStr

from aegis_ot.errors import CameraError
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.config import NotificationSettings
from aegis_ot.sidecar.notifications import Notifier

from .helpers import Robot, StubAnalyser, StubCamera

Inbox = queue.Queue[dict[str, Any]]


@pytest.fixture
def inbox() -> Iterator[tuple[str, Inbox]]:
    received: Inbox = queue.Queue()

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            received.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
            self.send_response(200)
            self.end_headers()

        def log_message(self, *_: object) -> None:
            """Quiet."""

    server = HTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True).start()
    yield f"json://127.0.0.1:{server.server_port}/", received
    server.shutdown()
    server.server_close()


def test_fails_undecided_wells_and_trouble_are_told(
    config: SidecarConfig, inbox: tuple[str, Inbox]
) -> None:
    url, received = inbox
    told = NotificationSettings(urls=(SecretStr(url),))
    camera, analyser = StubCamera(), StubAnalyser(fails=[1], unsure=[2])
    with (
        running_sidecar(config.model_copy(update={"notifications": told}), camera, analyser) as at,
        Robot(at) as robot,
    ):
        robot.register()
        for trajectory in range(3):
            robot.cycle(trajectory)
        first, second = (received.get(timeout=20) for _ in range(2))
        assert "FAIL in run run-1" in first["title"]
        assert "52 µL" in first["message"]
        assert "UNDECIDED" in second["title"]
        camera.failure = CameraError("cable")
        robot.send(12)
        robot.send(12)
        assert "camera trouble" in received.get(timeout=20)["title"]
        robot.post("hold", {"trajectory": 3, "seconds": 30, "resolution": "timeout"})
        assert "hold ended without a verdict" in received.get(timeout=20)["title"]


def test_what_cannot_be_sent_is_logged_and_raises_nothing(
    caplog: pytest.LogCaptureFixture,
) -> None:
    notifier = Notifier([SecretStr("nonsense"), SecretStr("json://127.0.0.1:9/secret")])
    notifier.send("title", "text")
    notifier.close(20)
    notifier.close()
    assert "number 1 is not one" in caplog.text
    assert "could not be delivered: title" in caplog.text
