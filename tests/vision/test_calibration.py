"""The band of a run, and runs that cannot be calibrated."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.vision.calibration import (
    PRESETS,
    CalibrationSettings,
    CalibrationState,
    RunCalibration,
)

FIRST = [10.0, 11.0, 9.0, 10.5, 9.5, 10.2]


def calibrated(settings: CalibrationSettings, first: list[float] = FIRST) -> RunCalibration:
    run = RunCalibration(settings)
    for score in first:
        run.add(score)
    return run


def test_the_papers_band_is_median_plus_minus_0_7_mad() -> None:
    run = calibrated(PRESETS["paper"])
    median = np.median(FIRST)
    mad = np.median(np.abs(np.array(FIRST) - median))
    assert run.band == pytest.approx((median - 0.7 * mad, median + 0.7 * mad))


def routed(settings: CalibrationSettings, draw, runs: int = 400) -> float:
    flags = []
    for _ in range(runs):
        run = calibrated(settings, list(draw(6)))
        flags += [not run.standing(score).inside for score in draw(20)]
    return float(np.mean(flags))


@pytest.mark.parametrize("shape", ["normal", "lognormal", "gamma"])
def test_the_default_sends_at_most_a_tenth_of_normals_to_the_gate(shape: str) -> None:
    rng = np.random.default_rng(1)
    draw = {
        "normal": lambda n: rng.normal(10, 1, n),
        "lognormal": lambda n: rng.lognormal(0, 0.4, n),
        "gamma": lambda n: rng.gamma(3, 1, n),
    }[shape]
    assert routed(PRESETS["default"], draw) <= 0.10
    assert routed(PRESETS["paper"], draw) == pytest.approx(0.72, abs=0.05)


def test_one_bad_calibration_well_does_not_move_the_band() -> None:
    good = calibrated(PRESETS["default"]).band
    bad = calibrated(PRESETS["default"], [*FIRST[:5], 500.0])
    assert bad.state is CalibrationState.READY
    assert good is not None
    assert bad.band is not None
    assert bad.band[1] < 2 * good[1]


def test_a_cluster_of_bad_wells_leaves_the_run_uncalibrated() -> None:
    run = calibrated(PRESETS["default"], [*FIRST[:4], 500.0, 450.0])
    assert run.state is CalibrationState.UNCALIBRATED
    assert "stand apart" in run.reason
    assert not run.standing(10.0).inside


def test_wells_of_different_volumes_are_not_asked_to_agree() -> None:
    run = RunCalibration()
    for score, volume in zip([*FIRST[:4], 500.0, 450.0], [50, 50, 50, 50, 300, 300], strict=True):
        run.add(score, volume)
    assert run.state is CalibrationState.READY


def test_scores_that_agree_by_chance_leave_a_band_of_some_width() -> None:
    run = calibrated(PRESETS["default"], [10.0] * 6)
    assert run.standing(10.5).inside
    assert not run.standing(20.0).inside


def test_streaming_follows_a_slow_drift() -> None:
    still = calibrated(CalibrationSettings(streaming=False))
    moving = calibrated(CalibrationSettings(streaming=True))
    for score in np.linspace(10, 16, 200):
        for run in (still, moving):
            if run.standing(score).inside:
                run.accept(score)
    assert not still.standing(16.0).inside
    assert moving.standing(16.0).inside


def test_a_well_outside_the_band_that_passed_counts_as_its_edge() -> None:
    run = calibrated(CalibrationSettings())
    assert run.band is not None
    edge = run.band[1]
    run.accept(100.0)
    assert run.normals[-1] == pytest.approx(edge)
    run.accept(10.1)
    assert run.normals[-1] == 10.1


def test_wrong_settings_are_named() -> None:
    with pytest.raises(ConfigurationError, match="multiplier"):
        CalibrationSettings(multiplier=-1)
