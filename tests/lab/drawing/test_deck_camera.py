"""Frames of keyframes with positions: a fixed camera before the robot's own deck."""

from __future__ import annotations

import time
from dataclasses import replace

import pytest

from aegis_ot.simulation import FrameTruth, SessionParameters
from aegis_ot.vision.registration import Sighting, fit
from aegis_ot.vision.types import FREE
from aegis_ot.vocabulary import Keyframe, KeyframeKind
from aegis_ot_lab.drawing.deck_camera import DeckCamera
from tests.simulation.test_faults import run_of

Z = {
    KeyframeKind.ASPIRATE: 4.0,
    KeyframeKind.TRANSIT: 35.0,
    KeyframeKind.DISPENSE: 3.0,
    KeyframeKind.POST_DISPENSE: 35.0,
}
CORNERS = {"1": (0.0, 0.0), "2": (132.5, 0.0), "3": (265.0, 0.0), "9": (265.0, 181.0)}


def placed(wells: list[str], slot: str = "9", channels: int = 1) -> list[Keyframe]:
    """A transfer per well from slot 1, with the positions that a robot would tell."""
    frames = []
    for keyframe in run_of(wells, channels=channels):
        at_source = keyframe.kind is KeyframeKind.ASPIRATE
        x, y = CORNERS["1" if at_source else slot]
        well = "A1" if at_source else keyframe.destinations[0].name
        column, row = int(well[1:]) - 1, "ABCDEFGH".index(well[0])
        position = (x + 14.4 + 9 * column, y + 74.2 - 9 * row, Z[keyframe.kind])
        there = tuple(replace(ref, slot=slot) for ref in keyframe.destinations)
        frames.append(replace(keyframe, position=position, destinations=there))
    return frames


def truths(camera: DeckCamera, keyframes: list[Keyframe]) -> list[FrameTruth]:
    found = []
    for keyframe in keyframes:
        camera.announce(keyframe)
        camera.frame_after(time.monotonic(), 5.0)
        assert camera.truth is not None
        found.append(camera.truth)
    return found


def test_pictures_agree_with_positions() -> None:
    keyframes = placed(["A1", "D6", "H12", "A12"])
    session = SessionParameters.bench(3)
    camera = DeckCamera(3, (), session)
    camera.expect(keyframes)
    seen = [
        Sighting(keyframe.position, "ot2_300", truth.tip.orifice, truth.tip.collar)
        for keyframe, truth in zip(keyframes, truths(camera, keyframes), strict=True)
        if keyframe.position is not None
    ]
    known = fit(seen, session.size)
    assert known is not None
    assert known.residual_px < 1.5
    assert known.inliers == 1.0


@pytest.mark.parametrize("slot", ["3", "9"])
@pytest.mark.parametrize("announced", [False, True])
def test_every_tip_is_in_view(announced: bool, slot: str) -> None:
    session = SessionParameters.bench(3)
    camera, keyframes = DeckCamera(3, (), session), placed(["A1", "H12"], slot)
    camera.expect(keyframes if announced else ())
    for truth in truths(camera, keyframes):
        for tip in truth.tips:
            for x, y in (tip.orifice, tip.collar):
                assert 0 < x < session.size[0]
                assert 0 < y < session.size[1]


def test_the_camera_stays_where_it_is_when_the_labware_was_announced() -> None:
    keyframes = placed(["A1", "H12"])
    camera = DeckCamera(3, (), SessionParameters.bench(3))
    camera.expect(keyframes)
    before = None
    for keyframe in keyframes:
        camera.announce(keyframe)
        now = replace(camera.parameters, labware=())
        assert before is None or now == before
        before = now


def test_a_row_of_tips_is_shown_from_nearby() -> None:
    session = SessionParameters.beside(30, 3)
    camera, (keyframe, *_) = (
        DeckCamera(3, (), session),
        placed(["A1"], "9", channels=8),
    )
    camera.announce(keyframe)
    assert camera.parameters == session


def test_labware_hides_the_tip_that_stands_in_it() -> None:
    camera = DeckCamera(3, (), SessionParameters.bench(3))
    keyframes = placed(["A1", "H12"])
    for keyframe, truth in zip(keyframes, truths(camera, keyframes), strict=True):
        if keyframe.kind in FREE:
            assert truth.tip.hidden == 0.0
        else:
            assert 0.05 < truth.tip.hidden < 0.4
