"""Cameras: free-running, over HTTP, from a folder."""

from __future__ import annotations

import base64
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import numpy as np
import pytest

from aegis_ot.errors import CameraError, ConfigurationError
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.cameras import FreeRunning, open_camera
from aegis_ot.sidecar.cameras.codec import decode_jpeg
from aegis_ot.sidecar.cameras.raw import Raw
from aegis_ot.sidecar.config import CameraSettings

from .helpers import Robot, StubAnalyser, make_jpeg, make_keyframe, until


class HandSource:
    """A source fed by the test."""

    def __init__(self) -> None:
        self.items: list[Raw | Exception] = []
        self.news = threading.Condition()
        self.is_asked = False
        self.opened = 0

    def open(self) -> HandSource:
        self.opened += 1
        return self

    def put(self, *items: Raw | Exception) -> None:
        with self.news:
            self.items.extend(items)
            self.news.notify_all()

    def settled(self) -> None:
        """Wait until the camera has dealt with all that was put and asks for more."""
        with self.news:
            assert self.news.wait_for(lambda: self.is_asked and not self.items, timeout=60)

    def read(self) -> Raw:
        with self.news:
            self.is_asked = True
            self.news.notify_all()
            self.news.wait_for(lambda: self.items, timeout=60)
            if not self.items:
                raise CameraError("fed nothing")
            self.is_asked = False
            item = self.items.pop(0)
        if isinstance(item, Exception):
            raise item
        return item

    def close(self) -> None:
        """Nothing to give back."""


@pytest.fixture
def hand() -> Iterator[tuple[HandSource, FreeRunning]]:
    source = HandSource()
    camera = FreeRunning("hand", source.open)
    yield source, camera
    source.put(CameraError("over"))
    camera.close()


def test_the_first_frame_exposed_after_the_moment(hand: tuple[HandSource, FreeRunning]) -> None:
    source, camera = hand
    source.put(*(Raw(float(moment), make_jpeg(moment)) for moment in range(10, 15)))
    frame = camera.frame_after(12.0, 60.0)
    assert frame.exposed_at == 12.0
    assert abs(int(frame.image[0, 0, 0]) - 12) <= 2
    assert camera.frame_after(12.5, 60.0).exposed_at == 13.0


def test_a_waiting_keyframe_is_woken_by_the_frame(hand: tuple[HandSource, FreeRunning]) -> None:
    source, camera = hand
    threading.Timer(0.1, lambda: source.put(Raw(5.0, make_jpeg()))).start()
    assert camera.frame_after(1.0, 600.0).exposed_at == 5.0


def test_no_frame_in_time_is_told(hand: tuple[HandSource, FreeRunning]) -> None:
    source, camera = hand
    source.put(Raw(1.0, make_jpeg()))
    with pytest.raises(CameraError, match=r"no frame within 0\.1 s"):
        camera.frame_after(2.0, 0.1)


@pytest.mark.parametrize(
    "bad", [b"", b"garbage", make_jpeg()[:-30], b"\xff\xd8\xff\xd9", b"\xff\xd8" + b"x" * 50]
)
def test_frames_that_cannot_be_decoded_are_skipped_and_counted(
    hand: tuple[HandSource, FreeRunning], bad: bytes
) -> None:
    source, camera = hand
    source.put(Raw(1.0, bad), Raw(2.0, bad), Raw(3.0, make_jpeg()))
    assert camera.frame_after(1.0, 60.0).exposed_at == 3.0
    assert camera.undecodable == 2
    assert "2 undecodable" in camera.health().detail


def test_only_undecodable_frames_are_an_error_that_says_so(
    hand: tuple[HandSource, FreeRunning],
) -> None:
    source, camera = hand
    source.put(Raw(1.0, b"garbage"), Raw(2.0, b"garbage"))
    source.settled()
    with pytest.raises(CameraError, match="2 frames after the trigger, but none could be decoded"):
        camera.frame_after(1.0, 0.05)


def test_a_camera_that_dies_is_opened_again(hand: tuple[HandSource, FreeRunning]) -> None:
    source, camera = hand
    source.put(RuntimeError("driver bug"))
    source.settled()
    with pytest.raises(CameraError, match="driver bug"):
        camera.frame_after(1.0, 0.1)
    assert not camera.health().ok
    source.put(Raw(2.0, make_jpeg()))
    assert camera.frame_after(1.0, 60.0).exposed_at == 2.0
    assert camera.health().ok
    assert source.opened == 2


def test_a_camera_that_remembers_gives_the_frame_of_a_moment_that_is_over(
    hand: tuple[HandSource, FreeRunning],
) -> None:
    source, camera = hand
    camera.remember()
    for number in range(100):  # many more than a camera keeps by itself
        source.put(Raw(100 + number / 10, image=np.full((48, 64, 3), number, np.uint8)))
    assert camera.frame_after(109.9, 60.0).exposed_at == pytest.approx(109.9)
    frame = camera.frame_after(101.95, 0.1)
    assert frame.exposed_at == pytest.approx(102.0)
    assert abs(int(frame.image.mean()) - 20) <= 1
    source.put(Raw(130.0, make_jpeg()))
    assert camera.frame_after(130.0, 60.0).exposed_at == 130.0
    assert camera.frame_after(101.95, 0.1).exposed_at == 130.0  # the others are forgotten


def test_a_closed_camera_wakes_who_waits() -> None:
    source = HandSource()
    camera = FreeRunning("hand", source.open)
    threading.Timer(0.1, lambda: (source.put(CameraError("over")), camera.close())).start()
    with pytest.raises(CameraError):
        camera.frame_after(1.0, 600.0)


# Over HTTP


@contextmanager
def web_camera(
    answer: Callable[[BaseHTTPRequestHandler], None], port: int = 0
) -> Iterator[tuple[str, int]]:
    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            try:
                answer(self)
            except OSError:
                self.close_connection = True

        def log_message(self, *_: object) -> None:
            """Quiet."""

    server = ThreadingHTTPServer(("127.0.0.1", port), Handler)
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/cam", server.server_port
    finally:
        server.shutdown()
        server.server_close()


def stream(frames: int, length: bool, boundary: str = "frame") -> Callable[..., None]:
    """Answers with an MJPEG stream of so many frames, then ends."""

    def answer(handler: BaseHTTPRequestHandler) -> None:
        handler.send_response(200)
        handler.send_header("Content-Type", f"multipart/x-mixed-replace; boundary={boundary}")
        handler.end_headers()
        mark = boundary.removeprefix("--").encode()
        for number in range(frames):
            jpeg = make_jpeg(number % 200)
            head = b"--" + mark + b"\r\nContent-Type: image/jpeg\r\n"
            if length:
                head += f"Content-Length: {len(jpeg)}\r\n".encode()
            handler.wfile.write(head + b"\r\n" + jpeg + b"\r\n")
            time.sleep(0.005)

    return answer


def snapshot(handler: BaseHTTPRequestHandler) -> None:
    jpeg = make_jpeg(int(time.monotonic() * 50) % 200)  # a sensor's noise makes each a new one
    handler.send_response(200)
    handler.send_header("Content-Type", "image/jpeg")
    handler.send_header("Content-Length", str(len(jpeg)))
    handler.end_headers()
    handler.wfile.write(jpeg)


@pytest.mark.parametrize(
    "answer",
    [
        stream(10_000, True),
        stream(10_000, False),
        stream(10_000, True, "--dashed"),
        stream(5, True),
        snapshot,
    ],
    ids=["lengths", "no lengths", "dashes", "breaks off", "snapshot"],
)
def test_network_cameras(answer: Callable[..., None]) -> None:
    with web_camera(answer) as (url, _):
        camera = open_camera(CameraSettings(spec=url, latency_s=0.01))
        try:
            for _ in range(4):
                moment = time.monotonic()
                frame = camera.frame_after(moment, 60.0)
                assert frame.exposed_at >= moment
                assert frame.image.shape == (48, 64, 3)
        finally:
            camera.close()


def test_a_network_camera_that_went_away_comes_back() -> None:
    with web_camera(stream(50, True)) as (url, port):
        camera = open_camera(CameraSettings(spec=url, latency_s=0.0))
        camera.frame_after(time.monotonic(), 60.0)
    try:
        with web_camera(lambda handler: handler.send_error(500), port):
            until(lambda: "status 500" in camera.health().detail)
            with pytest.raises(CameraError, match="status 500"):
                camera.frame_after(time.monotonic() + 100, 0.05)
        with web_camera(stream(10_000, True), port):
            camera.frame_after(time.monotonic(), 60.0)
    finally:
        camera.close()


@pytest.mark.parametrize("kind", ["text/html", "application/json"])
def test_what_is_no_picture_is_told(kind: str) -> None:
    def answer(handler: BaseHTTPRequestHandler) -> None:
        handler.send_response(200)
        handler.send_header("Content-Type", kind)
        handler.end_headers()

    with web_camera(answer) as (url, _):
        camera = open_camera(CameraSettings(spec=url))
        until(lambda: kind in camera.health().detail)
        with pytest.raises(CameraError, match="no picture or stream"):
            camera.frame_after(time.monotonic(), 0.05)
        camera.close()


def test_passwords_are_sent_and_not_shown() -> None:
    seen: list[str] = []

    def answer(handler: BaseHTTPRequestHandler) -> None:
        seen.append(handler.headers.get("Authorization", ""))
        handler.send_error(401)

    with web_camera(answer) as (url, _):
        camera = open_camera(CameraSettings(spec=url.replace("//", "//ada:pa%20ss@")))
        until(lambda: "status 401" in camera.health().detail)
        with pytest.raises(CameraError) as caught:
            camera.frame_after(time.monotonic(), 0.05)
        camera.close()
    assert base64.b64decode(seen[0].removeprefix("Basic ")) == b"ada:pa ss"
    assert "pa" not in str(caught.value).replace("camera", "")


# By name


def test_a_folder_gives_the_frame_of_the_keyframe(tmp_path: Path) -> None:
    for number in range(3):
        (tmp_path / f"{number}.jpg").write_bytes(make_jpeg(50 * number))
    (tmp_path / "1.jpg").write_bytes(b"broken")
    (tmp_path / "notes.txt").write_text("no frame")
    camera = open_camera(CameraSettings(spec=f"folder:{tmp_path}"))

    def grey(sequence: int) -> int:
        camera.announce(make_keyframe("r", sequence))
        moment = time.monotonic()
        frame = camera.frame_after(moment, 1.0)
        assert frame.exposed_at >= moment
        return int(frame.image[0, 0, 0])

    assert abs(grey(0) - 0) < 3
    with pytest.raises(CameraError, match=r"1\.jpg"):
        grey(1)
    assert abs(grey(2) - 100) < 3
    assert abs(grey(0) - 0) < 3
    with pytest.raises(CameraError, match="used up"):
        grey(3)


def test_a_data_set_is_replayed_in_its_own_order(tmp_path: Path) -> None:
    (tmp_path / "manifest.csv").write_text(
        "trajectory_id,aspirate,transit,dispense,post_dispense\n1,d.jpg,c.jpg,b.jpg,a.jpg\n"
    )
    for number, name in enumerate("abcd"):
        (tmp_path / f"{name}.jpg").write_bytes(make_jpeg(50 * number))
    camera = open_camera(CameraSettings(spec=f"folder:{tmp_path}"))
    greys = [int(camera.frame_after(0.0, 1.0).image[0, 0, 0]) for _ in range(4)]
    assert [round(grey / 50) for grey in greys] == [3, 2, 1, 0]


def test_an_empty_or_missing_folder_is_told(tmp_path: Path) -> None:
    with pytest.raises(CameraError, match="holds no"):
        open_camera(CameraSettings(spec=f"folder:{tmp_path}"))
    with pytest.raises(CameraError, match="Cannot read"):
        open_camera(CameraSettings(spec=f"folder:{tmp_path / 'none'}"))


@pytest.mark.parametrize("spec", ["", "usb", "usb:x", "usb:-1", "ftp://x", "http:", "folder:", "x"])
def test_unknown_cameras_are_refused_with_the_known_ones(spec: str) -> None:
    with pytest.raises(ConfigurationError, match="usb:NUMBER"):
        open_camera(CameraSettings(spec=spec))


def test_a_usb_camera_that_is_not_there_is_told() -> None:
    camera = open_camera(CameraSettings(spec="usb:97"))
    until(lambda: "97" in camera.health().detail)
    with pytest.raises(CameraError, match="USB camera 97 cannot be opened"):
        camera.frame_after(time.monotonic(), 0.05)
    camera.close()


def test_no_frame_is_older_than_its_keyframe(config: SidecarConfig) -> None:
    """How much younger they are `make bench` prints."""
    camera = open_camera(CameraSettings(spec="pattern", fps=30))
    with running_sidecar(config, camera, None) as url, Robot(url) as robot:
        robot.register()
        robot.send(0)
        took = [robot.send(sequence).json()["exposed_after_s"] for sequence in range(1, 25)]
    assert min(took) >= 0


def test_the_pattern_decodes_and_moves() -> None:
    camera = open_camera(CameraSettings(spec="pattern", fps=100))
    first = camera.frame_after(time.monotonic(), 60.0)
    second = camera.frame_after(first.exposed_at + 0.005, 60.0)
    camera.close()
    assert decode_jpeg(first.jpeg).shape == (480, 640, 3)
    assert (first.image != second.image).any()


def test_a_late_camera_is_refused_in_the_time_it_was_given(config: SidecarConfig) -> None:
    late = config.model_copy(update={"camera": CameraSettings(timeout_s=0.2)})
    source = HandSource()
    camera = FreeRunning("hand", source.open)
    with running_sidecar(late, camera, StubAnalyser()) as url, Robot(url) as robot:
        robot.register()
        answer = robot.send(0)
        assert answer.status_code == 503
        assert "0.2 s" in answer.json()["error"]["message"]
        source.put(Raw(time.monotonic() + 600, make_jpeg()))
        source.settled()
        assert robot.send(0).status_code == 200
        source.put(CameraError("over"))
