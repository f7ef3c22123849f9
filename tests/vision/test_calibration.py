"""The band of a run, conformal p-values, and runs that cannot be calibrated."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from aegis_ot.errors import ConfigurationError, ModelError
from aegis_ot.vision.calibration import (
    PRESETS,
    CalibrationSettings,
    CalibrationState,
    NormalPool,
    RunCalibration,
    preset,
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


def test_pooled_p_values_keep_their_promise() -> None:
    rng = np.random.default_rng(2)
    settings = CalibrationSettings(alpha=0.05, streaming=False)

    def standardised(count: int) -> list[float]:
        run = calibrated(settings, list(rng.normal(10, 1, 6) * (scale := rng.uniform(0.5, 2))))
        return [run.standing(score * scale).z for score in rng.normal(10, 1, count)]

    pool = NormalPool([z for _ in range(60) for z in standardised(10)])
    alarms = []
    for _ in range(300):
        scale = rng.uniform(0.5, 2)
        run = RunCalibration(settings, pool)
        for score in rng.normal(10, 1, 6) * scale:
            run.add(score)
        alarms += [not run.standing(score * scale).inside for score in rng.normal(10, 1, 10)]
    assert np.mean(alarms) <= 0.07


def test_a_small_pool_cannot_promise_and_is_not_used() -> None:
    pool = NormalPool([0.1, 0.2])
    run = RunCalibration(CalibrationSettings(alpha=0.05), pool)
    for score in FIRST:
        run.add(score)
    assert run.standing(10.0).p_value is None


def test_pools_are_kept_as_json(tmp_path: Path) -> None:
    pool = NormalPool([3.0, 1.0, float("nan")])
    pool.save(tmp_path / "pool.json")
    again = NormalPool.load(tmp_path / "pool.json")
    assert len(again) == 2
    assert again.p_value(2.0) == pytest.approx(2 / 3)
    (tmp_path / "pool.json").write_text("[]")
    with pytest.raises(ModelError, match=r"pool\.json"):
        NormalPool.load(tmp_path / "pool.json")


def test_wrong_settings_are_named() -> None:
    with pytest.raises(ConfigurationError, match="multiplier"):
        CalibrationSettings(multiplier=-1)
    with pytest.raises(ConfigurationError, match="paper"):
        preset("nonsense")
    assert preset("paper", multiplier=3).multiplier == 3
