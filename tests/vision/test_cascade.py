"""Triage: routes, the blank floor, and that no score fails a well."""

from __future__ import annotations

import pytest

from aegis_ot.vision.calibration import CalibrationState
from aegis_ot.vision.cascade import Cascade
from aegis_ot.vocabulary import KeyframeKind, Route

FIRST = [10.0, 11.0, 9.0, 10.5, 9.5, 10.2]


def calibrated(**kwargs: object) -> Cascade:
    cascade = Cascade("pca", **kwargs)  # type: ignore[arg-type]
    for score in FIRST:
        assert cascade.triage(score, ()).route is Route.CALIBRATION
        cascade.learn(score, normal=True)
    return cascade


def test_the_band_passes_silently_and_the_rest_is_grey() -> None:
    cascade = calibrated()
    assert cascade.triage(10.3, ()).route is Route.SILENT_PASS
    grey = cascade.triage(99.0, ())
    assert grey.route is Route.GREY_ZONE
    assert grey.to_gate
    assert "spreads above" in grey.reason


def test_the_band_that_a_well_met_is_told_whatever_is_learned_of_it() -> None:
    assert Cascade("pca").triage(10.0, ()).band is None
    cascade = calibrated()
    met = cascade.triage(14.0, ())
    assert met.band == cascade.calibration.band
    cascade.learn(14.0, normal=True)
    assert met.band != cascade.calibration.band == cascade.triage(10.0, ()).band


@pytest.mark.parametrize(
    "missing",
    [
        (KeyframeKind.POST_DISPENSE,),
        (KeyframeKind.DISPENSE, KeyframeKind.POST_DISPENSE),
        tuple(KeyframeKind),
    ],
)
def test_a_missing_tip_is_the_blank_floor_whatever_the_score(missing) -> None:
    triage = calibrated().triage(10.0, missing)
    assert triage.route is Route.BLANK_FLOOR
    assert all(kind.value in triage.reason for kind in missing)


def test_the_papers_score_floor_is_kept() -> None:
    assert calibrated().triage(1e-6, ()).route is Route.BLANK_FLOOR


def test_a_tip_hidden_by_labware_but_seen_a_moment_later_is_there() -> None:
    hidden = (KeyframeKind.ASPIRATE, KeyframeKind.DISPENSE)
    assert calibrated().triage(10.0, hidden).route is Route.SILENT_PASS


def test_a_tip_that_is_seen_later_was_there_before() -> None:
    early = (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT)
    assert calibrated().triage(10.0, early).route is Route.SILENT_PASS


def test_a_scorer_that_knows_its_normals_is_not_narrowed_by_a_quiet_run() -> None:
    cascade = Cascade("ensemble", least_alarm=3.5)
    for _ in range(6):
        cascade.learn(0.3, normal=True)
    assert cascade.state is CalibrationState.READY
    assert cascade.triage(3.0, ()).route is Route.SILENT_PASS
    assert cascade.triage(4.5, ()).route is Route.GREY_ZONE


def test_a_well_without_a_score_goes_to_the_gate() -> None:
    assert calibrated().triage(None, (KeyframeKind.DISPENSE,)).route is Route.GREY_ZONE


def test_a_contradicting_column_is_enough_for_the_grey_zone() -> None:
    triage = calibrated().triage(10.0, (), "About 50 µL are left.")
    assert triage.route is Route.GREY_ZONE
    assert triage.reason == "About 50 µL are left."


def test_always_gate_leaves_no_silent_pass() -> None:
    assert calibrated(always_gate=True).triage(10.0, ()).route is Route.ALWAYS_GATE


def test_one_failed_first_well_is_left_out_two_make_the_run_uncalibrated() -> None:
    cascade = Cascade("pca")
    cascade.learn(900.0, normal=False)
    for score in FIRST:
        cascade.learn(score, normal=True)
    assert cascade.state is CalibrationState.READY
    cascade = Cascade("pca")
    for _ in range(2):
        cascade.learn(900.0, normal=False)
    assert cascade.state is CalibrationState.UNCALIBRATED
    triage = cascade.triage(10.0, ())
    assert triage.route is Route.UNCALIBRATED
    assert triage.to_gate
    assert "failed at the gate" in triage.reason
