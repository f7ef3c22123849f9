"""A whole run as the sidecar drives it, on simulated frames with exact tip positions."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.simulation.dyes import dye_for
from aegis_ot.simulation.exposure import decode
from aegis_ot.simulation.fault_plan import FaultPlan
from aegis_ot.simulation.render import render_jpeg
from aegis_ot.simulation.scene import place_tip
from aegis_ot.simulation.session import SessionParameters
from aegis_ot.vision.camera import Frame
from aegis_ot.vision.gates import GateDecision, GateInput, OperatorGate, VolumetricGate
from aegis_ot.vision.registration import Located, ProjectedTip, TipLocator
from aegis_ot.vision.run_analyser_factory import Judged, MonitorSettings, RunAnalyserFactory
from aegis_ot.vision.second_opinion import SpotCheck
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import Image, TipDetection, TrajectorySample
from aegis_ot.vocabulary import (
    FailureType,
    Gate,
    Keyframe,
    KeyframeKind,
    Outcome,
    Route,
    WellRef,
    to_json,
)

VOLUMES = (100.0, 200.0, 150.0, 300.0)


class Told:
    """A detector that is told where the tip is."""

    found: TipDetection | None = None

    def detect(self, image: Image) -> TipDetection | None:
        return self.found


EQUAL_THEN_VARIED = (*[150.0] * 6, *(120.0, 135.0, 160.0, 180.0, 110.0, 145.0, 130.0, 165.0) * 2)


def keyframes(
    wells: int,
    channels: int = 1,
    reagent: str = "red dye",
    volumes: Sequence[float] = VOLUMES,
    pipette: str = "p1000",
    tip: str = "",
) -> Iterator[Keyframe]:
    sequence = 0
    for number in range(wells):
        volume = volumes[number % len(volumes)]
        well = WellRef("plate", f"{'ABCDEFGH'[number % 8]}{number // 8 + 1}", "plate", "2")
        source = WellRef("reservoir", "A1", "reservoir", "1")
        for kind in KeyframeKind:
            loaded = kind in (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT)
            yield Keyframe(
                "run", sequence, number, kind, f"{pipette}_single_gen2", "left", channels,
                tip or f"1:{number}", (source,), (well,), volume, volume if loaded else 0.0,
                float(pipette[1:]), reagent,
            )  # fmt: skip
            sequence += 1


def judge_run(
    wells: int,
    faults: Sequence[str] = (),
    history: Sequence[Judged] = (),
    seed: int = 0,
    volumes: Sequence[float] = VOLUMES,
    pipette: str = "p1000",
    reagent: str = "red dye",
    tip: str = "",
    operator: bool = False,
    probed: Mapping[int, bool] | None = None,
    lights: Mapping[int, float] | None = None,
    monitor: Callable[[Told], RunAnalyserFactory] = RunAnalyserFactory,
) -> list:
    """``lights``: how much brighter a well's frame after the dispense is, by number from 1."""
    parameters = SessionParameters.webcam(seed)
    plan, rng, detector = FaultPlan(faults), np.random.default_rng(seed), Told()
    analyser = monitor(detector).begin("run", history)
    judged = []
    for plain in keyframes(wells, reagent=reagent, volumes=volumes, pipette=pipette, tip=tip):
        keyframe = replace(plain, liquid_found=(probed or {}).get(plain.trajectory))
        contents = plan.apply(keyframe).contents
        state = place_tip(
            parameters, keyframe.kind, tip_for(keyframe.pipette, keyframe.capacity_ul), contents,
            dye_for(keyframe.reagent), destination=keyframe.destinations[0].name,
        )  # fmt: skip
        light = (lights or {}).get(keyframe.trajectory + 1, 0.0)
        emptied = keyframe.kind is KeyframeKind.POST_DISPENSE
        session = replace(parameters, overexposed_chance=1.0, overexposed_gain=light)
        jpeg, truth = render_jpeg(state, session if light and emptied else parameters, rng)
        tip = truth.tip
        detector.found = (
            None if tip.box is None else TipDetection(*tip.box, 0.99, tip.orifice, tip.collar)
        )
        analyser.observe(keyframe, Frame(jpeg, decode(jpeg), 0.0))
        if keyframe.kind is KeyframeKind.POST_DISPENSE:
            judged.append(analyser.judge(keyframe.trajectory))
            if operator and judged[-1][0].outcome is Outcome.UNDECIDED:
                analyser.confirm(keyframe.trajectory)
    return judged


@pytest.fixture(scope="module")
def run() -> list:
    return judge_run(24, ("no_aspirate@#10", "partial:50@#14", "no_dispense@#18", "no_tip@#22"))


def test_normal_wells_raise_no_alarm(run) -> None:
    normal = [verdict for verdict, _ in run if verdict.trajectory + 1 not in (10, 14, 18, 22)]
    assert {verdict.outcome for verdict in normal} == {Outcome.PASS}


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_other_volumes_than_those_of_equal_first_wells_raise_no_alarm(seed) -> None:
    """Rows that no calibration well filled are unknown: they must not lengthen the column."""
    judged = judge_run(22, seed=seed, volumes=EQUAL_THEN_VARIED, pipette="p300")
    assert {verdict.outcome for verdict, _ in judged} == {Outcome.PASS}


def test_neither_do_they_in_water() -> None:
    judged = judge_run(
        18, volumes=EQUAL_THEN_VARIED, pipette="p300", reagent="water", operator=True
    )
    asked = [number for number, (verdict, _) in enumerate(judged) if verdict.outcome != "pass"]
    assert asked == [1], "once, whether water is seen to leave at all"


def test_water_that_stays_is_seen() -> None:
    faults = ("partial:25@#8", "no_dispense@#10")
    judged = judge_run(11, faults, pipette="p300", reagent="water", operator=True, seed=3)
    outcomes = [verdict.outcome for verdict, _ in judged[2:]]
    assert outcomes == [
        *[Outcome.PASS] * 5,
        *(Outcome.FAIL, Outcome.PASS, Outcome.FAIL, Outcome.PASS),
    ]


def test_the_first_six_wells_calibrate(run) -> None:
    assert [v.route for v, _ in run[:6]] == [Route.CALIBRATION] * 6
    assert Route.CALIBRATION not in {v.route for v, _ in run[6:]}


@pytest.mark.parametrize(
    ("number", "failures"),
    [
        (10, {FailureType.NO_ASPIRATE}),
        (14, {FailureType.PARTIAL_DISPENSE}),
        (18, {FailureType.NO_DISPENSE, FailureType.PARTIAL_DISPENSE}),
        (22, {FailureType.NO_TIP}),
    ],
)
def test_planted_faults_are_caught_and_confirmed_by_the_gate(run, number, failures) -> None:
    verdict, _ = run[number - 1]
    assert verdict.outcome is Outcome.FAIL
    assert verdict.gate is Gate.VOLUMETRIC
    assert verdict.failure in failures
    assert verdict.reason


class ScoredByWell:
    """A world model whose scores are written down, and that remembers what it adapted to."""

    name = "ensemble"
    height_factors: Mapping[str, float] = {}
    adapted: set[str]

    def __init__(self, scores: Mapping[str, float]) -> None:
        self.scores, self.adapted = scores, set()

    def __deepcopy__(self, memo: object) -> ScoredByWell:
        return self  # a run works on a copy, which nobody could look at

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        pass

    def score(self, sample: TrajectorySample) -> float:
        return self.scores.get(sample.well, 0.5)

    score_of_seen = score

    def p_value(self, sample: TrajectorySample) -> float:
        return float(np.exp(-self.score(sample)))

    def calibrate(self, normals: Sequence[TrajectorySample]) -> None:
        self.adapted.update(sample.well for sample in normals)

    def look_ahead(self, sample: TrajectorySample) -> None:
        pass

    def signs(self, sample: TrajectorySample) -> Mapping[str, float]:
        return {}


def test_what_passed_for_want_of_proof_is_no_example_of_a_normal_well() -> None:
    scorer = ScoredByWell({"G1": 5.0})
    judged = judge_run(
        12, reagent="water", operator=True, monitor=lambda found: RunAnalyserFactory(found, scorer)
    )
    verdict = judged[6][0]
    assert (verdict.route, verdict.outcome) == (Route.GREY_ZONE, Outcome.PASS)
    assert {"A1", "F1", "H1"} <= scorer.adapted
    assert "G1" not in scorer.adapted


@pytest.mark.parametrize("outcome", [Outcome.PASS, Outcome.FAIL])
def test_a_model_sees_what_triage_sent_and_the_volumes_passed(outcome: Outcome) -> None:
    seen: list[Route] = []

    class Model:
        gate = Gate.VLM
        screens = False

        def examine(self, case: GateInput) -> GateDecision:
            seen.append(case.route)
            return GateDecision(outcome, self.gate, "A bubble.", FailureType.AIR_BUBBLE)

    def monitor(detector: Told, *gates: Model) -> RunAnalyserFactory:
        settings = MonitorSettings(always_gate=True, spot_check=SpotCheck(0.0))
        return RunAnalyserFactory(
            detector, None, settings, [VolumetricGate(), *gates, OperatorGate()]
        )

    alone = [verdict for verdict, _ in judge_run(9, monitor=monitor)]
    heard = [v for v, _ in judge_run(9, monitor=lambda told: monitor(told, Model()))]
    assert {(v.outcome, v.gate) for v in alone[6:]} == {(Outcome.PASS, Gate.VOLUMETRIC)}
    assert seen == [Route.ALWAYS_GATE] * 3
    if outcome is Outcome.PASS:
        assert heard == alone, "it clears nothing, and changes nothing"
    else:
        assert heard[:6] == alone[:6]
        assert {(v.outcome, v.gate) for v in heard[6:]} == {(Outcome.UNDECIDED, Gate.VLM)}


@pytest.mark.parametrize("light", [0.45, 2.2])
def test_a_dye_left_in_the_tip_is_seen_in_a_frame_of_another_brightness(light) -> None:
    judged = judge_run(10, ("no_dispense@#9",), lights={8: light, 9: light})
    assert [verdict.outcome for verdict, _ in judged[6:]] == [
        *(Outcome.PASS, Outcome.PASS, Outcome.FAIL, Outcome.PASS)
    ]
    assert judged[8][0].measured_ul == pytest.approx(VOLUMES[0], rel=0.1)


def test_the_verdict_names_the_volumes(run) -> None:
    verdict, _ = run[13]
    assert verdict.expected_ul == 0
    assert verdict.measured_ul == pytest.approx(100, rel=0.35)


def test_evidence_is_plain_and_tells_boxes_scores_and_channels(run) -> None:
    verdict, evidence = run[7]
    assert json.loads(json.dumps(to_json(verdict)))["trajectory"] == 7
    text = json.dumps(evidence)
    assert "boxes" in text
    assert set(evidence["boxes"]) == {kind.value for kind in KeyframeKind}
    assert evidence["tips_judged"] == 1
    assert evidence["scores"]["pca"] > 0


def test_the_band_in_the_evidence_is_the_one_that_the_well_met(run) -> None:
    assert [evidence["band"] for _, evidence in run[:6]] == [None] * 6, "the sixth sets it"
    for verdict, evidence in run[6:]:
        if verdict.route is Route.SILENT_PASS:
            assert verdict.score <= evidence["band"][1]


def test_a_missing_tip_is_caught_even_while_calibrating() -> None:
    (_, _), (verdict, _) = judge_run(2, ("no_tip@#2",))
    assert verdict.route is Route.CALIBRATION
    assert verdict.outcome is Outcome.FAIL
    assert verdict.failure is FailureType.NO_TIP


def test_no_usable_frame_is_undecided_not_a_crash() -> None:
    analyser = RunAnalyserFactory(Told()).begin("run")
    for keyframe in keyframes(1):
        analyser.observe(keyframe, Frame(b"", np.zeros((0, 0, 3), np.uint8), 0.0))
    verdict, _ = analyser.judge(0)
    assert verdict.outcome is Outcome.UNDECIDED
    verdict, _ = analyser.judge(7)
    assert verdict.outcome is Outcome.UNDECIDED


def test_trajectories_that_are_never_judged_do_not_pile_up() -> None:
    analyser = RunAnalyserFactory(Told()).begin("run")
    image = np.zeros((32, 32, 3), np.uint8)
    for keyframe in keyframes(80):
        analyser.observe(keyframe, Frame(b"", image, 0.0))
    assert len(analyser._open) <= 32


def test_garbled_history_does_not_stop_a_run(run) -> None:
    verdict = run[0][0]
    history = [(verdict, {}), (verdict, {"calibration": "?"}), (verdict, {"calibration": {}})]
    assert RunAnalyserFactory(Told()).begin("run", history) is not None


def test_what_wells_showed_of_a_liquid_is_known_after_a_restart(run) -> None:
    verdict, liquid = run[0][0], ("left p300_single", 300.0, "water")
    known = {"stream": list(liquid), "scores": {}, "normal": True, "volume_ul": 100.0}
    unseen, shown = {**known, "unseen": True}, {**known, "strength": 5.0}
    for wells, proven in (([shown], True), ([unseen, unseen, shown], False)):
        history = [(verdict, {"calibration": well}) for well in wells]
        analyser = RunAnalyserFactory(Told()).begin("run")
        analyser.recall(history)
        assert analyser._first.proven(liquid) is proven


def test_what_is_left_in_a_tip_is_known_after_a_restart_until_it_is_gone(run) -> None:
    verdict, keyframe = run[0][0], next(iter(keyframes(1)))
    left = {"tip": keyframe.tip, "volume_ul": 50.0, "well": "A1"}
    known = {"stream": [f"{keyframe.mount} p300_single", 300.0, "water"], "scores": {}}
    known |= {"normal": False, "volume_ul": 100.0}
    for wells, ul in (([left], 50.0), ([left, None], None)):
        analyser = RunAnalyserFactory(Told()).begin("run")
        analyser.recall([(verdict, {"calibration": {**known, "left": one}}) for one in wells])
        found = analyser._leftovers.known(keyframe)
        assert (None if found is None else found.volume_ul) == ul


def every(fault: str, wells: int) -> list[str]:
    return [f"{fault}@#{number}" for number in range(1, wells + 1)]


@pytest.mark.parametrize("fault", ["no_aspirate", "no_dispense", "partial:50", "no_tip"])
def test_wells_that_all_go_wrong_alike_never_pass(fault) -> None:
    judged = judge_run(5, every(fault, 5), seed=1)
    assert Outcome.PASS not in {verdict.outcome for verdict, _ in judged}


def test_a_clear_liquid_is_asked_about_once_and_the_operators_word_counts() -> None:
    unasked = judge_run(4, reagent="water", seed=1)
    assert {verdict.outcome for verdict, _ in unasked} == {Outcome.UNDECIDED}
    asked = judge_run(8, reagent="water", seed=1, operator=True)
    assert [verdict.outcome for verdict, _ in asked] == [Outcome.UNDECIDED, *[Outcome.PASS] * 7]
    assert [v.route for v, _ in asked[:6]] == [Route.CALIBRATION] * 6


def test_an_empty_source_after_sound_wells_is_no_pass() -> None:
    judged = judge_run(6, ("no_aspirate@#4", "no_dispense@#5"), seed=1)
    assert [verdict.outcome for verdict, _ in judged] == [
        *[Outcome.PASS] * 3, Outcome.FAIL, Outcome.FAIL, Outcome.PASS
    ]  # fmt: skip


@pytest.mark.parametrize("fault", ["partial:50", "no_dispense"])
def test_one_fault_on_a_tip_that_is_used_again_is_told_once(fault) -> None:
    judged = judge_run(8, (f"{fault}@#4",), seed=1, volumes=(100.0,), tip="1:A1")
    told = [verdict.trajectory for verdict, _ in judged if verdict.outcome is not Outcome.PASS]
    assert told == [3]
    assert "as reported there" in judged[4][0].reason


def test_a_second_fault_on_that_tip_is_told_too() -> None:
    faults = ("partial:50@#4", "no_dispense@#6")
    judged = judge_run(8, faults, seed=1, volumes=(100.0,), tip="1:A1")
    told = [verdict.trajectory for verdict, _ in judged if verdict.outcome is not Outcome.PASS]
    assert told == [3, 5]


class _Above(TipLocator):
    """Knows the camera, above whose picture the tips' upper ends are."""

    def locate(self, *_: object, **__: object) -> Located:
        there = ProjectedTip((318.0, 300.0), (318.0, -20.0), 0.5, 3.6)
        found = TipDetection(310.0, 0.0, 16.0, 300.0, 0.8, there.orifice, there.collar)
        return Located(found, there)


def test_a_tip_that_is_cut_off_by_the_frame_is_told_of_once() -> None:
    detector = Told()
    analyser = RunAnalyserFactory(detector).begin("run")
    analyser._locator = _Above(detector)
    image = np.full((480, 640, 3), 90, np.uint8)
    for keyframe in keyframes(2):
        analyser.observe(keyframe, Frame(b"", image, 0.0))
    first, second = (analyser.judge(number)[0].reason for number in range(2))
    assert "upper end is outside the picture" in first
    assert "outside the picture" not in second


class _Asked(TipLocator):
    """Notes where the robot is said to hold the tip."""

    def __init__(self, detector: Told) -> None:
        super().__init__(detector)
        self.places: list[object] = []

    def locate(self, image: Image, position: object, *_: object, **__: object) -> Located:
        self.places.append(position)
        return Located(None)


@pytest.mark.parametrize("simulated", [False, True])
def test_where_the_robot_holds_the_tip_says_nothing_of_a_drawn_frame(simulated: bool) -> None:
    analyser = RunAnalyserFactory(Told()).begin("run")
    analyser._locator = asked = _Asked(Told())
    image = np.full((48, 64, 3), 90, np.uint8)
    for keyframe in keyframes(1):
        there = replace(keyframe, position=(14.4, 74.2, 40.0))
        analyser.observe(there, Frame(b"", image, 0.0, simulated))
    assert asked.places == [None if simulated else (14.4, 74.2, 40.0)] * 4
