from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import cv2
import numpy as np
import pytest

from aegis_ot.simulation import FrameTruth, SessionParameters, SimulatedCamera
from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot.vision.rows.finder import RowFinder, SeenRow
from aegis_ot.vision.types import FREE, Axis, End, Ends, Image, TipDetection
from aegis_ot.vocabulary import KeyframeKind

from .frames import frames, keyframes, part_of

TRANSIT = (KeyframeKind.TRANSIT,)


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
    for keyframe, frame, truth in frames(angle, kinds=FREE):
        finder = finder or RowFinder(detector, keyframe, "auto")
        seen = finder.find(frame.image, keyframe)
        assert (seen.whole, seen.trouble) == (True, "")
        assert not any(seen.hidden)
        assert off(seen, truth) < 15  # of a tip 270 px long, an inch from the next
        assert finder.assumed == (angle == 0)


@pytest.mark.parametrize(("angle", "size"), [(15, 1.0), (20, 0.5), (30, 0.5)])
@pytest.mark.parametrize("flipped", [False, True])
def test_the_first_channel_is_told_from_either_side(
    detector: HeatmapDetector, angle: float, size: float, flipped: bool
) -> None:
    ((keyframe, frame, truth),) = frames(angle, seed=3, kinds=TRANSIT)
    image = cv2.flip(frame.image, 1) if flipped else frame.image
    image = cv2.resize(image, None, fx=size, fy=size, interpolation=cv2.INTER_AREA)
    finder = RowFinder(detector, keyframe, "auto")
    seen = finder.find(image, keyframe)
    assert (seen.whole, finder.assumed) == (True, False)
    for tip, true in zip(seen.tips, truth.tips, strict=True):
        assert tip is not None
        x = frame.image.shape[1] - true.orifice[0] if flipped else true.orifice[0]
        assert tip.orifice[0] == pytest.approx(size * x, abs=15 * size)


def test_the_ends_of_a_narrow_row_that_is_sure_are_left_where_they_are(
    detector: HeatmapDetector,
) -> None:
    camera = SimulatedCamera(411, (), SessionParameters.beside(15, 411))
    keyframe = replace(
        list(keyframes(1))[1], pipette="p20_multi_gen2", capacity_ul=20.0, commanded_ul=15.0,
        expected_ul=15.0,
    )  # fmt: skip
    camera.announce(keyframe)
    seen = RowFinder(detector, keyframe, "auto").find(camera.frame_after(0.0, 5.0).image, keyframe)
    assert camera.truth is not None
    for tip, true in zip(seen.tips, camera.truth.tips, strict=True):
        assert tip is not None
        assert abs(tip.collar[0] - true.collar[0]) < 0.03 * tip.length
        assert abs(tip.orifice[0] - true.orifice[0]) < 0.03 * tip.length


def test_seen_along_the_row_no_tip_can_be_told_apart(detector: HeatmapDetector) -> None:
    ((keyframe, frame, _),) = frames(90, kinds=TRANSIT)
    seen = RowFinder(detector, keyframe, "auto").find(frame.image, keyframe)
    assert seen.hidden == (True,) * 8


def test_a_missing_tip_is_missing_and_the_others_keep_their_names(
    detector: HeatmapDetector,
) -> None:
    ((keyframe, frame, truth),) = frames(30, ["no_tip@D1"], kinds=TRANSIT)
    finder = RowFinder(detector, keyframe, "left")
    seen = finder.find(frame.image, keyframe)
    assert [tip is None for tip in seen.tips] == [row == "D" for row in "ABCDEFGH"]
    assert off(seen, truth) < 15


def test_a_tip_missing_at_an_end_is_not_guessed_in_the_first_column(
    detector: HeatmapDetector,
) -> None:
    ((keyframe, frame, _),) = frames(0, ["no_tip@H1"], kinds=TRANSIT)
    seen = RowFinder(detector, keyframe, "left").find(frame.image, keyframe)
    assert "7 of 8 tips" in seen.trouble


def test_the_first_channel_is_where_the_setting_says(detector: HeatmapDetector) -> None:
    ((keyframe, frame, _),) = frames(30, kinds=TRANSIT)
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


TIP_MM, STEP = 59.3, 40.0
LENGTH = STEP * TIP_MM / 9.0
EMPTY = np.zeros((480, 640, 3), np.uint8)


@dataclass
class Drawn:
    """Shows the ends that it is told, others in close-ups, and guesses a tip of a length."""

    ends_of: Ends
    guessed: float = LENGTH
    close: Ends | None = None
    of_rows: Drawn | None = None
    reaches: list[float] = field(default_factory=list)

    def detect(self, image: Image) -> TipDetection | None:
        x, y = 240.0, 370.0
        return TipDetection(
            x - 8, y - self.guessed, 16, self.guessed, 0.9, (x, y), (x, y - self.guessed)
        )

    best_guess = detect

    def ends(self, image: Image, tip: TipDetection, reach: float) -> Ends:
        self.reaches.append(reach)
        return self.ends_of

    def ends_of_length(self, image: Image, length: float) -> Ends:
        return self.ends_of

    def ends_of_each(self, image: Image, axes: Sequence[Axis]) -> list[Ends]:
        return [self.close or self.ends_of] * len(axes)


def ends(lower: list[int], upper: list[int], y: float = 370.0) -> Ends:
    """Of the tips with these numbers."""
    return Ends(
        collars=tuple(End(100.0 + STEP * n, y - LENGTH, 0.8) for n in upper),
        orifices=tuple(End(100.0 + STEP * n, y, 0.8) for n in lower),
    )


ALL = list(range(8))


def found(detector: Drawn) -> SeenRow:
    keyframe = next(one for one in keyframes(1) if one.kind is KeyframeKind.TRANSIT)
    return RowFinder(detector, keyframe, "left").find(EMPTY, keyframe)


def lengths(seen: SeenRow) -> list[float | None]:
    return [tip and round(tip.orifice[1] - tip.collar[1]) for tip in seen.tips]


def test_lower_ends_alone_make_a_row() -> None:
    assert found(Drawn(ends(ALL, []), close=ends(ALL, ALL))).whole


def test_the_row_s_own_steps_give_its_scale() -> None:
    detector = Drawn(ends(ALL, []), guessed=0.7 * LENGTH, close=ends(ALL, ALL))
    assert lengths(found(detector)) == [pytest.approx(LENGTH, abs=2)] * 8
    assert detector.reaches[-1] == pytest.approx(detector.reaches[0] / 0.7, rel=0.02)


def test_lower_ends_fill_in_for_upper_ones_that_are_faint() -> None:
    seen = found(Drawn(ends(ALL, [0, 1, 2, 3, 4]), close=ends(ALL, ALL)))
    assert [tip is not None for tip in seen.tips] == [True] * 8


def test_upper_ends_that_are_as_many_hold() -> None:
    """Both ends of each tip say more than one, so nothing is made up where a tip is missing."""
    some = [0, 1, 2, 4, 5, 6, 7]
    seen = found(Drawn(ends(some, some)))
    assert [tip is not None for tip in seen.tips] == [n in some for n in range(8)]


@pytest.mark.parametrize(("longer", "length"), [(1.15, LENGTH), (1.04, 1.04 * LENGTH)])
def test_upper_ends_that_do_not_fit_the_nozzles_distance_are_mistaken(
    longer: float, length: float
) -> None:
    upper = tuple(End(end.x, 370.0 - longer * LENGTH, 0.8) for end in ends([], ALL).collars)
    close = Ends(tuple(replace(end, y=370.0 - length) for end in upper), ends(ALL, []).orifices)
    seen = found(Drawn(replace(close, collars=upper), guessed=longer * LENGTH, close=close))
    assert lengths(seen) == [pytest.approx(length, abs=3)] * 8


def test_half_a_row_of_lower_ends_is_none() -> None:
    seen = found(Drawn(ends([0, 1, 2, 3], [])))
    assert seen.tips == (None,) * 8


def test_a_nozzle_that_a_close_up_shows_bare_has_no_tip() -> None:
    some = [0, 1, 2, 4, 5, 6, 7]
    seen = found(Drawn(ends(ALL, ALL), close=ends(some, some)))
    assert [tip is not None for tip in seen.tips] == [n in some for n in range(8)]


def test_a_row_is_found_elsewhere_than_where_a_tip_is_guessed() -> None:
    nothing = Ends()

    @dataclass
    class Misled(Drawn):
        def ends_of_length(self, image: Image, length: float) -> Ends:
            return ends(ALL, [])

    assert found(Misled(nothing, close=ends(ALL, ALL))).whole
    assert found(Misled(nothing, close=nothing)).tips == (None,) * 8


def test_a_detector_of_rows_is_asked_where_the_other_misses_a_tip() -> None:
    sharp, blind = ends(ALL, ALL), ends(ALL[:5], ALL[:5])
    other = Drawn(sharp)
    assert found(Drawn(blind, of_rows=other)).whole
    assert other.reaches
    untold = found(Drawn(blind))
    assert untold.trouble == ("Only 5 of 8 tips are seen, and which are missing cannot be told.")
    other = Drawn(blind)
    assert found(Drawn(sharp, of_rows=other)).whole
    assert not other.reaches
    assert found(Drawn(blind, of_rows=Drawn(ends(ALL[:4], ALL[:4])))).trouble == untold.trouble


def test_the_whole_frame_is_searched_no_more_where_it_shows_no_row() -> None:
    """From the front of an OT-2 a row is seen along: no frame of the run will show one."""
    lengths: list[float] = []

    @dataclass
    class Counted(Drawn):
        def ends_of_length(self, image: Image, length: float) -> Ends:
            lengths.append(length)
            return Ends()

    keyframe = next(one for one in keyframes(1) if one.kind is KeyframeKind.TRANSIT)
    finder = RowFinder(Counted(Ends()), keyframe, "left")
    asked = []
    for _ in range(6):
        finder.find(EMPTY, keyframe)
        asked.append(len(lengths))
    assert asked[0] == 5  # scales
    assert asked[3:] == [20, 20, 20]


def test_collars_between_the_tips_are_none() -> None:
    """Tips hang upright: drawn so, all collars half a step aside are told from the true ones."""
    image = np.full((480, 640, 3), 90, np.uint8)
    for n in ALL:
        x = round(100 + STEP * n)
        outline = [(x - 15, 106), (x + 15, 106), (x + 3, 370), (x - 3, 370)]
        cv2.fillPoly(image, [np.array(outline)], (160, 160, 160))
    aside = tuple(replace(end, x=end.x - STEP / 2) for end in ends([], ALL).collars)
    detector = Drawn(Ends(aside, ends(ALL, []).orifices), close=ends(ALL, ALL))
    keyframe = next(one for one in keyframes(1) if one.kind is KeyframeKind.TRANSIT)
    seen = RowFinder(detector, keyframe, "left").find(image, keyframe)
    assert [tip and round(tip.collar[0]) for tip in seen.tips] == [
        pytest.approx(100 + STEP * n, abs=3) for n in ALL
    ]
