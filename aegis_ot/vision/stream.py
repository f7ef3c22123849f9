"""What a run knows of one liquid, and what it holds of one trajectory."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..vocabulary import Keyframe, KeyframeKind, Outcome, Route
from .calibration import CalibrationSettings, CalibrationState, NormalPool
from .cascade import Cascade
from .column_reader import MeasuredColumns
from .consistency import TipConsistency
from .gates import Case, VolumetricGate
from .measuring import ColumnReader
from .run_scorer import LEAST_ALARM, RunScorer
from .types import Image, Scorer, TipDetection, TrajectorySample


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
    """

    keyframes: dict[KeyframeKind, Keyframe] = field(default_factory=dict)
    frames: dict[KeyframeKind, Image] = field(default_factory=dict)
    detections: dict[KeyframeKind, TipDetection | None] = field(default_factory=dict)
    looks: dict[KeyframeKind, object] = field(default_factory=dict)
    unusable: list[KeyframeKind] = field(default_factory=list)
    excused: tuple[KeyframeKind, ...] = ()


class Stream:
    """Wells that look alike when all is well: one pipette, one kind of tip, one liquid.

    A run that pipettes dye and then water has two; each is calibrated on its own first wells.

    Args:
        scorer: World model, or ``None``; see :class:`~.run_scorer.RunScorer`.
        reader: Measures its columns.
        settings: Of the calibration.
        pools: Standardised normals of earlier runs by scorer name.
        always_gate: Send every well after calibration to the gates.
        kin: A stream of the same pipette, whose reader knows the tip already.
    """

    def __init__(
        self,
        scorer: Scorer | None,
        reader: ColumnReader,
        settings: CalibrationSettings,
        pools: Mapping[str, NormalPool] | None = None,
        always_gate: bool = False,
        kin: Stream | None = None,
    ) -> None:
        self.settings = settings
        self.scorer = RunScorer(scorer, settings.wells)
        least = {self.scorer.name: LEAST_ALARM} if self.scorer.gives_p_values else {}
        self.cascade = Cascade((self.scorer.name,), settings, pools, always_gate, least)
        self.reader = reader
        self.tip: TipConsistency = kin.tip if kin is not None else TipConsistency()
        if kin is not None and isinstance(reader, MeasuredColumns):
            reader.share_tip(kin.reader)
        self.learned = 0
        self.first_wells = 0
        self.doubt = ""
        self._first: list[tuple[Mapping[KeyframeKind, object], TrajectorySample]] = []

    @property
    def usual_score(self) -> float:
        """Median score of this run's normal wells; 0 before it is known."""
        calibration = self.cascade.calibrations[self.scorer.name]
        ready = calibration.state is CalibrationState.READY
        return max(calibration.median, 0.0) if ready else 0.0

    def learn(
        self, sample: TrajectorySample, looks: dict[KeyframeKind, object], scored: bool
    ) -> None:
        """A well was judged normal."""
        if KeyframeKind.TRANSIT not in looks:
            return
        self.reader.learn(looks, sample.expected_ul)
        self.learned += 1
        if scored:
            self.scorer.accept(sample)
        if len(self._first) < self.settings.wells:
            self._first.append((dict(looks), sample))

    def catch_up(self) -> None:
        """What can be done while the robot moves: adapt, and look at the first wells again.

        The first wells are taken for normal, the very first one unseen. Beside those after it,
        it can be told whether it was.
        """
        self.scorer.adapt()
        known = self.learned
        if not isinstance(self.reader, MeasuredColumns) or not 2 <= known <= self.settings.wells:
            return
        for looks, sample in list(self._first):
            others = [(its, other.expected_ul) for its, other in self._first if other is not sample]
            readings = self.reader.read_beside(looks, sample.expected_ul, others)
            case = Case(sample, Route.CALIBRATION, {}, readings, (), calibrated=False)
            found = VolumetricGate().examine(case)
            if found.outcome is Outcome.FAIL:
                self._first = [kept for kept in self._first if kept[1] is not sample]
                self.reader.forget([(its, other.expected_ul) for its, other in self._first])
                self.doubt = (
                    f"Well {sample.well} passed as one of the first wells, but does not look like "
                    f"the wells after it: {found.reason} Please look at well {sample.well}."
                )
                return
