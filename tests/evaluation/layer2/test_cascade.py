"""The cascade on plates: with a band where a plate begins with enough normals."""

from __future__ import annotations

from dataclasses import replace

from aegis_ot.evaluation.layer2.cascade import run_cascade
from aegis_ot.evaluation.layer2.lopo import HeldOut, ScoredWell
from aegis_ot.vocabulary import Outcome, Route
from tests.vision.samples import sample


def held(scores: list[float], standing: float) -> HeldOut:
    wells = [ScoredWell(sample(f"w{i}", seed=i), s, 1.0, standing, False) for i, s in
             enumerate(scores)]  # fmt: skip
    return HeldOut("spy", False, wells[:1], wells[1:])


def test_a_plate_with_enough_normals_is_judged_by_its_own_band() -> None:
    judged = run_cascade(held([1.0, 1.1, 0.9, 1.0, 1.05, 1.0, 1.0, 90.0], standing=-1.0))
    assert [well.calibration for well in judged] == [True] * 6 + [False] * 2
    assert judged[6].triage.route is Route.SILENT_PASS
    assert judged[7].triage.route is Route.GREY_ZONE, "far outside the band of the first six"


def test_a_plate_with_few_normals_is_judged_by_the_threshold() -> None:
    for standing, route in ((-1.0, Route.SILENT_PASS), (1.0, Route.GREY_ZONE)):
        judged = run_cascade(held([1.0, 1.0], standing))
        assert [well.triage.route for well in judged] == [Route.CALIBRATION, route]


def test_a_missing_tip_is_flagged_whatever_the_score() -> None:
    known = held([1.0, 0.0], standing=-1.0)
    lost = replace(known.wells[0], sample=sample("lost", tip=False, failure="no_tip"))
    judged = run_cascade(replace(known, wells=[lost]))
    assert judged[1].triage.route is Route.BLANK_FLOOR
    assert judged[1].decision.outcome is Outcome.FAIL
