"""What a trajectory shows of its own delivery, without any other well."""

from __future__ import annotations

import pytest

from aegis_ot.simulation import SessionParameters, SimulatedCamera
from aegis_ot.vision.column_reader import MeasuredColumns
from aegis_ot.vision.delivery import Delivery, Shown, delivery_of
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import FREE, TipDetection

from .test_run_analyser_factory import keyframes


def delivery(fault: str = "", reagent: str = "red dye", kept: float = 0.0) -> Delivery:
    camera = SimulatedCamera(5, [f"{fault}@#1"] if fault else [], SessionParameters.bench(5))
    reader, looks, expected, frames, before = MeasuredColumns(), {}, {}, {}, None
    for keyframe in keyframes(1, reagent=reagent):
        camera.announce(keyframe)
        frame, truth = camera.frame_after(0.0, 1.0), camera.truth
        if keyframe.kind not in FREE or truth is None or truth.box is None:
            continue
        tip = truth.tip
        found = TipDetection(*truth.box, 0.9, tip.orifice, tip.collar)
        expected[keyframe.kind] = keyframe.expected_ul + kept
        frames[keyframe.kind] = frame.image
        looks[keyframe.kind] = reader.look(
            frames, keyframe.kind, found, tip_for(keyframe.pipette), None, before
        )
        before = found
    return delivery_of(looks, expected)


def test_a_dye_that_leaves_the_tip_proves_its_delivery() -> None:
    assert delivery().shown is Shown.EMPTIED


@pytest.mark.parametrize("fault", ["no_aspirate", "no_dispense"])
def test_where_nothing_leaves_nothing_is_seen_to_leave(fault: str) -> None:
    assert delivery(fault).shown is Shown.NOTHING


@pytest.mark.parametrize(("fault", "left"), [("partial:50", 50.0), ("partial:25", 75.0)])
def test_a_column_that_stays_is_seen_and_measured(fault: str, left: float) -> None:
    found = delivery(fault)
    assert found.shown is Shown.LEFT
    assert found.left_ul == pytest.approx(left, rel=0.35)


def test_air_within_the_column_is_seen_and_measured() -> None:
    found = delivery("air_bubble:12")
    assert found.shown is Shown.GAP
    assert found.gap_ul == pytest.approx(12.0, rel=0.4)
    unbroken, whole = found.unbroken, delivery().unbroken
    assert (unbroken or 1.0) < 0.3 < 0.6 < (whole or 0.0)


def test_water_proves_nothing() -> None:
    assert delivery(reagent="water").shown is Shown.NOTHING


def test_frames_without_a_tip_or_a_delivery_are_unknown() -> None:
    assert delivery_of({}, {}).shown is Shown.UNKNOWN
    assert delivery("no_tip").shown is Shown.UNKNOWN
