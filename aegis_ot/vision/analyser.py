"""One run, well by well: look at each frame as it comes, judge when the trajectory is complete."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from ..vocabulary import Gate, Keyframe, KeyframeKind, Outcome, Route, Verdict
from .calibration import CalibrationState
from .calibration_group import CalibrationGroup, OpenTrajectory
from .camera import Frame
from .cascade import Triage
from .column_look import Looks
from .delivery import Delivery, delivery_of
from .evidence import evidence_of
from .first_wells import FirstWells, Liquid, liquid_of
from .gates import GateDecision, GateInput, Gates, in_sentences
from .leftover import Leftover, Leftovers, still_there
from .pressure import found_in, weighed
from .registration.locating import TipLocator
from .second_opinion import SecondOpinion
from .tips import tip_for
from .types import FREE, Detector, TrajectorySample, is_image

MOST_OPEN = 32
"""Trajectories whose frames are kept at once: one that is never judged must not fill memory."""

MOST_ASKED = 2
"""Undecided first wells whose frames are kept, to learn from them once the operator vouches."""

_CUT_OFF = (
    "The tip's upper end is outside the picture: a column that reaches up there cannot be measured "
    "whole. Aim the camera higher (aegis-ot aim says at which wells)."
)

Judged = tuple[Verdict, Mapping[str, Any]]


@dataclass(frozen=True)
class _Well:
    """What a run learns from."""

    stream: CalibrationGroup
    liquid: Liquid
    case: GateInput
    looks: Looks
    clean: bool
    """Whether its tip holds nothing that an earlier well left: else it looks like no other."""
    last: Keyframe


class RunAnalyser:
    """Judges the trajectories of one run, one call at a time.

    Calibration is per liquid and pipette: see :class:`~.calibration_group.CalibrationGroup`.

    It follows one tip; of several, the one that the detector picks. The tips of a multi-channel
    pipette are followed by one analyser each: see :mod:`.rows`.

    Args:
        run: Identifier of the run.
        detector: Finds the tip.
        make_stream: Makes a stream, given one of the same pipette and tip, if there is one.
        gates: Asked in turn.
        first: Holds the run's first wells against what is known without them.
        second: Asked about wells that pass.
    """

    def __init__(
        self,
        run: str,
        detector: Detector,
        make_stream: Callable[[CalibrationGroup | None], CalibrationGroup],
        gates: Gates,
        first: FirstWells,
        second: SecondOpinion,
    ) -> None:
        self.run = run
        self._second = second
        self._detector = detector
        self._locator = TipLocator(detector)
        self._cut_off_told = False
        self._make_stream = make_stream
        self._gates = gates
        self._first = first
        self._leftovers = Leftovers()
        self._asked: dict[int, _Well] = {}
        self._streams: dict[Liquid, CalibrationGroup] = {}
        self._open: dict[int, OpenTrajectory] = {}

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        """A keyframe was captured: find the tip and measure while the robot moves on."""
        trajectory = self._open.setdefault(keyframe.trajectory, OpenTrajectory())
        while len(self._open) > MOST_OPEN:
            del self._open[min(self._open)]
        kind, image = keyframe.kind, frame.image
        trajectory.keyframes[kind] = keyframe
        if not is_image(image):
            trajectory.unusable.append(kind)
            return
        tip = tip_for(keyframe.pipette, keyframe.capacity_ul)
        # Where the robot holds the tip says nothing of a picture that is drawn or replayed.
        place = None if frame.simulated else keyframe.position
        located = self._locator.locate(image, place, tip.name, kind not in FREE)
        detection = located.detection
        expected = located.expected
        if expected is not None and expected.is_sure:
            trajectory.projected[kind] = expected.as_detection(tip)
            size = (image.shape[1], image.shape[0])
            trajectory.cut_off |= kind in FREE and expected.lacking(size) == "upper end"
        trajectory.frames[kind] = image
        trajectory.detections[kind] = detection
        if detection is not None:
            self._stream(keyframe).look(trajectory, kind, detection)
        if kind is KeyframeKind.ASPIRATE:
            self._stream(keyframe).catch_up()
        if kind is KeyframeKind.DISPENSE:
            sample = self._sample(trajectory)
            self._stream(keyframe).scorer.look_ahead(sample)

    def judge(self, trajectory: int) -> Judged:
        """The trajectory is complete: its verdict, and what stands behind it."""
        seen = self._open.pop(trajectory, None)
        if seen is None or not seen.detections:
            verdict = Verdict(
                self.run,
                trajectory,
                Outcome.UNDECIDED,
                Route.UNCALIBRATED,
                gate=Gate.OPERATOR,
                reason="No usable frame of this trajectory was captured; please look at the tip.",
            )
            return verdict, {}
        last = seen.last
        stream = self._stream(last)
        stream.settle(seen, self._detector)
        sample = self._sample(seen)
        case = self._case(stream, seen, sample, last)
        screened = self._gates.screen(case)
        speaks = screened.outcome is Outcome.FAIL or case.alarming
        against = screened.reason if speaks else ""
        triage = stream.cascade.triage(case.score, case.missing, against)
        case = replace(case, route=triage.route)
        decision = self._decide(stream, case, triage)
        limit = None if triage.band is None else triage.band[1]
        decision = self._second.on(case, decision, stream.learned + 1, limit)
        left = None
        if decision.outcome is not Outcome.PASS:
            delivery = partial(self._delivery, seen, last)
            left = self._leftovers.explaining(last, case, delivery)
        if left is not None:
            decision = weighed(still_there(left, decision), last, case.delivery)
        else:
            clean = self._leftovers.known(last) is None
            well = _Well(stream, liquid_of(last), case, dict(seen.looks), clean, last)
            decision = self._learn(well, trajectory, weighed(decision, last, case.delivery))
        if seen.cut_off and not self._cut_off_told:
            self._cut_off_told = True
            decision = replace(decision, reason=in_sentences(decision.reason, _CUT_OFF))
        self._leftovers.note(last, case, decision)
        kept = self._leftovers.known(last)
        evidence = evidence_of(liquid_of(last), stream, case, seen, triage, decision, kept)
        if trajectory not in self._asked:
            seen.frames.clear()
        return _verdict(self.run, trajectory, case, decision), evidence

    def confirm(self, trajectory: int) -> None:
        """The operator looked at an undecided well and found it right, or let the run go on.

        If it is one of the first wells, those after it are compared with it.
        """
        asked = self._asked.pop(trajectory, None)
        if asked is None:
            return
        asked.stream.vouched = True
        self._first.vouch(asked.case.delivery)
        self._take(asked, GateDecision(Outcome.PASS, Gate.OPERATOR, ""))

    def recall(self, history: Sequence[Judged]) -> None:
        """Restore the bands from what was judged before a restart."""
        for _, evidence in history:
            known = evidence.get("calibration") if isinstance(evidence, Mapping) else None
            if not isinstance(known, Mapping):
                continue
            try:
                pipette, capacity, liquid = known["stream"]
                key = (str(pipette), float(capacity), str(liquid))
                scores = {str(name): float(score) for name, score in known["scores"].items()}
                normal, volume = bool(known["normal"]), float(known["volume_ul"])
                strength, left = known.get("strength"), known.get("left")
                unbroken = known.get("unbroken")
                held = None if left is None else Leftover(**left)
                self._leftovers.restore(pipette.split()[0], held)
            except (KeyError, TypeError, ValueError, AttributeError, IndexError):
                continue
            if normal and isinstance(strength, float):
                self._first.restore(
                    key, strength, unbroken if isinstance(unbroken, float) else None
                )
            elif normal and known.get("unseen") is True:
                self._first.restore_unseen(key)
            stream = self._stream_of(key)
            score = scores.get(stream.scorer.name)
            stream.cascade.learn(score, normal=normal, volume_ul=volume)

    def _case(
        self,
        stream: CalibrationGroup,
        seen: OpenTrajectory,
        sample: TrajectorySample,
        last: Keyframe,
    ) -> GateInput:
        missing = tuple(
            kind
            for kind, found in seen.detections.items()
            if found is None and kind not in seen.excused
        )
        readings = stream.reader.read(seen.looks, sample.expected_ul)
        score = stream.scorer.score(sample, seen.excused)
        p_value = stream.p_value(score)
        case = GateInput(
            sample, Route.GREY_ZONE, score, readings, missing, stream.learned > 0, p_value,
            clearly_absent=seen.clearly_absent,
            delivery=self._delivery(seen, last),
            signs={} if score is None else stream.scorer.signs(sample), normal=stream.normal,
            tip_doubted=self._leftovers.doubted(last),
        )  # fmt: skip
        return replace(case, beyond_lab=stream.beyond_lab(case, seen))

    def _delivery(self, seen: OpenTrajectory, last: Keyframe, left_ul: float = 0.0) -> Delivery:
        """What a trajectory shows of its delivery, if the tip held so much before and after, µL."""
        expected = {kind: frame.expected_ul + left_ul for kind, frame in seen.keyframes.items()}
        return self._first.held_against(liquid_of(last), delivery_of(seen.looks, expected))

    def _stream(self, keyframe: Keyframe) -> CalibrationGroup:
        return self._stream_of(liquid_of(keyframe))

    def _stream_of(self, key: Liquid) -> CalibrationGroup:
        if key not in self._streams:
            kin = next((s for k, s in self._streams.items() if k[:2] == key[:2]), None)
            self._streams[key] = self._make_stream(kin)
        return self._streams[key]

    def _decide(self, stream: CalibrationGroup, case: GateInput, triage: Triage) -> GateDecision:
        if triage.route is Route.CALIBRATION:
            gross = self._gates.screen(case)
            if gross.outcome is Outcome.FAIL:
                return gross
            if case.alarming or triage.missing:
                return replace(gross, outcome=Outcome.UNDECIDED, gate=Gate.OPERATOR)
            number = f"Calibration well {stream.learned + 1} of {stream.settings.wells}."
            return replace(gross, outcome=Outcome.PASS, gate=Gate.NONE, reason=number)
        if not triage.to_gate:
            after = case.readings.get(KeyframeKind.POST_DISPENSE)
            return GateDecision(
                Outcome.PASS,
                Gate.NONE,
                triage.reason,
                None,
                None if after is None or after.vague else after.volume_ul,
                case.sample.expected_ul.get(KeyframeKind.POST_DISPENSE),
            )
        decision = self._gates.confirm(case)
        return replace(decision, reason=in_sentences(triage.reason, decision.reason))

    def _learn(self, well: _Well, trajectory: int, decision: GateDecision) -> GateDecision:
        """Calibrate on a well, unless the operator has to look at it first."""
        looked = decision.gate.traits.is_model or decision.gate.traits.is_person
        unseen = decision.outcome is Outcome.PASS and not looked
        ask, found = self._first.question, found_in(well.last)
        question = ask(well.liquid, well.case.delivery, found) if unseen else ""
        if question:
            decision = replace(
                decision, outcome=Outcome.UNDECIDED, gate=Gate.OPERATOR, reason=question
            )
        undecided = decision.outcome is Outcome.UNDECIDED
        if undecided and well.last.liquid_found is False:
            return decision  # who fills the source and resumes vouches for nothing
        first = well.case.route is Route.CALIBRATION and undecided
        if question or first:
            self._asked[trajectory] = well
            while len(self._asked) > MOST_ASKED:
                del self._asked[min(self._asked)]
            return decision
        self._take(well, decision)
        return _with_doubt(well.stream, decision)

    def _take(self, well: _Well, decision: GateDecision) -> None:
        stream, case, looks = well.stream, well.case, well.looks
        normal = decision.outcome is Outcome.PASS
        if normal and not well.clean:
            return
        if not normal and self._first.proven(well.liquid):
            return  # the others were not taken on trust, so this one casts no doubt on them
        collecting = stream.cascade.state is CalibrationState.COLLECTING
        whole = len(case.sample.frames) == len(KeyframeKind) and not case.missing
        if collecting and normal and whole and not stream.scorer.ready:
            # The run's own model: its first wells are scored once they are all there.
            for score, volume in stream.scorer.learn(case.sample):
                stream.cascade.learn(score, normal=True, volume_ul=volume)
        elif case.score is not None or not normal:
            volume = case.sample.volume_ul
            stream.cascade.learn(case.score, normal=normal, volume_ul=volume)
        if normal:
            self._first.learn(well.liquid, case)
            # What passed outside the band for want of proof is no example of a normal well.
            proven = case.route is not Route.GREY_ZONE or decision.gate.traits.is_person
            stream.learn(case.sample, looks, proven and case.score is not None)

    def _sample(self, seen: OpenTrajectory) -> TrajectorySample:
        return seen.sample(self.run)


def _verdict(run: str, trajectory: int, case: GateInput, decision: GateDecision) -> Verdict:
    emptied = case.readings.get(KeyframeKind.POST_DISPENSE)
    readable = emptied if emptied is not None and not emptied.vague else None
    return Verdict(
        run,
        trajectory,
        decision.outcome,
        case.route,
        case.score,
        decision.gate,
        decision.failure,
        decision.reason,
        decision.measured_ul,
        decision.expected_ul,
        None if readable is None else readable.volume_ul,
        None if readable is None else readable.sigma_ul,
    )


def _with_doubt(stream: CalibrationGroup, decision: GateDecision) -> GateDecision:
    """Tell of an earlier well that turned out to be suspect, once, with the next that passes."""
    if not stream.doubt or decision.outcome is not Outcome.PASS:
        return decision
    reason, stream.doubt = stream.doubt, ""
    return replace(decision, outcome=Outcome.UNDECIDED, gate=Gate.OPERATOR, reason=reason)
