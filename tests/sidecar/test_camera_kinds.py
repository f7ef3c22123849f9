"""USB by path and with locks, RTSP, video files, the robot's own camera, several cameras."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any, ClassVar

import cv2
import numpy as np
import pytest

from aegis_ot.errors import CameraError, ConfigurationError
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.cameras import open_camera, open_cameras
from aegis_ot.sidecar.cameras.bound import Bound, BoundCameras
from aegis_ot.sidecar.cameras.capture import UsbSource
from aegis_ot.sidecar.config import CameraSettings
from aegis_ot.sidecar.store import Store
from aegis_ot.sidecar.wire import RunStart
from aegis_ot.worldmodel.recorded import run_source

from .helpers import Robot, StubAnalyser, StubCamera, make_jpeg, make_keyframe, until


class Device:
    """A driver: knows some properties, and keeps what it is told."""

    opened: ClassVar[list[Any]] = []

    def __init__(self, what: Any, backend: int) -> None:
        Device.opened.append(what)
        self.values = {cv2.CAP_PROP_EXPOSURE: 156.0, cv2.CAP_PROP_WB_TEMPERATURE: 0.0}
        self.set_: list[tuple[int, float]] = []

    def isOpened(self) -> bool:
        return True

    def set(self, prop: int, value: float) -> bool:
        self.set_.append((prop, value))
        return True

    def get(self, prop: int) -> float:
        return self.values.get(prop, -1.0)

    def read(self) -> tuple[bool, np.ndarray]:
        return True, np.zeros((48, 64, 3), np.uint8)

    def release(self) -> None:
        """Nothing to give back."""


@pytest.fixture
def driver(monkeypatch: pytest.MonkeyPatch) -> Callable[..., tuple[UsbSource, Device]]:
    monkeypatch.setattr(cv2, "VideoCapture", Device)

    def opened(**settings: Any) -> tuple[UsbSource, Device]:
        source = UsbSource(0, CameraSettings(**settings), 0.07)
        return source, source._device

    return opened


def test_a_usb_path_is_followed_to_its_device(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(cv2, "VideoCapture", Device)
    (tmp_path / "video7").touch()
    link = tmp_path / "usb-Webcam-index0"
    link.symlink_to(tmp_path / "video7")
    camera = open_camera(CameraSettings(spec=f"usb:{link}"))
    camera.frame_after(time.monotonic(), 60.0)
    camera.close()
    assert Device.opened[-1] == str(tmp_path / "video7")


def test_given_exposure_and_white_balance_switch_the_automatic_off(driver: Any) -> None:
    _, device = driver(exposure=120.0, white_balance=4600.0)
    assert (cv2.CAP_PROP_AUTO_EXPOSURE, 1) in device.set_
    assert (cv2.CAP_PROP_EXPOSURE, 120.0) in device.set_
    assert (cv2.CAP_PROP_WB_TEMPERATURE, 4600.0) in device.set_
    assert cv2.CAP_PROP_AUTOFOCUS not in {prop for prop, _ in device.set_}


def test_lock_keeps_what_the_automatic_found_once_it_has_settled(driver: Any) -> None:
    source, device = driver(lock=True)
    source.read()
    assert cv2.CAP_PROP_AUTO_EXPOSURE not in {prop for prop, _ in device.set_}
    for _ in range(60):
        source.read()
    assert device.set_.count((cv2.CAP_PROP_EXPOSURE, 156.0)) == 1
    assert (cv2.CAP_PROP_AUTOFOCUS, 0) in device.set_
    # What the driver does not tell is not set to nothing.
    assert cv2.CAP_PROP_WB_TEMPERATURE not in {prop for prop, _ in device.set_}


def test_without_lock_the_camera_is_left_to_itself(driver: Any) -> None:
    source, device = driver()
    for _ in range(60):
        source.read()
    assert not {prop for prop, _ in device.set_} & {
        cv2.CAP_PROP_AUTO_EXPOSURE, cv2.CAP_PROP_AUTO_WB, cv2.CAP_PROP_AUTOFOCUS
    }  # fmt: skip


@pytest.mark.parametrize(
    "spec",
    ["usb:97", "usb:/dev/v4l/by-id/none", "rtsp://ada:secret@127.0.0.1:1/stream", "video:/none"],
)
def test_what_cannot_be_opened_is_told_without_opencvs_lines_or_a_secret(
    spec: str, capfd: pytest.CaptureFixture[str]
) -> None:
    camera = open_camera(CameraSettings(spec=spec))
    until(lambda: "not sent a frame yet" not in camera.health().detail)
    with pytest.raises(CameraError) as told:
        camera.frame_after(time.monotonic(), 0.05)
    camera.close()
    assert "secret" not in str(told.value)
    err = capfd.readouterr().err
    assert "VIDEOIO" not in err
    assert "tcp @" not in err


def test_a_video_is_played_at_its_own_rate_over_and_over(tmp_path: Path) -> None:
    path = tmp_path / "run.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), 20.0, (64, 48))
    for grey in (40, 80, 120, 160, 200):
        writer.write(np.full((48, 64, 3), grey, np.uint8))
    writer.release()
    camera = open_camera(CameraSettings(spec=f"video:{path}"))
    first = camera.frame_after(time.monotonic() - 1.0, 60.0)
    assert abs(int(first.image.mean()) - 40) < 10
    assert abs(int(camera.frame_after(first.exposed_at + 1e-6, 60.0).image.mean()) - 80) < 10
    later = [camera.frame_after(time.monotonic(), 60.0).image.mean() for _ in range(3)]
    assert all(30 < grey < 210 for grey in later)  # it begins again
    camera.close()


def test_the_robots_own_camera_is_told_to_take_a_picture() -> None:
    asked: list[tuple[str, str | None]] = []

    class Picture(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            asked.append((self.path, self.headers.get("Opentrons-Version")))
            self.send_response(200)
            self.send_header("Content-Type", "image/jpeg")
            data = make_jpeg(90)
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            self.wfile.write(data)

        def log_message(self, *_: Any) -> None:
            """Quiet."""

    server = ThreadingHTTPServer(("127.0.0.1", 0), Picture)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    camera = open_camera(CameraSettings(spec=f"robot:http://127.0.0.1:{server.server_port}"))
    frame = camera.frame_after(time.monotonic(), 60.0)
    camera.close()
    server.shutdown()
    server.server_close()
    assert abs(int(frame.image.mean()) - 90) < 5
    assert asked[0] == ("/camera/picture", "*")


def test_each_keyframe_is_taken_by_the_camera_that_looks_at_its_pipette(
    config: SidecarConfig,
) -> None:
    left, right, other = StubCamera(), StubCamera(), StubCamera()
    cameras = BoundCameras(
        [Bound(other, "other"), Bound(left, "left", "Ada", "left"), Bound(right, "right", "Ada")]
    )
    with running_sidecar(config, cameras, StubAnalyser()) as url, Robot(url) as robot:
        start = {"run": robot.run, "robot_name": "Ada"}
        assert robot.http.put(f"/v1/runs/{robot.run}", json=start).status_code == 200
        assert robot.send(0, mount="left").status_code == 200
        assert robot.send(1, mount="right").status_code == 200
        with Robot(url, "another") as second:
            second.http.put("/v1/runs/another", json={"run": "another", "robot_name": "Bob"})
            assert second.send(0).status_code == 200
    assert (left.grabbed, right.grabbed, other.grabbed) == ([0], [1], [0])
    assert all(one.closed for one in (left, right, other))


def test_a_pipette_that_no_camera_looks_at_is_told(config: SidecarConfig) -> None:
    cameras = BoundCameras([Bound(StubCamera(), "left", "Ada", "left")])
    with running_sidecar(config, cameras, StubAnalyser()) as url, Robot(url) as robot:
        robot.http.put(f"/v1/runs/{robot.run}", json={"run": robot.run, "robot_name": "Ada"})
        answer = robot.send(0, mount="right")
        assert answer.status_code == 503
        assert "the right mount of Ada" in answer.json()["error"]["message"]


def test_several_cameras_are_opened_from_the_settings(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "0.jpg").write_bytes(make_jpeg(100 if name == "a" else 200))
    config = SidecarConfig.load(
        data=tmp_path / "data",
        cameras=[
            {"spec": f"folder:{tmp_path / 'a'}", "mount": "left"},
            {"spec": f"folder:{tmp_path / 'b'}", "mount": "right"},
        ],
    )
    camera = open_cameras(config)
    camera.announce(make_keyframe("r", 0, mount="right"))
    assert abs(int(camera.frame_after(time.monotonic(), 1.0).image.mean()) - 200) < 5
    camera.close()
    wrong = config.model_copy(update={"cameras": (config.cameras[0].model_copy(
        update={"spec": "ftp://x"}),)})  # fmt: skip
    with pytest.raises(ConfigurationError, match="usb:NUMBER"):
        open_cameras(wrong)


def test_frames_that_are_drawn_or_replayed_are_called_so_whatever_robot_runs(
    tmp_path: Path, config: SidecarConfig
) -> None:
    folder = tmp_path / "frames"
    folder.mkdir()
    for number in range(8):
        (folder / f"{number}.jpg").write_bytes(make_jpeg())
    replayed = open_camera(CameraSettings(spec=f"folder:{folder}"))
    camera = BoundCameras(
        [Bound(StubCamera(), "real", mount="left"), Bound(replayed, "replayed", mount="right")]
    )
    with running_sidecar(config, camera, StubAnalyser()) as url, Robot(url) as robot:
        robot.http.put("/v1/runs/run-1", json={"run": "run-1", "simulated": False})
        robot.cycle(0)
        assert robot.overview()["simulated"] is False
        assert robot.send(4, mount="right").status_code == 200
        assert robot.overview()["simulated"] is True


def test_runs_of_an_older_store_are_called_after_the_camera(tmp_path: Path) -> None:
    store = Store(tmp_path)
    for name, kind in (("drawn", "simulated"), ("seen", "usb")):
        store.register(RunStart(run=name, simulated=False), {"camera": kind})
    assert run_source(store.run("drawn") or {}) == "synthetic"
    assert run_source(store.run("seen") or {}) == "real"
    store.close()
