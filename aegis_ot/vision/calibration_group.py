"""What a run knows of one liquid, and what it holds of one trajectory."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ..vocabulary import Keyframe, KeyframeKind, Outcome, Route
from .calibration import CalibrationSettings, CalibrationState
from .cascade import Cascade
from .column import TipShape, shapes_of
from .column_look import Look, Looks
from .column_reader import MeasuredColumns
from .consistency import TipConsistency, guesses_in, second_look, stands_at
from .gates import GateInput, Gates, VolumetricGate
from .lab_limits import LabLimits
from .outlines import Outlines
from .run_scorer import LEAST_ALARM, RunScorer
from .scorers.looks import hang_alike, look
from .tips import TipGeometry, tip_for
from .types import FREE, Detector, Frames, Position, Scorer, TipDetection, TrajectorySample
from .usual import ENOUGH

_MODEL_WEIGHT = 4.0
"""How many of the run's own wells above their median the model's scale, one nat, is worth."""

_SHOWN = 2
"""First wells whose frames are kept to compare others with: one may turn out to be suspect."""

_LEAST_SCALE = 1.0, 0.3
"""Smallest scale, nats, and as a share of the median. Wells of one run are more alike than those of
a model's many runs, but for the rare one whose tip was found badly; and where all wells look
unusual to the model, so they differ by more."""


@dataclass
class OpenTrajectory:
    """A trajectory whose keyframes are coming in.

    Attributes:
        keyframes: What the robot said of each.
        frames: Whole frames, while they are needed.
        detections: The tip in each.
        looks: What the column reader took from each.
        unusable: Keyframes whose frame was no image.
        excused: Keyframes in which no tip was found though it is on, as the others show.
        clearly_absent: Whether nothing like this run's tips is in the frames without one.
        projected: Where the tip hangs in each, by the robot's word, once the camera is registered.
        cut_off: Whether the upper end of a tip that hangs free is outside the frame.
    """

    keyframes: dict[KeyframeKind, Keyframe] = field(default_factory=dict)
    frames: Frames = field(default_factory=Frames)
    detections: dict[KeyframeKind, TipDetection | None] = field(default_factory=dict)
    looks: dict[KeyframeKind, Look] = field(default_factory=dict)
    unusable: list[KeyframeKind] = field(default_factory=list)
    excused: tuple[KeyframeKind, ...] = ()
    clearly_absent: bool = True
    projected: dict[KeyframeKind, TipDetection] = field(default_factory=dict)
    cut_off: bool = False

    @property
    def before(self) -> TipDetection | None:
        """The tip in TRANSIT, where the one in POST_DISPENSE hangs at the same place."""
        alike = hang_alike(self.detections, self.positions)
        return self.detections.get(KeyframeKind.TRANSIT) if alike else None

    @property
    def positions(self) -> dict[KeyframeKind, Position]:
        """Where the robot held the tip's end, of the keyframes that say so."""
        told = {kind: keyframe.position for kind, keyframe in self.keyframes.items()}
        return {kind: place for kind, place in told.items() if place is not None}

    @property
    def last(self) -> Keyframe:
        """The keyframe that was captured last."""
        return max(self.keyframes.values(), key=lambda keyframe: keyframe.sequence)

    def sample(self, run: str) -> TrajectorySample:
        """What there is of it so far, as the scorers read it."""
        last = self.last
        return TrajectorySample(
            id=f"{run}-{last.trajectory}",
            plate=run,
            well=last.destinations[0].name if last.destinations else "",
            pipette=last.pipette,
            capacity_ul=last.capacity_ul,
            volume_ul=last.commanded_ul,
            frames=self.frames,
            detections=self.detections,
            expected_ul={kind: frame.expected_ul for kind, frame in self.keyframes.items()},
            reagent=last.reagent or "",
            positions=self.positions,
        )


class CalibrationGroup:
    """Wells that look alike when all is well: one pipette, one kind of tip, one liquid.

    A run that pipettes dye and then water has two; each is calibrated on its own first wells.

    Args:
        scorer: World model, or ``None``; see :class:`~.run_scorer.RunScorer`.
        reader: Measures its columns.
        settings: Of the calibration.
        always_gate: Send every well after calibration to the gates.
        kin: A stream of the same pipette, whose reader knows the tip already.
        gates: Asked again about the first wells, beside those after them.
    """

    def __init__(
        self,
        scorer: Scorer | None,
        reader: MeasuredColumns,
        settings: CalibrationSettings,
        always_gate: bool = False,
        kin: CalibrationGroup | None = None,
        gates: Gates | None = None,
    ) -> None:
        self.settings = settings
        self._gates = gates or Gates([VolumetricGate()])
        self.scorer = RunScorer(scorer, settings.wells)
        self._limits: LabLimits | None = getattr(scorer, "lab_limits", None)
        least = LEAST_ALARM if self.scorer.gives_p_values else 0.0
        self.cascade = Cascade(self.scorer.name, settings, always_gate, least)
        self.reader = reader
        self.tip: TipConsistency = kin.tip if kin is not None else TipConsistency()
        self.outlines: Outlines = kin.outlines if kin is not None else Outlines()
        if kin is None:
            reader.expect_heights(self.scorer.height_factors)
        else:
            reader.share_tip(kin.reader)
        self.learned = 0
        self.vouched = False
        self.doubt = ""
        self._first: list[tuple[Looks, TrajectorySample]] = []

    @property
    def normal(self) -> TrajectorySample | None:
        """The first normal well that no later one cast doubt on: others are shown beside it."""
        return next((sample for _, sample in self._first if sample.frames), None)

    def p_value(self, score: float | None) -> float | None:
        """How often a normal well of this run looks this unusual; ``None``: cannot be told.

        All wells of a run may look unusual to a model of other runs. So the score is taken
        against this run's own normal wells: beyond their median it falls off exponentially, as
        it does among the wells of the model, and more slowly if theirs scatter more. While the run
        calibrates, a well that looks unusual to the model is unusual, however many do.
        """
        known = np.array(self.cascade.calibration.normals)
        if not self.scorer.gives_p_values or score is None:
            return None
        if not len(known):
            return math.exp(-score)  # the first one is held against the wells of the model
        middle = float(np.median(known))
        over = float(np.maximum(known - middle, 0.0).sum())
        scale = (_MODEL_WEIGHT + over) / (_MODEL_WEIGHT + 0.5 * len(known))
        scale = max(scale, _LEAST_SCALE[0], _LEAST_SCALE[1] * middle)
        in_run = math.exp(-max(score - middle, 0.0) / scale)
        collecting = self.cascade.state is CalibrationState.COLLECTING
        return min(in_run, math.exp(-score)) if collecting and not self.vouched else in_run

    def beyond_lab(self, case: GateInput, seen: OpenTrajectory) -> float:
        """How far a well is beyond the laboratory's own limit, log odds; 0 without one, and while
        too few wells were learned for readings to mean anything."""
        if self._limits is None or self.learned < ENOUGH or case.missing:
            return 0.0
        return self._limits.beyond(case, self.reader.wetness(seen.looks, case.sample.expected_ul))

    def look(
        self,
        seen: OpenTrajectory,
        kind: KeyframeKind,
        detection: TipDetection,
        shape: TipShape | None = None,
    ) -> None:
        """Measure the tip in one frame; without ``shape``, by the outline of the run's tips."""
        tip = _tip_of(seen.keyframes[kind])
        shape = shape or self.outlines.known(tip)
        if kind in FREE and shape is None and len(shapes_of(tip)) > 1:
            self.outlines.note(look(seen.frames, kind, detection, tip))
        before = seen.before if kind is KeyframeKind.POST_DISPENSE else None
        seen.looks[kind] = self.reader.look(seen.frames, kind, detection, tip, shape, before)

    def settle(self, seen: OpenTrajectory, detector: Detector) -> None:
        """Put the detections right by each other and the robot's word, and look anew at those."""
        located = {kind: seen.detections.get(kind) for kind in seen.projected}
        guess = guesses_in(detector, seen.frames)
        if guess is not None:
            seen.detections.update(second_look(guess, seen.detections))
            missing = [kind for kind in FREE if seen.detections.get(kind, ...) is None]
            seen.clearly_absent = self.tip.clearly_absent([guess(kind) for kind in missing])
        self.tip.note(seen.detections)
        settled = seen.detections | _held_to_projection(located, seen.detections, seen.projected)
        seen.excused = self._excused(seen, settled)
        # It is on, so it hangs where the robot holds it.
        hanging = {kind: seen.projected[kind] for kind in seen.excused if kind in seen.projected}
        lit = {k: tip for k, tip in hanging.items() if self.tip.lit_alike(k, seen.frames)}
        settled |= lit
        seen.excused = tuple(kind for kind in seen.excused if kind not in lit)
        found, seen.detections = seen.detections, settled
        for kind, detection in settled.items():
            if detection is found[kind] and (detection is None or kind in seen.looks):
                continue
            seen.looks.pop(kind, None)
            if detection is not None:
                self.look(seen, kind, detection)
        self._lay_alike(seen)

    def _excused(
        self, seen: OpenTrajectory, settled: Mapping[KeyframeKind, TipDetection | None]
    ) -> tuple[KeyframeKind, ...]:
        return tuple(
            kind
            for kind in FREE
            if settled.get(kind) is None and self.tip.excuses(kind, settled, seen.frames)
        )

    def _lay_alike(self, seen: OpenTrajectory) -> None:
        """Have both free frames laid straight by the outline that the run's tips have so far, and
        by one axis where the tip hangs at one place in both."""
        for kind in FREE:
            detection = seen.detections.get(kind)
            if detection is None or kind not in seen.looks:
                continue
            tip = _tip_of(seen.keyframes[kind])
            shape = self.outlines.best(tip)
            other = shape and look(seen.frames, kind, detection, tip).shape != shape
            if other or (kind is KeyframeKind.POST_DISPENSE and seen.before is not None):
                self.look(seen, kind, detection, shape)

    def learn(self, sample: TrajectorySample, looks: Looks, scored: bool) -> None:
        """A well was judged normal."""
        if KeyframeKind.TRANSIT not in looks:
            return
        self.reader.learn(looks, sample.expected_ul)
        self.learned += 1
        if scored:
            self.scorer.accept(sample)
        if len(self._first) < self.settings.wells:
            shown = sum(bool(first.frames) for _, first in self._first)
            # The trajectory gives its own frames up.
            kept = replace(sample, frames=dict(sample.frames) if shown < _SHOWN else {})
            self._first.append((dict(looks), kept))

    def catch_up(self) -> None:
        """What can be done while the robot moves: adapt, and look at the first wells again.

        The first wells are taken for normal, the very first one unseen. Beside those after it,
        it can be told whether it was.
        """
        self.scorer.adapt()
        known = self.learned
        if not 2 <= known <= self.settings.wells:
            return
        for looks, sample in list(self._first):
            others = [(its, other.expected_ul) for its, other in self._first if other is not sample]
            readings = self.reader.read_beside(looks, sample.expected_ul, others)
            case = GateInput(sample, Route.CALIBRATION, None, readings, (), calibrated=False)
            found = self._gates.screen(case)
            if found.outcome is Outcome.FAIL:
                self._first = [kept for kept in self._first if kept[1] is not sample]
                self.reader.forget([(its, other.expected_ul) for its, other in self._first])
                self.doubt = (
                    f"Well {sample.well} passed as one of the first wells, but does not look like "
                    f"the wells after it: {found.reason} Please look at well {sample.well}."
                )
                return


def _held_to_projection(
    located: Mapping[KeyframeKind, TipDetection | None],
    settled: Mapping[KeyframeKind, TipDetection | None],
    projected: Mapping[KeyframeKind, TipDetection],
) -> dict[KeyframeKind, TipDetection | None]:
    """Tips whose place is known: it is known better than what other wells looked like."""
    held: dict[KeyframeKind, TipDetection | None] = {}
    for kind, there in projected.items():
        found = located[kind] or settled.get(kind)
        held[kind] = found if found is not None and stands_at(found, there) else located[kind]
    return held


def _tip_of(keyframe: Keyframe) -> TipGeometry:
    return tip_for(keyframe.pipette, keyframe.capacity_ul)
