"""A camera whose view tells nothing holds the run, as the camera's trouble and no well's."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
import pytest

from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.cameras.codec import encode_jpeg
from aegis_ot.vision.camera import Frame
from aegis_ot.vision.types import Image, TipDetection

from .helpers import Robot, StubAnalyser, StubCamera


class Sees:
    def detect(self, image: Image) -> TipDetection | None:
        return TipDetection(1, 1, 5, 20, 0.9, (3, 21), (3, 1))


class Bench(StubCamera):
    """A view with edges, another one at each keyframe; ``spoil`` says how many exposures are black,
    ``dark`` that all are."""

    def __init__(self) -> None:
        super().__init__()
        self.dark = False
        self.spoil = 0

    def frame_after(self, moment: float, timeout: float) -> Frame:
        sequence = self.announced[-1]
        self.grabbed.append(sequence)
        image = np.random.default_rng(sequence).integers(100, 110, (48, 64, 3)).astype(np.uint8)
        image[::8] = 200
        image[:, 4 * (sequence % 12) : 4 * (sequence % 12) + 4] = 30
        if self.dark or self.spoil > 0:
            self.spoil -= 1
            image[:] = np.random.default_rng(sequence + 99).integers(0, 6, image.shape)
        return Frame(encode_jpeg(image), image, max(moment, time.monotonic()))


@pytest.fixture
def bench() -> Bench:
    return Bench()


@pytest.fixture
def watched(config: SidecarConfig, bench: Bench) -> Iterator[Robot]:
    with (
        running_sidecar(config, bench, StubAnalyser(), Sees()) as url,
        Robot(url) as robot,
    ):
        robot.register()
        yield robot


def test_a_dark_camera_takes_no_keyframe_and_gives_no_verdict(watched: Robot, bench: Bench) -> None:
    assert watched.send(0).status_code == 200
    bench.dark = True
    for sequence in (1, 1):
        answer = watched.send(sequence)
        assert answer.status_code == 503
        assert answer.json()["error"]["code"] == "camera"
        assert "dark" in answer.json()["error"]["message"]
    health = watched.http.get("/v1/health").json()["camera"]
    assert not health["ok"]
    assert "dark" in health["detail"]
    assert watched.verdict(0, wait=0.1)["verdict"] is None
    bench.dark = False
    for sequence in (1, 2, 3):
        assert watched.send(sequence).status_code == 200
    assert watched.verdict(0)["verdict"]["outcome"] == "pass"
    assert watched.http.get("/v1/health").json()["camera"]["ok"]


def test_one_spoiled_exposure_is_taken_again(watched: Robot, bench: Bench) -> None:
    bench.spoil = 1
    assert watched.send(0).status_code == 200
    assert bench.grabbed == [0, 0]


def test_the_watch_can_be_turned_off(config: SidecarConfig, bench: Bench) -> None:
    camera = config.camera.model_copy(update={"watch_view": False})
    blind = config.model_copy(update={"camera": camera})
    bench.dark = True
    with running_sidecar(blind, bench, StubAnalyser(), Sees()) as url, Robot(url) as robot:
        robot.register()
        assert robot.send(0).status_code == 200
