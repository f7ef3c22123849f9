"""What a run knows of one liquid: how unusual a score is among its own wells."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.vision.calibration import CalibrationSettings
from aegis_ot.vision.calibration_group import CalibrationGroup, OpenTrajectory
from aegis_ot.vision.column_reader import MeasuredColumns
from aegis_ot.vision.gates import GateDecision, GateInput, Gates
from aegis_ot.vision.measuring import ColumnReading
from aegis_ot.vision.scorers.ensemble import EnsembleScorer
from aegis_ot.vision.types import Image, TipDetection, TrajectorySample
from aegis_ot.vocabulary import Gate, KeyframeKind, Outcome
from tests.sidecar.helpers import make_keyframe
from tests.vision.samples import sample


class NoDetector:
    def detect(self, image: Image) -> TipDetection | None:
        return None


def stream(*normals: float) -> CalibrationGroup:
    made = CalibrationGroup(EnsembleScorer(), MeasuredColumns(), CalibrationSettings())
    for score in normals:
        made.cascade.learn(score, normal=True)
    return made


def test_the_first_well_is_held_against_the_models_own_wells() -> None:
    assert stream().p_value(9.0) == pytest.approx(math.exp(-9.0))
    assert stream(0.5).p_value(None) is None


def test_first_wells_that_all_look_unusual_are_so_until_somebody_vouches() -> None:
    calibrating = stream(9.0, 9.0)
    assert calibrating.p_value(9.0) == pytest.approx(math.exp(-9.0))
    calibrating.vouched = True
    assert calibrating.p_value(9.0) == 1.0


def test_a_score_is_taken_against_the_runs_own_wells() -> None:
    usual, shifted = stream(*[0.5] * 6), stream(*[6.0] * 6)
    assert usual.p_value(6.5) == pytest.approx(math.exp(-6.0))
    assert usual.p_value(0.1) == 1.0
    assert shifted.p_value(6.5) > 0.5


def test_wells_that_scatter_make_a_score_less_unusual() -> None:
    even, scattered = stream(*[1.0] * 6), stream(0.2, 9.0, 0.4, 7.0, 0.3, 8.0)
    assert scattered.p_value(12.0) > even.p_value(12.0)


def test_without_a_world_model_there_is_no_p_value() -> None:
    plain = CalibrationGroup(None, MeasuredColumns(), CalibrationSettings())
    plain.cascade.learn(1.0, normal=True)
    assert plain.p_value(9.0) is None


class Unread(MeasuredColumns):
    """Measures nothing: the gate below knows which well is suspect."""

    def learn(self, *_: object) -> None:
        pass

    def read_beside(self, *_: object) -> Mapping[KeyframeKind, ColumnReading]:
        return {}

    def forget(self, *_: object) -> None:
        pass


class Suspecting:
    gate = Gate.VOLUMETRIC
    screens = True

    def __init__(self, *wells: str) -> None:
        self.wells = wells

    def examine(self, case: GateInput) -> GateDecision:
        odd = case.sample.id in self.wells
        return GateDecision(Outcome.FAIL if odd else Outcome.PASS, self.gate, "Liquid is left.")


def learning(gate: Suspecting, *wells: TrajectorySample) -> CalibrationGroup:
    made = CalibrationGroup(None, Unread(), CalibrationSettings(wells=6), gates=Gates([gate]))
    for one in wells:
        made.learn(one, dict.fromkeys(KeyframeKind, object()), scored=False)
        one.frames.clear()  # type: ignore[attr-defined]
    return made


def test_the_normal_well_is_one_that_nothing_speaks_against_and_its_frames_are_kept() -> None:
    assert learning(Suspecting()).normal is None
    wells = [sample(f"w{number}") for number in range(4)]
    suspecting = learning(Suspecting("w0", "w1"), *wells)
    assert suspecting.normal is not None
    assert suspecting.normal.id == "w0"
    suspecting.catch_up()
    assert "look at well" in suspecting.doubt
    assert suspecting.normal.id == "w1"
    assert set(suspecting.normal.frames) == set(KeyframeKind)
    suspecting.catch_up()
    assert suspecting.normal is None, "no frames are kept of w2 and w3: too many"
    suspecting.learn(sample("w4"), dict.fromkeys(KeyframeKind, object()), scored=False)
    assert suspecting.normal is not None
    assert suspecting.normal.id == "w4"


def test_a_tip_that_is_on_hangs_where_the_robot_holds_it() -> None:
    image = np.full((480, 640, 3), 90, np.uint8)
    there = TipDetection(310.0, 100.0, 16.0, 160.0, 0.0, (318.0, 260.0), (318.0, 100.0))
    found = replace(there, confidence=0.8)
    for after in (found, None):
        seen = OpenTrajectory()
        for number, kind in enumerate(KeyframeKind):
            seen.keyframes[kind] = make_keyframe("r", number)
            seen.frames[kind] = image
            seen.detections[kind] = after if kind is KeyframeKind.POST_DISPENSE else None
            seen.projected[kind] = there
        CalibrationGroup(None, MeasuredColumns(), CalibrationSettings()).settle(seen, NoDetector())
        assert seen.detections[KeyframeKind.TRANSIT] == (there if after else None)
        assert seen.excused == ()


def test_what_is_found_elsewhere_is_not_the_tip_whose_place_is_known() -> None:
    image = np.full((480, 640, 3), 90, np.uint8)
    there = TipDetection(310.0, 100.0, 16.0, 160.0, 0.0, (318.0, 260.0), (318.0, 100.0))

    class Guessing(NoDetector):
        def best_guess(self, image: Image) -> TipDetection | None:
            return replace(there, confidence=0.4, orifice=(318.0, 330.0), collar=(318.0, 170.0))

    seen = OpenTrajectory()
    for number, kind in enumerate(KeyframeKind):
        seen.keyframes[kind], seen.frames[kind] = make_keyframe("r", number), image
        seen.detections[kind] = replace(there, confidence=0.8) if number < 3 else None
        seen.projected[kind] = there
    CalibrationGroup(None, MeasuredColumns(), CalibrationSettings()).settle(seen, Guessing())
    assert seen.detections[KeyframeKind.POST_DISPENSE] is None
