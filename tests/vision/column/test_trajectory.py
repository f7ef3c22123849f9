"""Four frames together: retained, broken, misplaced and absent columns."""

from __future__ import annotations

import pytest

from aegis_ot.vision.column import (
    RunReference,
    TipModel,
    learn_run,
    learn_tip,
    look_at_tip,
    place,
    weigh,
)
from aegis_ot.vision.column.trajectory import Looks, Signs
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import TrajectorySample
from aegis_ot.vocabulary import KeyframeKind

from .drawn import FULL, WATER, normals, trajectory

TIP = tip_for("p1000")


def looks(sample: TrajectorySample) -> Looks:
    found = {}
    for kind, detection in sample.detections.items():
        if detection is not None:
            found[kind] = look_at_tip(sample.frames[kind], detection, tip_for("p1000")).profile
    return found


@pytest.fixture(scope="module")
def model() -> TipModel:
    return learn_tip([(looks(sample), sample.expected_ul) for sample in normals()], TIP)


def judge(sample: TrajectorySample, model: TipModel, run: RunReference | None = None) -> Signs:
    return weigh(looks(sample), TIP, sample.expected_ul, model, run or RunReference())


def test_the_tip_model_learns_how_high_columns_stand(model: TipModel) -> None:
    transit = KeyframeKind.TRANSIT
    assert place(transit, 250.0, TIP, model, RunReference()) == pytest.approx(FULL, abs=0.015)


def test_a_retained_column_stands_out(model: TipModel) -> None:
    clean = judge(trajectory("ok", seed=50), model)
    kept = judge(trajectory("kept", left=0.75, seed=51), model)
    assert clean.retained is not None
    assert kept.retained is not None
    assert kept.retained > clean.retained + 10


def test_water_left_in_the_tip_stands_out_too(model: TipModel) -> None:
    clean = judge(trajectory("ok", dye=WATER, seed=52), model)
    kept = judge(trajectory("kept", left=0.75, dye=WATER, seed=53), model)
    assert (kept.retained or 0) > (clean.retained or 0) + 4


def test_more_liquid_than_commanded_is_a_negative_misfill(model: TipModel) -> None:
    signs = judge(trajectory("more", full=FULL - 0.05, seed=54), model)
    assert signs.misfill[KeyframeKind.TRANSIT] == pytest.approx(-0.05, abs=0.015)


def test_a_dye_that_is_not_there_is_missed_once_the_run_has_shown_it(model: TipModel) -> None:
    run = learn_run([judge(trajectory("first", seed=55), model)])
    there = judge(trajectory("there", seed=56), model, run)
    gone = judge(trajectory("gone", full=1.0, seed=57), model, run)
    assert there.absent is not None
    assert gone.absent is not None
    assert gone.absent > there.absent + 10


def test_what_should_be_left_is_not_held_against_a_multi_dispense(model: TipModel) -> None:
    sample = trajectory("multi", left=0.7, seed=58)
    due = {**sample.expected_ul}
    height = (1 - 0.7) * TIP.length_mm / model.height_scale
    for kind in (KeyframeKind.DISPENSE, KeyframeKind.POST_DISPENSE):
        due[kind] = TIP.volume_of(height)
    expected = weigh(looks(sample), TIP, due, model, RunReference())
    unexpected = judge(sample, model)
    assert (expected.retained or 0) < 5 < (unexpected.retained or 0)


def test_missing_frames_leave_signs_out_and_raise_nothing(model: TipModel) -> None:
    sample = trajectory("few", seed=59)
    nothing = weigh({}, TIP, sample.expected_ul, model, RunReference())
    assert nothing.retained is None
    assert not nothing.gap
    one = {KeyframeKind.TRANSIT: looks(sample)[KeyframeKind.TRANSIT]}
    assert weigh(one, TIP, sample.expected_ul, model, RunReference()).retained is None


def test_a_tip_model_of_nothing_is_the_default() -> None:
    assert learn_tip([], TIP) == TipModel()
