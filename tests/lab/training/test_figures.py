"""The figures by which a detector is judged."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot_lab.training.axes import TipLabel
from aegis_ot_lab.training.figures import (
    LabelledFrame,
    average_precision,
    choose_threshold,
    measure,
    overlap,
)
from aegis_ot_lab.training.scenes import draw_frame


def test_overlap_of_boxes() -> None:
    assert overlap((0, 0, 10, 10), (0, 0, 10, 10)) == 1.0
    assert overlap((0, 0, 10, 10), (5, 0, 10, 10)) == pytest.approx(1 / 3)
    assert overlap((0, 0, 10, 10), (10, 0, 10, 10)) == 0.0


def test_average_precision_of_a_perfect_and_a_blind_detector() -> None:
    assert average_precision([0.9, 0.8], [True, True], 2) == 1.0
    assert average_precision([], [], 2) == 0.0
    assert average_precision([0.9], [False], 2) == 0.0


def test_a_missed_tip_and_a_false_alarm_cost() -> None:
    assert average_precision([0.9], [True], 2) == pytest.approx(0.5)
    # Found, false, found: recall 1/2 at precision 1, then 1 at precision 2/3.
    assert average_precision([0.9, 0.8, 0.7], [True, False, True], 2) == pytest.approx(5 / 6)


def test_the_threshold_lies_in_the_middle_of_the_gap() -> None:
    assert choose_threshold([0.6, 0.8, 0.9], [0.1, 0.2]) == pytest.approx(0.4, abs=0.01)


def test_an_imagined_tip_costs_more_than_a_missed_one() -> None:
    assert choose_threshold([0.3, 0.8, 0.9, 0.9], [0.1, 0.1, 0.1, 0.4]) > 0.4


def _box(label: TipLabel) -> tuple[float, float, float, float]:
    (cx, cy), (ox, oy) = label.collar, label.orifice
    return (min(cx, ox) - label.radius, cy, abs(cx - ox) + 2 * label.radius, oy - cy)


def test_frames_without_a_tip_are_counted_apart() -> None:
    rng = np.random.default_rng(31)
    frames = []
    for _ in range(12):
        image, label, _missing = draw_frame(rng)
        frames.append(LabelledFrame(image, ((_box(label), label),) if label else ()))
    tips = sum(bool(frame.tips) for frame in frames)
    got = measure(HeatmapDetector(), frames)
    assert (got.tip_frames, got.empty_frames) == (tips, 12 - tips)
    assert 0 < got.found <= 1
    assert got.mean_overlap > 0.3
    nothing = measure(HeatmapDetector(threshold=1.0), frames)
    assert (nothing.found, nothing.false_alarms) == (0.0, 0)


def test_any_one_of_several_tips_is_right() -> None:
    image, label, _ = draw_frame(np.random.default_rng(5), tip=True)
    assert label is not None
    one = (_box(label), label)
    elsewhere = label.mapped(1.0, 1.0, 3000.0, 0.0)
    alone = measure(HeatmapDetector(), [LabelledFrame(image, (one,))])
    of_two = measure(HeatmapDetector(), [LabelledFrame(image, ((_box(elsewhere), elsewhere), one))])
    assert alone == of_two
