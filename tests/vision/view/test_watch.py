"""Views that tell nothing are named; sound ones, spoiled frames of them included, are not."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache

import cv2
import numpy as np
import pytest

from aegis_ot.simulation import SessionParameters, SimulatedCamera
from aegis_ot.vision.types import Image, TipDetection
from aegis_ot.vision.view import TroubleKind, ViewWatch
from aegis_ot.vocabulary import Keyframe, KeyframeKind

from ..test_run_analyser_factory import keyframes

WELLS = 3
TIP = TipDetection(10, 10, 5, 50, 0.9, (12, 60), (12, 10))


class Sees:
    """A detector that finds a tip where the test says that there is one."""

    def __init__(self) -> None:
        self.tip = True
        self.asked = 0

    def detect(self, image: Image) -> TipDetection | None:
        self.asked += 1
        return TIP if self.tip else None


@cache
def sound() -> list[tuple[Keyframe, Image]]:
    return list(_frames(SessionParameters.webcam(3)))


@cache
def turned_away() -> list[Image]:
    session = SessionParameters.webcam(3)
    return [image for _, image in _frames(replace(session, look=(0.0, 0.0, 220.0)))]


def _frames(session: SessionParameters) -> Iterator[tuple[Keyframe, Image]]:
    camera = SimulatedCamera(3, (), session)
    for keyframe in keyframes(WELLS):
        camera.announce(keyframe)
        yield keyframe, camera.frame_after(0.0, 1.0).image


def noisy(image: np.ndarray, seed: int) -> Image:
    spread = np.random.default_rng(seed).normal(0.0, 2.0, image.shape)
    return np.clip(image + spread, 0, 255).astype(np.uint8)


SPOILED: dict[TroubleKind, Callable[[Image, int], Image]] = {
    TroubleKind.DARK: lambda image, seed: noisy(image * 0.02, seed),
    TroubleKind.COVERED: lambda image, seed: noisy(cv2.GaussianBlur(image, (0, 0), 80) * 0.5, seed),
    TroubleKind.BLOWN_OUT: lambda image, seed: noisy(image * 20.0, seed),
    TroubleKind.BLURRED: lambda image, seed: noisy(cv2.GaussianBlur(image, (0, 0), 6), seed),
}


def test_a_sound_run_is_let_through_and_its_view_is_hardly_searched() -> None:
    detector = Sees()
    watch = ViewWatch(detector)
    assert [watch.look(*seen) for seen in sound()] == [None] * 4 * WELLS
    assert detector.asked == 1


@pytest.mark.parametrize("kind", list(SPOILED))
@pytest.mark.parametrize("first", [0, 5])
def test_a_view_that_shows_nothing_is_named_at_once(kind: TroubleKind, first: int) -> None:
    detector = Sees()
    watch = ViewWatch(detector)
    for number, (keyframe, image) in enumerate(sound()):
        if number < first:
            assert watch.look(keyframe, image) is None
            continue
        detector.tip = False
        trouble = watch.look(keyframe, SPOILED[kind](image, number))
        assert trouble is not None
        assert trouble.kind is kind
        detector.tip = True
        assert watch.look(keyframe, image) is None
        return


def test_a_repeated_frame_is_a_frozen_camera() -> None:
    watch = ViewWatch(Sees())
    for keyframe, image in sound()[:6]:
        assert watch.look(keyframe, image) is None
    keyframe, trouble = sound()[6][0], watch.look(sound()[6][0], sound()[5][1])
    assert trouble is not None
    assert trouble.kind is TroubleKind.FROZEN
    assert watch.look(keyframe, sound()[6][1]) is None


def test_a_picture_in_which_nothing_moves_is_frozen_within_two_moves() -> None:
    watch = ViewWatch(Sees())
    still = sound()[0][1]
    moved = [replace(k, position=(20.0 * n, 0.0, 0.0)) for n, (k, _) in enumerate(sound())]
    found = [watch.look(keyframe, noisy(still, n)) for n, keyframe in enumerate(moved[:3])]
    assert found[0] is None
    assert found[2] is not None
    assert found[2].kind is TroubleKind.FROZEN


def test_a_tip_that_stays_where_it_is_is_no_frozen_camera() -> None:
    watch = ViewWatch(Sees())
    still = sound()[0][1]
    for number, (keyframe, _) in enumerate(sound()):
        here = replace(keyframe, position=(1.0, 2.0, 3.0))
        assert watch.look(here, noisy(still, number)) is None


@pytest.mark.parametrize("first", [4, 5, 6, 7])
def test_a_camera_that_is_turned_away_is_named_within_two_keyframes(first: int) -> None:
    detector = Sees()
    watch = ViewWatch(detector)
    troubles = []
    for number, (keyframe, image) in enumerate(sound()[: first + 2]):
        detector.tip = number < first
        seen = image if number < first else turned_away()[number]
        troubles.append(watch.look(keyframe, seen))
    assert troubles[:first] == [None] * first
    assert TroubleKind.MISAIMED in {trouble.kind for trouble in troubles[first:] if trouble}


def test_a_camera_that_never_saw_a_tip_is_told_before_anything_is_delivered() -> None:
    detector = Sees()
    detector.tip = False
    watch = ViewWatch(detector)
    keyframe, image = sound()[0]
    assert watch.look(keyframe, image) is None
    keyframe, image = sound()[1]
    trouble = watch.look(keyframe, image)
    assert trouble is not None
    assert trouble.kind is TroubleKind.MISAIMED
    assert "no tip is on it" in trouble.message


def test_a_tip_that_is_missing_in_the_same_view_is_not_the_cameras_fault() -> None:
    detector = Sees()
    watch = ViewWatch(detector)
    bare = SimulatedCamera(3, ["no_tip@#2"], SessionParameters.webcam(3))
    for keyframe in keyframes(WELLS):
        bare.announce(keyframe)
        detector.tip = keyframe.trajectory != 1
        assert watch.look(keyframe, bare.frame_after(0.0, 1.0).image) is None


def test_another_view_in_which_the_tip_is_found_is_taken_up() -> None:
    detector = Sees()
    watch = ViewWatch(detector)
    for keyframe, image in sound()[:4]:
        assert watch.look(keyframe, image) is None
    for (keyframe, _), image in zip(sound()[4:], turned_away()[4:], strict=True):
        assert watch.look(keyframe, image) is None
    assert detector.asked < len(sound())


def test_a_late_frame_shows_another_moment_and_accuses_no_one() -> None:
    detector = Sees()
    detector.tip = False
    watch = ViewWatch(detector)
    for keyframe, image in sound():
        assert watch.look(replace(keyframe, late=True), image) is None
    dark = SPOILED[TroubleKind.DARK](sound()[0][1], 0)
    assert watch.look(replace(sound()[0][0], late=True), dark) is not None
    assert KeyframeKind.TRANSIT in {keyframe.kind for keyframe, _ in sound()}
