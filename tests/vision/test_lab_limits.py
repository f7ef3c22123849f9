"""A laboratory's own limit: what it weighs, and what a file keeps of it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aegis_ot.errors import ModelError
from aegis_ot.sidecar.analysers import load_scorer
from aegis_ot.vision import lab_limits
from aegis_ot.vision.calibration import CalibrationSettings
from aegis_ot.vision.calibration_group import CalibrationGroup, OpenTrajectory
from aegis_ot.vision.column_reader import MeasuredColumns
from aegis_ot.vision.delivery import Delivery, Shown
from aegis_ot.vision.gates import GateInput, VolumetricGate
from aegis_ot.vision.lab_limits import LOADED, READINGS, LabLimit, LabLimits, readings_of
from aegis_ot.vision.measuring import ColumnReading, SeenColumn
from aegis_ot.vision.models import SHIPPED, ModelFile, load_model, save_model
from aegis_ot.vocabulary import Gate, KeyframeKind, Outcome, Route
from tests.vision.samples import sample

TRANSIT, AFTER = KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE
RED, WATER = ("p1000", "red"), ("p1000", "water")


def case(after: ColumnReading | None = None, drawn_ul: float = 100.0) -> GateInput:
    full = ColumnReading(100.0, 3.0, seen=SeenColumn(drawn_ul, 3.0, 0.5), tested=6)
    readings = {TRANSIT: full, AFTER: after or ColumnReading(0.0, 1.0, tested=6)}
    delivery = Delivery(Shown.EMPTIED, 5.0, unbroken=0.9)
    signs = {"retained": 4.0}
    return GateInput(
        sample(), Route.GREY_ZONE, None, readings, delivery=delivery, signs=signs, p_value=0.5
    )


def weighing(reading: str, limit: float = 1.0) -> LabLimit:
    weights = np.zeros(len(READINGS))
    weights[READINGS.index(reading)] = 1.0
    return LabLimit(weights, np.zeros(len(READINGS)), np.full(len(READINGS), 0.05), 0.0, limit)


def reading(name: str, of: GateInput, **wet: tuple[float, ...]) -> float:
    told = {KeyframeKind[kind]: shares for kind, shares in wet.items()}
    return float(readings_of(of, told)[READINGS.index(name)])


def test_what_was_measured_of_a_well_is_told_in_shares_of_its_volume() -> None:
    left = case(ColumnReading(12.0, 3.0, excess=9.0, tested=6))
    assert reading("left", left) == pytest.approx(0.12)
    assert reading("excess", left) == pytest.approx(3.0)
    assert reading("retained", left) == pytest.approx(2.0)
    assert reading("broken", left) == pytest.approx(0.1)
    much, little = case(drawn_ul=125.0), case(drawn_ul=90.0)
    assert (reading("more", much), reading("less", much)) == pytest.approx((0.25, 0.0))
    assert (reading("more", little), reading("less", little)) == pytest.approx((0.0, 0.1))


def test_rows_that_are_dry_in_transit_or_wet_afterwards_are_bad() -> None:
    shares = (0.1, 0.2, 0.3, 0.4)
    assert reading("dry below 100 %", case(), TRANSIT=shares) == pytest.approx(0.6)
    assert reading("wet below 25 %", case(), POST_DISPENSE=shares) == pytest.approx(0.1)


def test_what_cannot_be_told_counts_as_usual() -> None:
    bare = GateInput(sample(), Route.GREY_ZONE)
    told = readings_of(bare, {})
    assert np.isnan(told).all()
    assert LabLimits({RED: [weighing("left")]}).beyond(bare, {}) == -1.0


def test_a_limit_holds_for_its_liquid_alone() -> None:
    left = case(ColumnReading(12.0, 3.0, tested=6))
    assert LabLimits({RED: [weighing("left")]}).beyond(left, {}) == pytest.approx(2.4 - 1.0)
    assert LabLimits({WATER: [weighing("left")]}).beyond(left, {}) == 0.0


def test_a_well_beyond_one_of_several_limits_is_beyond() -> None:
    left = case(ColumnReading(12.0, 3.0, tested=6))
    both = LabLimits({RED: [weighing("empty"), weighing("left")]})
    assert both.beyond(left, {}) == pytest.approx(2.4 - 1.0)


def test_every_reading_speaks_of_what_is_left_or_of_what_was_drawn() -> None:
    assert set(lab_limits.AFTER) | set(LOADED) == set(READINGS)
    assert {"left", "wet below 100 %"} <= set(lab_limits.AFTER) - set(LOADED)
    assert {"more", "dry below 100 %", "gap_transit"} <= set(LOADED) - set(lab_limits.AFTER)


def test_a_well_beyond_the_limit_is_left_to_the_operator() -> None:
    usual = case()
    assert VolumetricGate().examine(usual).outcome is Outcome.PASS
    decision = VolumetricGate().examine(replace(usual, beyond_lab=0.1))
    assert decision.outcome is Outcome.UNDECIDED
    assert "laboratory planted" in decision.reason
    assert decision.gate is Gate.VOLUMETRIC


def test_until_a_few_wells_were_learned_no_limit_is_held_against_any() -> None:
    class Strict(LabLimits):
        def beyond(self, case: Any, wet: Any) -> float:
            return 1.0

    scorer: Any = load_scorer(SHIPPED)
    scorer.lab_limits = Strict({})
    group = CalibrationGroup(scorer, MeasuredColumns(), CalibrationSettings())
    assert group.beyond_lab(case(), OpenTrajectory()) == 0.0
    group.learned = 3
    assert group.beyond_lab(case(), OpenTrajectory()) == 1.0
    assert group.beyond_lab(replace(case(), missing=(AFTER,)), OpenTrajectory()) == 0.0


def saved(path: Path, limits: LabLimits, **other: Any) -> Path:
    made = load_model(SHIPPED)
    arrays, settings = limits.to_arrays()
    told = {**made.settings, **settings}
    if other:
        told["lab"] = {**told["lab"], **other}
    save_model(path, made.kind, {**made.arrays, **arrays}, told, {})
    return path


def test_a_model_file_keeps_limits_and_older_files_have_none(tmp_path: Path) -> None:
    limits = LabLimits(
        {RED: [weighing("left")], WATER: [weighing("excess", 3.0), weighing("empty")]}
    )
    scorer: Any = load_scorer(saved(tmp_path / "lab.model", limits))
    left = case(ColumnReading(12.0, 3.0, tested=6))
    assert scorer.lab_limits.beyond(left, {}) == pytest.approx(limits.beyond(left, {}))
    assert [limit.limit for limit in scorer.lab_limits.limits[WATER]] == [3.0, 1.0]
    older: Any = load_scorer(SHIPPED)
    assert older.lab_limits.limits == {}


@pytest.mark.parametrize(
    ("other", "says"),
    [({"readings": ["another"]}, "other readings"), ({"of": [["p1000"]]}, "garble")],
)
def test_limits_of_another_version_are_refused_in_words(
    tmp_path: Path, other: dict[str, Any], says: str
) -> None:
    path = saved(tmp_path / "lab.model", LabLimits({RED: [weighing("left")]}), **other)
    with pytest.raises(ModelError, match=f"{says}.*fit it anew"):
        load_scorer(path)


def test_limits_whose_arrays_are_gone_are_refused() -> None:
    _, settings = LabLimits({RED: [weighing("left")]}).to_arrays()
    with pytest.raises(ModelError, match="fit it anew"):
        LabLimits.from_model(ModelFile("ensemble", {}, settings))
