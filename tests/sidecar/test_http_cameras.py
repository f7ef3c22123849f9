"""Network cameras as they speak on the wire, each frame holding the moment of its exposure."""

from __future__ import annotations

import base64
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from http.server import BaseHTTPRequestHandler

import numpy as np
import pytest

from aegis_ot.doctor import examine
from aegis_ot.errors import CameraError
from aegis_ot.sidecar import SidecarConfig
from aegis_ot.sidecar.cameras import open_camera
from aegis_ot.sidecar.cameras.codec import encode_jpeg
from aegis_ot.sidecar.cameras.http import UNKNOWN_PACE_S, Pace
from aegis_ot.sidecar.config import CameraSettings
from aegis_ot.vision.types import Image

from .helpers import until
from .test_cameras import web_camera

PERIOD_S = 0.12
LAG_S = 0.1
SPARE_S = 0.06
"""How late a busy machine may hand on a picture; half a period, so that an older one shows."""
_BITS = 24
_ORIGIN = time.monotonic()


def picture_of(moment: float) -> bytes:
    """A JPEG that holds a moment, ms after the tests' origin: one square for each bit."""
    number = int((moment - _ORIGIN) * 1000)
    bits = [255 * (number >> bit & 1) for bit in range(_BITS)]
    return encode_jpeg(np.kron(np.array([bits], np.uint8), np.ones((16, 16), np.uint8))[..., None]
                       .repeat(3, 2))  # fmt: skip


def moment_in(image: Image) -> float:
    squares = image[8, 8::16, 0] > 127
    return _ORIGIN + sum(1 << bit for bit, is_set in enumerate(squares) if is_set) / 1000


class Sensor:
    """Exposes a picture every ``PERIOD_S``; hands on the newest, or one that many older, each
    ``lag`` s after its exposure.
    """

    def __init__(self, behind: int = 0, lag: float = 0.0) -> None:
        self._lag = lag
        first = picture_of(time.monotonic() - lag)
        self.taken: deque[bytes] = deque([first] * (behind + 1), behind + 1)
        self.count = 0
        self.news = threading.Condition()
        self.over = threading.Event()
        threading.Thread(target=self._expose, daemon=True).start()

    def close(self) -> None:
        self.over.set()

    @property
    def picture(self) -> bytes:
        with self.news:
            return self.taken[0]

    def next(self, seen: int) -> tuple[int, bytes]:
        """The first picture after so many."""
        with self.news:
            self.news.wait_for(lambda: self.count > seen or self.over.is_set())
            return self.count, self.taken[0]

    def _expose(self) -> None:
        while not self.over.wait(PERIOD_S):
            picture = picture_of(time.monotonic() - self._lag)
            with self.news:
                self.taken.append(picture)
                self.count += 1
                self.news.notify_all()


def _stream(sensor: Sensor, with_length: bool, piled: int = 0) -> Callable[..., None]:
    """MJPEG; ``piled``: at the fifth picture the way is blocked until so many have piled up."""

    def answer(handler: BaseHTTPRequestHandler) -> None:
        handler.send_response(200)
        handler.send_header("Content-Type", "multipart/x-mixed-replace; boundary=frame")
        handler.end_headers()
        seen, sent, waiting = 0, 0, b""
        while not sensor.over.is_set():
            seen, jpeg = sensor.next(seen)
            length = f"Content-Length: {len(jpeg)}\r\n" if with_length else ""
            head = f"--frame\r\nContent-Type: image/jpeg\r\n{length}\r\n".encode()
            sent, waiting = sent + 1, waiting + head + jpeg + b"\r\n"
            if not 5 <= sent < 5 + piled:
                handler.wfile.write(waiting)
                waiting = b""

    return answer


def _snapshot(sensor: Sensor) -> Callable[..., None]:
    """One picture a request, the same until the sensor has a new one."""

    def answer(handler: BaseHTTPRequestHandler) -> None:
        jpeg = sensor.picture
        handler.send_response(200)
        handler.send_header("Content-Type", "image/jpeg")
        handler.send_header("Content-Length", str(len(jpeg)))
        handler.end_headers()
        handler.wfile.write(jpeg)

    return answer


@contextmanager
def camera_of(kind: str) -> Iterator[tuple[Sensor, str]]:
    behind = kind.endswith("behind")
    with closing(Sensor(int(behind), LAG_S if "slow" in kind else 0.0)) as sensor:
        if kind.startswith("snapshot"):
            answer = _snapshot(sensor)
        else:
            answer = _stream(sensor, not kind.startswith("no"), 6 if "piled" in kind else 0)
        with web_camera(answer) as (url, _):
            yield sensor, url
            sensor.close()


@pytest.mark.parametrize(
    "kind",
    [
        "lengths",
        "no lengths",
        "lengths, one behind",
        "lengths, slow and one behind",
        "lengths, piled up",
        "snapshots",
    ],
)
def test_a_frame_was_exposed_after_the_moment(kind: str) -> None:
    with camera_of(kind) as (sensor, url):
        latency = SPARE_S + (LAG_S if "slow" in kind else 0.0)
        with closing(open_camera(CameraSettings(spec=url, latency_s=latency))) as camera:
            for number in range(4):
                # At every phase of the camera's period.
                sensor.next(sensor.count)
                sensor.over.wait(number * PERIOD_S / 4)
                moment = time.monotonic()
                frame = camera.frame_after(moment, 60.0)
                assert moment_in(frame.image) >= moment - 0.002  # it holds whole ms


def test_pictures_that_a_server_begins_with_tell_no_pace() -> None:
    pace = Pace()
    for number in range(6):
        pace.next(number / 1000)
    assert pace.longest_s >= UNKNOWN_PACE_S
    for number in range(1, 50):
        pace.next(number / 10)
    assert pace.longest_s == pytest.approx(0.1)


def test_a_picture_that_never_changes_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("aegis_ot.sidecar.cameras.http.SOCKET_TIMEOUT", 0.4)
    with camera_of("snapshots") as (sensor, url):
        sensor.close()
        camera = open_camera(CameraSettings(spec=url))
        until(lambda: "the same picture" in camera.health().detail)
        with pytest.raises(CameraError, match=r"the same picture for 0\.4 s"):
            camera.frame_after(time.monotonic(), 0.05)
        camera.close()


def test_no_other_host_gets_the_password() -> None:
    asked: list[str] = []

    def elsewhere(handler: BaseHTTPRequestHandler) -> None:
        asked.append(handler.headers.get("Authorization", ""))
        handler.send_error(404)

    with web_camera(elsewhere) as (other, _):

        def sends_on(handler: BaseHTTPRequestHandler) -> None:
            handler.send_response(302)
            handler.send_header("Location", other)
            handler.end_headers()

        with web_camera(sends_on) as (url, _):
            camera = open_camera(CameraSettings(spec=url.replace("//", "//ada:secret@")))
            until(lambda: "another host" in camera.health().detail)
            with pytest.raises(CameraError, match="sends on to another host") as told:
                camera.frame_after(time.monotonic(), 0.05)
            camera.close()
    assert asked == []
    assert "secret" not in str(told.value)


def test_a_redirect_on_the_same_host_keeps_the_password() -> None:
    seen: list[str] = []

    def answer(handler: BaseHTTPRequestHandler) -> None:
        seen.append(handler.headers.get("Authorization", ""))
        if handler.path == "/cam":
            handler.send_response(302)
            handler.send_header("Location", "/real")
            handler.end_headers()
        else:
            handler.send_error(404)

    with web_camera(answer) as (url, _):
        camera = open_camera(CameraSettings(spec=url.replace("//", "//ada:secret@")))
        until(lambda: "status 404" in camera.health().detail)
        with pytest.raises(CameraError, match="status 404"):
            camera.frame_after(time.monotonic(), 0.05)
        camera.close()
    assert base64.b64decode(seen[1].removeprefix("Basic ")) == b"ada:secret"


def test_the_doctor_says_what_a_slow_camera_costs(config: SidecarConfig) -> None:
    with camera_of("lengths") as (_, url):
        slow = CameraSettings(spec=url, timeout_s=0.2)
        checks = {one.name: one for one in examine(config.model_copy(update={"camera": slow}))}
    delay = checks["camera's delay"]
    assert (delay.state, "stands up to" in delay.said) == ("bad", True)
    assert "surely of a later moment" in checks["camera"].said
