from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.simulation import FrameTruth, SessionParameters, SimulatedCamera
from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot.vision.rows.finder import RowFinder, SeenRow
from aegis_ot.vision.types import FREE
from aegis_ot.vocabulary import KeyframeKind

from .frames import frames, keyframes, part_of


@pytest.fixture(scope="module")
def detector() -> HeatmapDetector:
    return HeatmapDetector()


def off(seen: SeenRow, truth: FrameTruth) -> float:
    """Largest error of a collar or orifice, px."""
    errors = [
        np.abs(np.subtract((*tip.collar, *tip.orifice), (*true.collar, *true.orifice))).max()
        for tip, true in zip(seen.tips, truth.tips, strict=True)
        if tip is not None
    ]
    return float(max(errors))


@pytest.mark.parametrize("angle", [0, 30, 45])
def test_eight_tips_are_found_and_named(detector: HeatmapDetector, angle: float) -> None:
    finder = None
    for keyframe, frame, truth in frames(angle):
        if keyframe.kind in FREE:
            finder = finder or RowFinder(detector, keyframe, "auto")
            seen = finder.find(frame.image, keyframe)
            assert (seen.whole, seen.trouble) == (True, "")
            assert not any(seen.hidden)
            assert off(seen, truth) < 15  # of a tip 270 px long, an inch from the next
            assert finder.assumed == (angle == 0)


def test_seen_along_the_row_no_tip_can_be_told_apart(detector: HeatmapDetector) -> None:
    for keyframe, frame, _ in frames(90):
        if keyframe.kind is KeyframeKind.TRANSIT:
            seen = RowFinder(detector, keyframe, "auto").find(frame.image, keyframe)
            assert seen.hidden == (True,) * 8


def test_a_missing_tip_is_missing_and_the_others_keep_their_names(
    detector: HeatmapDetector,
) -> None:
    for keyframe, frame, truth in frames(30, ["no_tip@D1"]):
        if keyframe.kind is KeyframeKind.TRANSIT:
            finder = RowFinder(detector, keyframe, "left")
            seen = finder.find(frame.image, keyframe)
            assert [tip is None for tip in seen.tips] == [row == "D" for row in "ABCDEFGH"]
            assert off(seen, truth) < 15


def test_a_tip_missing_at_an_end_is_not_guessed_in_the_first_column(
    detector: HeatmapDetector,
) -> None:
    for keyframe, frame, _ in frames(0, ["no_tip@H1"]):
        if keyframe.kind is KeyframeKind.TRANSIT:
            seen = RowFinder(detector, keyframe, "left").find(frame.image, keyframe)
            assert "7 of 8 tips" in seen.trouble


def test_the_first_channel_is_where_the_setting_says(detector: HeatmapDetector) -> None:
    for keyframe, frame, _ in frames(30):
        if keyframe.kind is KeyframeKind.TRANSIT:
            left, right = (
                RowFinder(detector, keyframe, side).find(frame.image, keyframe).tips
                for side in ("left", "right")
            )
            assert left == right[::-1]


def test_a_partial_head_is_a_shorter_row(detector: HeatmapDetector) -> None:
    camera = SimulatedCamera(1, (), SessionParameters.beside(30, 1))
    keyframe = part_of(list(keyframes(1))[1], 4, 7)
    camera.announce(keyframe)
    frame = camera.frame_after(0.0, 5.0)
    seen = RowFinder(detector, keyframe, "auto").find(frame.image, keyframe)
    assert camera.truth is not None
    assert len(seen.tips) == len(camera.truth.tips) == 4
    assert seen.whole
    assert off(seen, camera.truth) < 15
