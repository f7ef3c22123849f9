"""The seconds around a bad well, kept with it and shown in its report."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import cv2
import pytest

from aegis_ot.sidecar import SidecarConfig, clips, running_sidecar
from aegis_ot.sidecar.cameras.history import CLIP_EVERY_S, HISTORY_S, History
from aegis_ot.sidecar.cameras.raw import Raw
from aegis_ot.sidecar.config import CameraSettings
from aegis_ot.sidecar.store.frames import FrameFiles
from aegis_ot.vision.camera import Frame
from aegis_ot.vocabulary import Keyframe

from .helpers import Robot, StubAnalyser, StubCamera, StubRun, make_jpeg, until


class Unseen(StubRun):
    """Takes frames of any size."""

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        pass


class AnySize(StubAnalyser):
    def begin(self, run: str, history: Any = ()) -> StubRun:
        return Unseen(self, run)


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(clips, "AFTER_S", 0.05)


def wait_for_clip(robot: Robot, trajectory: int) -> str:
    version = 0
    for _ in range(50):
        told = robot.http.get(
            f"/v1/runs/{robot.run}", params={"after": version, "wait": 2}, timeout=60
        ).json()
        version, entry = told["version"], told["trajectories"][trajectory]
        if entry["clip"] is not None:
            return str(entry["clip"])
    raise AssertionError("no clip came")


def test_a_failed_well_keeps_the_seconds_around_it_in_its_report_too(tmp_path: Path) -> None:
    settings = CameraSettings(spec="pattern")
    config = SidecarConfig(port=0, data=tmp_path / "data", camera=settings)
    with running_sidecar(config, None, AnySize(fails=[1])) as url, Robot(url) as robot:
        robot.register()
        for trajectory in (0, 1):
            robot.cycle(trajectory)
            robot.verdict(trajectory)
        video = robot.http.get(wait_for_clip(robot, 1))
        assert video.headers["content-type"] == "video/webm"
        file = tmp_path / "clip.webm"
        file.write_bytes(video.content)
        played, image = cv2.VideoCapture(str(file)).read()
        assert played
        assert image.shape == (480, 640, 3)
        assert robot.overview()["trajectories"][0]["clip"] is None, "of a sound well none is kept"
        assert robot.http.get("/v1/runs/run-1/clips/0.webm").status_code == 404
        assert "/v1/runs/run-1/clips/1.webm" in robot.http.get("/").text
        assert "data:video/webm" in robot.http.get("/runs/run-1/report.html").text


def test_what_befalls_the_run_is_kept_with_the_delivery_under_way(tmp_path: Path) -> None:
    settings = CameraSettings(spec="pattern")
    config = SidecarConfig(port=0, data=tmp_path / "data", camera=settings)
    with running_sidecar(config, None, AnySize()) as url, Robot(url) as robot:
        robot.register()
        for trajectory in (0, 1, 2):
            robot.cycle(trajectory)
            robot.verdict(trajectory)
        robot.post("hold", hold(1, resolution="operator", policy="pause"))
        robot.post("incident", {"kind": "layer1", "seconds": 0, "text": "Another well."})
        assert wait_for_clip(robot, 1), "a person stopped the robot there"
        assert wait_for_clip(robot, 2), "the delivery under way"
        assert robot.overview()["trajectories"][0]["clip"] is None
        report = robot.http.get("/runs/run-1/report.html").text
        assert report.count("data:video/webm") == 2
        assert report.count("where something happened") == 2


def hold(trajectory: int, **more: Any) -> dict[str, Any]:
    return {"number": 0, "trajectory": trajectory, "seconds": 0.2} | more


def test_a_failed_well_has_a_clip_of_its_own_whatever_befell_it_before(tmp_path: Path) -> None:
    settings = CameraSettings(spec="pattern")
    config = SidecarConfig(port=0, data=tmp_path / "data", camera=settings)
    with running_sidecar(config, None, AnySize(fails=[0])) as url, Robot(url) as robot:
        robot.register()
        robot.send(0)
        robot.post("incident", {"kind": "layer1", "seconds": 0.0, "text": "Another order."})
        before = robot.http.get(wait_for_clip(robot, 0)).content
        for sequence in (1, 2, 3):
            robot.send(sequence)
        robot.verdict(0)
        until(lambda: robot.http.get("/v1/runs/run-1/clips/0.webm").content != before)


def test_what_the_camera_shows_later_belongs_to_no_delivery(tmp_path: Path) -> None:
    settings = CameraSettings(spec="pattern")
    config = SidecarConfig(port=0, data=tmp_path / "data", camera=settings)
    with running_sidecar(config, None, AnySize()) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        robot.cycle(1)
        robot.verdict(1)
    with running_sidecar(config, None, AnySize()) as url, Robot(url) as robot:
        robot.post("incident", {"kind": "layer1", "seconds": 0.0, "text": "Another order."})
        robot.post("finish", {"outcome": "failed", "detail": "somebody says so"})
        time.sleep(4 * clips.AFTER_S)  # nothing comes, so nothing can be waited for
        assert [one["clip"] for one in robot.overview()["trajectories"]] == [None, None]


def test_a_folder_that_cannot_be_read_keeps_no_verdict_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def ill(self: FrameFiles, run: str) -> set[int]:
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(FrameFiles, "clips", ill)
    settings = CameraSettings(spec="pattern")
    config = SidecarConfig(port=0, data=tmp_path / "data", camera=settings)
    with running_sidecar(config, None, AnySize(fails=[0])) as url, Robot(url) as robot:
        robot.register()
        robot.post("incident", {"kind": "layer1", "seconds": 0.0, "text": "Another order."})
        for trajectory in (0, 1):
            robot.cycle(trajectory)
        assert robot.verdict(0)["verdict"]["outcome"] == "fail"
        assert robot.verdict(1)["verdict"]["outcome"] == "pass"


def test_a_camera_that_shows_only_keyframes_has_no_clip(config: SidecarConfig) -> None:
    with running_sidecar(config, StubCamera(), StubAnalyser(fails=[0])) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        robot.verdict(0)
        assert robot.overview()["trajectories"][0]["clip"] is None


def test_only_a_few_frames_a_second_are_kept_for_it() -> None:
    kept = History(CLIP_EVERY_S)
    for number in range(30 * 20):
        raw = Raw(number / 30, make_jpeg())
        if kept.wants(raw):
            kept.put(raw)
    assert len(list(kept)) <= HISTORY_S / CLIP_EVERY_S + 1


def test_frames_that_cannot_be_read_are_passed_over() -> None:
    assert clips.encode([Raw(0.0, b"no picture")]) == b""
    assert clips.encode([Raw(0.0, b"no picture"), Raw(0.2, make_jpeg())]).startswith(b"\x1aE")
