"""What a run knows of one liquid: how unusual a score is among its own wells."""

from __future__ import annotations

import math

import pytest

from aegis_ot.vision.calibration import CalibrationSettings
from aegis_ot.vision.column_reader import MeasuredColumns
from aegis_ot.vision.scorers.ensemble import EnsembleScorer
from aegis_ot.vision.stream import Stream


def stream(*normals: float) -> Stream:
    made = Stream(EnsembleScorer(), MeasuredColumns(), CalibrationSettings())
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
    plain = Stream(None, MeasuredColumns(), CalibrationSettings())
    plain.cascade.learn(1.0, normal=True)
    assert plain.p_value(9.0) is None
