"""The per-run cascade on a held-out plate: the live run's own judge, with the plate as the run.

Every plate is played to :class:`~aegis_ot.vision.run_analyser_factory.RunAnalyserFactory` as a
robot would play it: keyframe by keyframe, well by well, in the order in which the wells were
pipetted. Its model never saw the plate. The first normal wells, at most six, are its calibration
wells and are not scored.
Plates in the paper's shape begin with one or two normals: such a run is calibrated on one well.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..vision.calibration import PRESETS, CalibrationSettings
from ..vision.camera import Frame
from ..vision.gates import ConfirmingGate, OperatorGate, VolumetricGate
from ..vision.run_analyser_factory import MonitorSettings, RunAnalyserFactory
from ..vision.second_opinion import SpotCheck
from ..vision.types import Detector, Image, TipDetection, TrajectorySample
from ..vocabulary import Keyframe, KeyframeKind, Outcome, Route, Verdict, WellRef
from .leave_one_out import ALPHA, HeldOut, ScoredWell

BAND_WELLS = 4
"""Calibration wells from which a band is set."""

_SPOT_CHECK = SpotCheck(first=0)


@dataclass(frozen=True)
class JudgedWell:
    """One well as the live run treated it.

    Attributes:
        scored: The well. Its score is the live run's, and so is its standing where scores are
            p-values; else the standing is that of leave-one-plate-out, and so are both of a well
            to which the run gave no score, because a tip was not found.
        verdict: What came of it.
        evidence: What stands behind it.
        calibration: Whether the plate was calibrated on it: assumed normal, and not scored.
    """

    scored: ScoredWell
    verdict: Verdict
    evidence: Mapping[str, Any]
    calibration: bool

    @property
    def sample(self) -> TrajectorySample:
        return self.scored.sample

    @property
    def to_gate(self) -> bool:
        """Whether a gate had to settle it."""
        return self.verdict.route not in (Route.SILENT_PASS, Route.CALIBRATION)

    @property
    def flagged(self) -> bool:
        """Failed, or left to the operator."""
        return self.verdict.outcome is not Outcome.PASS


def run_cascade(
    held: HeldOut, asked: Sequence[ConfirmingGate] = (), detector: Detector | None = None
) -> list[JudgedWell]:
    """Judge every well of every plate, in the order in which they were pipetted.

    Args:
        held: The scored wells, and the model that scored each plate.
        asked: Gates between the volumetric one and the operator.
        detector: What found the tips, if it can make guesses (``best_guess``) in frames in which
            it found none; the tips themselves are the samples' own.
    """
    judged: list[JudgedWell] = []
    gates = (VolumetricGate(), *asked, OperatorGate())
    for anchor, wells in held.plates():
        found = _Replayed(detector)
        # The first wells are known to be normal: nobody is asked about them.
        settings = MonitorSettings(_calibration(wells), ask_first=False, spot_check=_SPOT_CHECK)
        monitor = RunAnalyserFactory(found, held.models.get(anchor.sample.plate), settings, gates)
        analyser = monitor.begin(anchor.sample.plate)
        for number, well in enumerate([anchor, *wells]):
            for keyframe in keyframes(well.sample, number):
                image = found.show(well.sample, keyframe.kind)
                analyser.observe(keyframe, Frame(b"", image, 0.0))
            verdict, evidence = analyser.judge(number)
            calibrating = number < settings.calibration.wells
            scored = _live(well, verdict.score, held.gives_p_values)
            judged.append(JudgedWell(scored, verdict, evidence, calibrating))
    return judged


def _calibration(wells: Sequence[ScoredWell]) -> CalibrationSettings:
    """How a plate is calibrated: on the normals that it begins with, if there are enough."""
    preset = PRESETS["default"]
    leading = 1
    for well in wells:
        if well.failed or leading >= preset.wells:
            break
        leading += 1
    return replace(preset, wells=leading if leading >= BAND_WELLS else 1)


def _live(well: ScoredWell, score: float | None, gives_p_values: bool) -> ScoredWell:
    if score is None:
        return well
    if not gives_p_values:
        return replace(well, score=score)
    limit = -math.log(ALPHA)
    return replace(well, score=score, standing=score - limit, limit=limit)


def keyframes(sample: TrajectorySample, number: int) -> list[Keyframe]:
    """What a robot would say of a recorded trajectory, the ``number``-th of its plate."""
    well = WellRef(sample.plate, sample.well)
    return [
        Keyframe(
            run=sample.plate,
            sequence=len(KeyframeKind) * number + place,
            trajectory=number,
            kind=kind,
            pipette=sample.pipette,
            mount="left",
            channels=1,
            tip=sample.tip_used or str(number),
            sources=(),
            destinations=(well,),
            commanded_ul=sample.volume_ul,
            expected_ul=sample.expected_ul[kind],
            capacity_ul=sample.tip.nominal_ul,
            reagent=sample.reagent or None,
        )
        for place, kind in enumerate(KeyframeKind)
    ]


class _Replayed:
    """A detector that finds what was found in the frame before it, and guesses as it would."""

    def __init__(self, detector: Detector | None) -> None:
        self._found: TipDetection | None = None
        guess = getattr(detector, "best_guess", None)
        if guess is not None:
            self.best_guess = guess

    def show(self, sample: TrajectorySample, kind: KeyframeKind) -> Image:
        """The frame that comes next."""
        self._found = sample.detections[kind]
        return sample.frames[kind]

    def detect(self, image: Image) -> TipDetection | None:
        return self._found
