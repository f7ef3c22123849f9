"""Tips of a drawn plate, found by the shipped detector and by where the robot says they are."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.simulation.session import SessionParameters
from aegis_ot.vision.detection.heatmap import HeatmapDetector
from aegis_ot.vision.registration.locating import Located, TipLocator
from aegis_ot.vision.types import FREE, TipDetection, TrajectorySample
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot_lab.drawing.dataset import SimulatedPlate, render_trajectory
from aegis_ot_lab.drawing.plans import PlannedWell

PLATE = SimulatedPlate("plate", SessionParameters.bench(3), "p300", 200.0)


@pytest.fixture(scope="module")
def detector() -> HeatmapDetector:
    return HeatmapDetector()


def drawn(number: int, failure: str = "") -> TrajectorySample:
    rng = np.random.default_rng((number, 8))
    well = f"{'ABCDEFGH'[number % 8]}1"
    return render_trajectory(str(number), well, PlannedWell(0, "red", failure), PLATE, rng)[0]


def locate(locator: TipLocator, sample: TrajectorySample) -> dict[KeyframeKind, Located]:
    return {
        kind: locator.locate(
            sample.frames[kind], sample.positions[kind], sample.tip.name, kind not in FREE
        )
        for kind in KeyframeKind
    }


def off(found: TipDetection | None, true: TipDetection | None) -> float:
    assert found is not None
    assert true is not None
    ends = [(found.orifice, true.orifice), (found.collar, true.collar)]
    return max(float(np.hypot(a[0] - b[0], a[1] - b[1])) for a, b in ends)


def test_later_tips_are_projected_and_a_lost_one_is_seen_to_be_lost(
    detector: HeatmapDetector,
) -> None:
    locator = TipLocator(detector)
    for number in range(3):
        locate(locator, drawn(number))
    normal, lost = drawn(3), drawn(4, "no_tip")
    for kind, seen in locate(locator, normal).items():
        assert seen.expected is not None, kind
        if kind in FREE:
            assert off(seen.detection, normal.detections[kind]) < 8.0, kind
    for kind, seen in locate(locator, lost).items():
        assert seen.expected is not None, kind
        assert seen.detection is None, kind


def test_without_positions_the_detector_works_alone(detector: HeatmapDetector) -> None:
    locator, sample = TipLocator(detector), drawn(0)
    image = sample.frames[KeyframeKind.TRANSIT]
    seen = locator.locate(image, None, sample.tip.name)
    assert seen == Located(detector.detect(image))
    assert locator.registration is None


@pytest.mark.parametrize("by", [(25, 10), (200, -40)])
def test_a_camera_that_was_moved_is_registered_anew(
    detector: HeatmapDetector, by: tuple[int, int]
) -> None:
    locator = TipLocator(detector)
    for number in range(3):
        locate(locator, drawn(number))
    before = locator.registration
    for number in (3, 4, 4):
        sample = drawn(number)
        for kind in KeyframeKind:
            moved = np.roll(sample.frames[kind], by, axis=(1, 0))
            seen = locator.locate(moved, sample.positions[kind], sample.tip.name, kind not in FREE)
    assert before is not None
    assert locator.registration is not before
    assert seen.expected is not None
    true = sample.detections[KeyframeKind.POST_DISPENSE]
    assert true is not None
    assert seen.detection is not None
    apart = np.subtract(seen.detection.orifice, true.orifice) - by
    assert np.hypot(*apart) < 8.0
