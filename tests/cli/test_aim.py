"""``aegis-ot aim``: a kept run's camera, by what the robot said and the frames show."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

import cv2
import pytest

from aegis_ot.inspection.aiming import camera_from
from aegis_ot.sidecar.store import Captured, Store
from aegis_ot.sidecar.wire import RunStart
from aegis_ot.simulation import SessionParameters
from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot.vision.types import Image
from aegis_ot.vocabulary import Keyframe
from aegis_ot_lab.drawing.deck_camera import DeckCamera
from tests.cli.commands import Command
from tests.lab.drawing.test_deck_camera import placed

WELLS = ["A1", "D6", "H12", "B3", "E9"]


@pytest.fixture(scope="module")
def frames() -> list[tuple[Keyframe, Image]]:
    keyframes = placed(WELLS, "2")
    camera = DeckCamera(3, (), SessionParameters.bench(3))
    camera.expect(keyframes)
    shown = []
    for keyframe in keyframes:
        camera.announce(keyframe)
        shown.append((keyframe, camera.frame_after(time.monotonic(), 5.0).image))
    return shown


def stored(folder: Path, frames: list[tuple[Keyframe, Image]], drawn: bool = False) -> None:
    store = Store(folder)
    store.register(RunStart(run="r", protocol="wells.py", simulated=drawn, started=time.time()))
    for keyframe, image in frames:
        jpeg = cv2.imencode(".jpg", image)[1].tobytes()
        store.add_keyframe(Captured(keyframe, 0.02, time.time()), jpeg)
    store.close()


def test_a_camera_that_sees_all_is_known(
    tmp_path: Path, frames: list[tuple[Keyframe, Image]], aegis: Command
) -> None:
    stored(tmp_path, frames)
    said = aegis("aim", "--data", tmp_path)
    assert said.code == 0
    assert "r: the camera is known to" in said.out
    assert "Every tip was in view" in said.out


def test_a_run_without_positions_tells_nothing(
    tmp_path: Path, frames: list[tuple[Keyframe, Image]], aegis: Command
) -> None:
    stored(tmp_path, [(replace(keyframe, position=None), image) for keyframe, image in frames[:1]])
    said = aegis("aim", "r", "--data", tmp_path)
    assert said.code == 2
    assert "cannot be registered" in said.err
    assert aegis("aim", "other", "--data", tmp_path).code == 2


def test_drawn_frames_say_nothing_of_a_camera(
    tmp_path: Path, frames: list[tuple[Keyframe, Image]], aegis: Command
) -> None:
    stored(tmp_path, frames[:1], drawn=True)
    said = aegis("aim", "--data", tmp_path)
    assert said.code == 2
    assert "are drawn or replayed" in said.err


def test_what_is_out_of_view_is_said(frames: list[tuple[Keyframe, Image]]) -> None:
    cropped = [(keyframe, image[300:].copy()) for keyframe, image in frames]
    check = camera_from(cropped, HeatmapDetector())
    assert check.registration is not None
    assert {place.lacking for place in check.places} == {"upper end"}
    assert not check.is_sound
