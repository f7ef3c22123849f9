"""What stands behind a verdict: where columns should end, and the band."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest

from aegis_ot.vision.calibration import CalibrationSettings
from aegis_ot.vision.calibration_group import CalibrationGroup, OpenTrajectory
from aegis_ot.vision.cascade import Triage
from aegis_ot.vision.column_reader import MeasuredColumns
from aegis_ot.vision.evidence import evidence_of
from aegis_ot.vision.gates import GateDecision, GateInput
from aegis_ot.vision.tips import TIPS
from aegis_ot.vocabulary import Gate, KeyframeKind, Outcome, Route
from tests.sidecar.helpers import make_keyframe

from .samples import sample

TIP = TIPS["ot2_1000"]


def told(heights: Mapping[str, float], triage: Triage) -> dict[str, Any]:
    """Of a well whose tip should hold 100 µL before the dispense and nothing after it.

    Args:
        heights: What earlier runs showed, see :meth:`MeasuredColumns.expect_heights`.
        triage: Where it was sent.
    """
    reader = MeasuredColumns()
    made = CalibrationGroup(None, reader, CalibrationSettings())
    reader.expect_heights(heights)
    case = GateInput(sample(), Route.CALIBRATION, None, {})
    seen = OpenTrajectory({KeyframeKind.TRANSIT: make_keyframe("run", 1)})
    decision = GateDecision(Outcome.PASS, Gate.NONE, "")
    key = "p1000_single_gen2", 1000.0, "red"
    return evidence_of(key, made, case, seen, triage, decision)


def expected_tops(heights: Mapping[str, float]) -> dict[str, float]:
    return dict(told(heights, Triage(Route.CALIBRATION, ""))["expected_top"])


def test_an_expected_end_is_where_columns_are_known_to_stand() -> None:
    half = pytest.approx(0.5 * TIP.height_of(100.0) / TIP.length_mm, abs=1e-3)
    assert expected_tops({TIP.name: 0.5}) == {"aspirate": half, "transit": half}


def test_before_anything_is_learned_no_end_is_claimed() -> None:
    assert expected_tops({}) == {}


def test_the_band_is_the_one_by_which_the_well_was_sent() -> None:
    assert told({}, Triage(Route.CALIBRATION, ""))["band"] is None
    assert told({}, Triage(Route.SILENT_PASS, "", band=(0.0, 3.8)))["band"] == [0.0, 3.8]
