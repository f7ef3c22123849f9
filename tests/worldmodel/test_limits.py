"""Limits of a laboratory's own, fitted on what it planted."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.vision.gates import GateInput
from aegis_ot.vision.lab_limits import READINGS
from aegis_ot.vision.measuring import ColumnReading
from aegis_ot.vocabulary import Gate, KeyframeKind, Outcome, Route, Verdict
from aegis_ot.worldmodel import limits
from aegis_ot.worldmodel.cascade import JudgedWell
from aegis_ot.worldmodel.leave_one_out import HeldOut, ScoredWell
from aegis_ot.worldmodel.limits import LimitFit, LimitGoal, fit_limits
from tests.vision.samples import sample

TRANSIT, AFTER = KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE
SHARES = (0.1, 0.2, 0.3, 0.4, 0.5, 0.75, 1.0)


class Model:
    """A scorer that nobody asks."""

    name = "model"
    p_value = None


def fitted(
    monkeypatch: pytest.MonkeyPatch,
    slope: float,
    wanted: LimitGoal | None = None,
    wells: int = 20,
    undrawn: bool = False,
) -> LimitFit:
    """Fit on ``wells`` normals and as many leftovers, which read ``slope`` times what is left, and
    perhaps on six wells for which nothing was drawn."""
    rng = np.random.default_rng(4)
    model = Model()

    def run(held: HeldOut) -> list[JudgedWell]:
        judged = []
        for number in range(2 * wells + (6 if undrawn else 0)):
            empty = number >= 2 * wells
            share = SHARES[number % len(SHARES)] if number % 2 and not empty else 0.0
            failure = "no_aspirate" if empty else "partial_single" if share else ""
            well = replace(sample(f"p1-{number}", failure=failure), retained_fraction=share or None)
            excess = max(slope * share + rng.normal(0.0, 0.3), 0.0)
            reading = ColumnReading(0.0, 5.0, excess=excess, vague=True)
            full = ColumnReading(0.0 if empty else 100.0 + rng.normal(0.0, 3.0), 3.0)
            case = GateInput(well, Route.GREY_ZONE, readings={TRANSIT: full, AFTER: reading})
            model.lab_limits.beyond(case, {})  # type: ignore[attr-defined]
            verdict = Verdict("p1", number, Outcome.PASS, Route.SILENT_PASS, gate=Gate.NONE)
            judged.append(JudgedWell(ScoredWell(well, 0.0, 0.0, 0.0, False), verdict, {}, False))
        return judged

    monkeypatch.setattr(limits, "run_cascade", run)
    return fit_limits(HeldOut("model", True, [], [], {"p1": model}), wanted)


def test_what_the_readings_tell_is_caught_and_normal_wells_pass(monkeypatch) -> None:
    found = fitted(monkeypatch, 20.0)
    (told,) = found.reports
    assert told.used
    assert told.caught_before == 0
    assert told.caught >= 17
    assert told.flagged == 0
    (limit,) = found.limits.limits["p1000", "red"]
    assert limit.weights.min() >= 0
    assert np.argmax(limit.weights) == 1, "how far rows speak for liquid left is all that tells"
    flagged = [well for well, over in zip(found.judged, found.beyond, strict=True) if over]
    assert len(flagged) == told.caught


def test_what_was_drawn_wrongly_has_a_limit_beside_what_was_left(monkeypatch) -> None:
    found = fitted(monkeypatch, 20.0, undrawn=True)
    left, drawn = found.limits.limits["p1000", "red"]
    assert left.weights[READINGS.index("empty")] == 0 < left.weights[READINGS.index("excess")]
    assert drawn.weights[READINGS.index("excess")] == 0 < drawn.weights[READINGS.index("empty")]
    assert found.reports[0].caught >= 22


def test_where_readings_tell_nothing_there_is_no_limit(monkeypatch) -> None:
    found = fitted(monkeypatch, 0.0)
    (told,) = found.reports
    assert not told.used
    assert found.limits.limits == {}
    assert not any(found.beyond)
    assert told.caught == told.caught_before


def test_the_smallest_leftover_that_is_wanted_is_caught_nine_times_in_ten(monkeypatch) -> None:
    usual = fitted(monkeypatch, 4.0)
    least = fitted(monkeypatch, 4.0, LimitGoal(smallest=0.2))
    meant = [
        over
        for well, over in zip(least.judged, least.beyond, strict=True)
        if (well.sample.retained_fraction or 0.0) >= 0.2
    ]
    assert sum(meant) >= 0.9 * len(meant)
    assert sum(least.beyond) > sum(usual.beyond)
    assert least.reports[0].flagged >= usual.reports[0].flagged


def test_no_well_is_flagged_that_is_more_like_the_normal_ones(monkeypatch) -> None:
    """However far from them the failures are: the next normal well may stray farther than these."""
    for slope in (50.0, 12.0):
        (limit,) = fitted(monkeypatch, slope, LimitGoal(20.0)).limits.limits["p1000", "red"]
        assert limit.limit >= 0


def test_more_false_stops_allow_a_lower_limit(monkeypatch) -> None:
    few, many = (fitted(monkeypatch, 12.0, LimitGoal(rate)) for rate in (0.1, 20.0))
    key = ("p1000", "red")
    (lower,), (higher,) = (found.limits.limits[key] for found in (many, few))
    assert lower.limit < higher.limit


def test_from_few_wells_no_limit_is_fitted(monkeypatch) -> None:
    assert fitted(monkeypatch, 20.0, wells=9).reports == []


def test_the_scorer_is_left_as_it_was(monkeypatch) -> None:
    model = Model()
    monkeypatch.setattr(limits, "run_cascade", lambda held: [])
    fit_limits(HeldOut("model", True, [], [], {"p1": model, "p2": model}))
    assert not hasattr(model, "lab_limits")
