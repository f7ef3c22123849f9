"""The cascade on plates: what the live run's own judge makes of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aegis_ot.sidecar import make_analyser
from aegis_ot.sidecar.config import CascadeSettings
from aegis_ot.vision.camera import Frame
from aegis_ot.vision.types import TrajectorySample
from aegis_ot.vocabulary import KeyframeKind, Outcome, Route
from aegis_ot.worldmodel.cascade import keyframes, run_cascade
from aegis_ot.worldmodel.leave_one_out import HeldOut, ScoredWell
from tests.vision.samples import sample


class Spy:
    """A scorer that gives the scores that it was told, well by well."""

    name = "spy"

    def __init__(self, scores: dict[str, float]) -> None:
        self.scores = scores

    def fit(self, normals: Sequence[TrajectorySample]) -> None: ...

    def score(self, sample: TrajectorySample) -> float:
        return self.scores[sample.well]

    def p_value(self, sample: TrajectorySample) -> float:
        raise NotImplementedError


def held(scores: list[float], failed_from: int = 99) -> HeldOut:
    wells = [
        ScoredWell(
            replace(
                sample(f"w{i}", seed=i, failure="partial_50" if i >= failed_from else ""),
                well=f"A{i + 1}",
            ),
            score, 1.0, 0.0, False,
        )
        for i, score in enumerate(scores)
    ]  # fmt: skip
    spy = Spy({well.sample.well: well.score for well in wells})
    return HeldOut("spy", True, wells[:1], wells[1:], {"p1": spy})


def test_a_plate_with_enough_normals_is_judged_by_its_own_band() -> None:
    judged = run_cascade(held([1.0, 1.1, 0.9, 1.0, 1.05, 1.0, 1.0, 90.0]))
    assert [well.calibration for well in judged] == [True] * 6 + [False] * 2
    assert judged[6].verdict.route is Route.SILENT_PASS
    assert judged[7].verdict.route is Route.GREY_ZONE, "far outside the band of the first six"


def test_on_a_plate_with_few_normals_one_well_calibrates_and_p_values_decide() -> None:
    usual, odd = run_cascade(held([0.5, 1.0, 9.0], failed_from=2))[1:]
    assert usual.verdict.route is Route.SILENT_PASS
    assert odd.flagged, "one normal well in a thousand looks like that"
    assert odd.scored.standing > 0


def test_a_missing_tip_is_flagged_whatever_the_score() -> None:
    known = held([1.0, 0.0])
    lost = replace(
        known.wells[0], sample=replace(sample("lost", tip=False, failure="no_tip"), well="A2")
    )
    judged = run_cascade(replace(known, wells=[lost]))
    assert judged[1].verdict.route is Route.BLANK_FLOOR
    assert judged[1].verdict.outcome is Outcome.FAIL


def test_a_recording_is_judged_as_the_sidecar_judges_it_live() -> None:
    known = held([1.0, 1.1, 0.9, 1.0, 1.05, 1.0, 1.0, 90.0])
    # A recording's first normal wells are known to be normal: nobody is asked.
    monitor = make_analyser(CascadeSettings(first_wells="trust"))
    monitor.scorer = known.models["p1"]

    class Told:
        """The boxes of the recording."""

        def detect(self, image: object) -> object:
            return known.anchors[0].sample.detections[KeyframeKind.TRANSIT]

    monitor.detector = Told()
    live = monitor.begin("p1")
    verdicts = []
    for number, well in enumerate([*known.anchors, *known.wells]):
        for keyframe in keyframes(well.sample, number):
            live.observe(keyframe, Frame(b"", well.sample.frames[keyframe.kind], 0.0))
        verdicts.append(live.judge(number)[0])
    assert [well.verdict for well in run_cascade(known)] == verdicts


def test_wells_of_one_tip_are_played_with_it() -> None:
    """A remainder that was told stays in the tip, and is no failure of the next well."""
    one = sample("w")
    assert {keyframe.tip for keyframe in keyframes(one, 3)} == {"3"}
    assert {keyframe.tip for keyframe in keyframes(replace(one, tip_used="A1"), 3)} == {"A1"}
