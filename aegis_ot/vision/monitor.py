"""The judge of a live run: frames in as they come, a verdict per trajectory out.

The sidecar calls it through the protocols of ``aegis_ot.sidecar.analysis``, which this module
matches without importing them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..vocabulary import Gate, Keyframe, KeyframeKind, Outcome, Route, Verdict
from .calibration import CalibrationSettings, CalibrationState, NormalPool
from .camera import Frame
from .cascade import Cascade, Triage
from .column_reader import MeasuredColumns
from .consistency import FREE, TipConsistency, confirms
from .gates import (
    Case,
    ConfirmingGate,
    GateDecision,
    OperatorGate,
    VolumetricGate,
    examine_in_turn,
)
from .measuring import ColumnReader, ColumnReading, TipView
from .run_scorer import RunScorer
from .tips import pipette_class, tip_for
from .types import Detector, Image, Scorer, TipDetection, TrajectorySample

MOST_OPEN = 32
"""Trajectories whose frames are kept at once: one that is never judged must not fill memory."""

_FAINT = 0.2
"""Confidence of a faint tip that a clear one beside it confirms; a bare shaft stays below
(0.19 at most on rendered frames)."""

Evidence = Mapping[str, Any]
Judged = tuple[Verdict, Evidence]


@dataclass(frozen=True)
class MonitorSettings:
    """How a run is judged.

    Attributes:
        calibration: See :class:`CalibrationSettings`.
        always_gate: Send every well after calibration to the gates.
    """

    calibration: CalibrationSettings = field(default_factory=CalibrationSettings)
    always_gate: bool = False


class RunMonitor:
    """Makes one :class:`RunAnalyser` per run.

    Args:
        detector: Finds the tip.
        scorer: World model, fitted on earlier normals; ``None``: a PCA is fitted on each run's
            own first wells.
        settings: See :class:`MonitorSettings`.
        gates: Asked in turn; by default the volumetric gate, then the operator. A VLM gate goes
            between them.
        reader: Makes the column reader of a run.
        pools: Standardised normals of earlier runs by scorer name.
    """

    def __init__(
        self,
        detector: Detector,
        scorer: Scorer | None = None,
        settings: MonitorSettings | None = None,
        gates: Sequence[ConfirmingGate] | None = None,
        reader: Callable[[], ColumnReader] = MeasuredColumns,
        pools: Mapping[str, NormalPool] | None = None,
    ) -> None:
        self.detector = detector
        self.scorer = scorer
        self.settings = settings or MonitorSettings()
        self.gates = tuple(gates) if gates is not None else (VolumetricGate(), OperatorGate())
        self.reader = reader
        self.pools = pools

    def begin(self, run: str, history: Sequence[Judged] = ()) -> RunAnalyser:
        """A run starts, or goes on after the sidecar was restarted.

        After a restart the scores in ``history`` restore the band. The column reader and a
        world model of the run's own are not restored: the reader calibrates anew on the wells
        that follow, and without a model file so does the band.
        """
        analyser = RunAnalyser(run, self)
        analyser.recall(history)
        return analyser


@dataclass
class _Open:
    """A trajectory whose keyframes are coming in."""

    keyframes: dict[KeyframeKind, Keyframe] = field(default_factory=dict)
    frames: dict[KeyframeKind, Image] = field(default_factory=dict)
    detections: dict[KeyframeKind, TipDetection | None] = field(default_factory=dict)
    looks: dict[KeyframeKind, object] = field(default_factory=dict)
    unusable: list[KeyframeKind] = field(default_factory=list)


class _Stream:
    """Wells that look alike when all is well: one pipette, one kind of tip, one liquid.

    A run that pipettes dye and then water has two; each is calibrated on its own first wells.

    Args:
        monitor: Where settings and models come from.
        kin: A stream of the same pipette, whose reader knows the tip already.
    """

    def __init__(self, monitor: RunMonitor, kin: _Stream | None = None) -> None:
        settings = monitor.settings
        self.scorer = RunScorer(monitor.scorer, settings.calibration.wells)
        self.cascade = Cascade(
            (self.scorer.name,), settings.calibration, monitor.pools, settings.always_gate
        )
        self.reader = monitor.reader()
        self.tip: TipConsistency = kin.tip if kin is not None else TipConsistency()
        if kin is not None and isinstance(self.reader, MeasuredColumns):
            self.reader.share_tip(kin.reader)
        self.learned = 0
        self.first_wells = 0


class RunAnalyser:
    """Judges the trajectories of one run, one call at a time.

    Calibration is per liquid and pipette: see :class:`_Stream`.

    A multi-channel pipette is judged on the one tip that the detector picks; the evidence says
    so (``channels``, ``tips_judged``).
    """

    def __init__(self, run: str, monitor: RunMonitor) -> None:
        self.run = run
        self._monitor = monitor
        self._streams: dict[tuple[str, float, str], _Stream] = {}
        self._open: dict[int, _Open] = {}

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        """A keyframe was captured: find the tip and measure while the robot moves on."""
        trajectory = self._open.setdefault(keyframe.trajectory, _Open())
        while len(self._open) > MOST_OPEN:
            del self._open[min(self._open)]
        kind, image = keyframe.kind, frame.image
        trajectory.keyframes[kind] = keyframe
        if not _is_image(image):
            trajectory.unusable.append(kind)
            return
        detection = self._monitor.detector.detect(image)
        trajectory.frames[kind] = image
        trajectory.detections[kind] = detection
        if detection is not None:
            self._look(self._stream(keyframe), trajectory, kind, detection)

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
        stream = self._stream(max(seen.keyframes.values(), key=lambda k: k.sequence))
        self._settle(stream, seen)
        sample = self._sample(trajectory, seen)
        missing = tuple(kind for kind, found in seen.detections.items() if found is None)
        readings = stream.reader.read(seen.looks, sample.expected_ul)
        # A blank crop would be scored as an anomaly, and learned as normal.
        whole = len(seen.detections) == len(KeyframeKind) and not missing
        scores = stream.scorer.scores(sample) if whole else {}
        p_value = None
        if scores and hasattr(self._monitor.scorer, "p_value"):
            p_value = math.exp(-scores[stream.scorer.name])  # such a score is -log p
        case = Case(sample, Route.GREY_ZONE, scores, readings, missing, stream.learned > 0, p_value)
        volumetric = VolumetricGate().examine(case)
        contradiction = volumetric.reason if volumetric.outcome is Outcome.FAIL else ""
        triage = stream.cascade.triage(scores, missing, contradiction)
        case = replace(case, route=triage.route)
        decision = self._decide(stream, case, triage)
        self._learn(stream, case, seen, decision)
        main = scores.get(stream.scorer.name)
        verdict = Verdict(
            self.run,
            trajectory,
            decision.outcome,
            triage.route,
            main,
            decision.gate,
            decision.failure,
            decision.reason,
            decision.measured_ul,
            decision.expected_ul,
        )
        return verdict, self._evidence(stream, case, seen, triage, decision)

    def _look(
        self, stream: _Stream, seen: _Open, kind: KeyframeKind, detection: TipDetection
    ) -> None:
        keyframe = seen.keyframes[kind]
        tip = tip_for(keyframe.pipette, keyframe.capacity_ul)
        pipette = pipette_class(keyframe.pipette)
        view = TipView(kind, seen.frames[kind], detection, tip, pipette, keyframe.expected_ul)
        seen.looks[kind] = stream.reader.look(view)

    def _settle(self, stream: _Stream, seen: _Open) -> None:
        """Put the detections right by the run's own tip, and look again where one changed."""
        self._second_look(seen)
        settled = stream.tip.settle(seen.detections, seen.frames)
        for kind, detection in settled.items():
            if detection is seen.detections[kind] and (detection is None or kind in seen.looks):
                continue
            seen.looks.pop(kind, None)
            if detection is not None:
                self._look(stream, seen, kind, detection)
        seen.detections = settled

    def _second_look(self, seen: _Open) -> None:
        """Believe a faint tip in one free frame if the other shows the same one clearly."""
        best_guess = getattr(self._monitor.detector, "best_guess", None)
        for kind, other in (FREE, FREE[::-1]):
            partner = seen.detections.get(other)
            missing = kind in seen.frames and seen.detections.get(kind) is None
            if best_guess is None or partner is None or not missing:
                continue
            guess = best_guess(seen.frames[kind])
            if confirms(guess, partner, _FAINT):
                seen.detections[kind] = guess

    def recall(self, history: Sequence[Judged]) -> None:
        """Restore the bands from what was judged before a restart."""
        if self._monitor.scorer is None:
            return
        for _, evidence in history:
            known = evidence.get("calibration") if isinstance(evidence, Mapping) else None
            if not isinstance(known, Mapping):
                continue
            try:
                pipette, capacity, liquid = known["stream"]
                key = (str(pipette), float(capacity), str(liquid))
                scores = {str(name): float(score) for name, score in known["scores"].items()}
                normal, volume = bool(known["normal"]), float(known["volume_ul"])
            except (KeyError, TypeError, ValueError, AttributeError):
                continue
            stream = self._streams.setdefault(key, _Stream(self._monitor))
            stream.cascade.learn(scores, normal=normal, volume_ul=volume)

    def _stream(self, keyframe: Keyframe) -> _Stream:
        pipette, liquid = f"{keyframe.mount} {keyframe.pipette}", keyframe.reagent or ""
        key = (pipette, keyframe.capacity_ul, liquid)
        if key not in self._streams:
            kin = next((s for k, s in self._streams.items() if k[:2] == key[:2]), None)
            self._streams[key] = _Stream(self._monitor, kin)
        return self._streams[key]

    def _decide(self, stream: _Stream, case: Case, triage: Triage) -> GateDecision:
        if triage.route is Route.CALIBRATION:
            stream.first_wells += 1
            # Assumed normal, but a gross failure is caught even here.
            gross = VolumetricGate().examine(case)
            if gross.outcome is Outcome.FAIL:
                return gross
            return GateDecision(
                Outcome.PASS,
                Gate.NONE,
                f"Calibration well {stream.first_wells} of "
                f"{self._monitor.settings.calibration.wells}.",
                None,
                gross.measured_ul,
                gross.expected_ul,
            )
        if not triage.to_gate:
            last = case.readings.get(KeyframeKind.POST_DISPENSE)
            return GateDecision(
                Outcome.PASS,
                Gate.NONE,
                triage.reason,
                None,
                None if last is None or last.vague else last.volume_ul,
                case.sample.expected_ul.get(KeyframeKind.POST_DISPENSE),
            )
        decision = examine_in_turn(self._monitor.gates, case)
        reason = f"{triage.reason} {decision.reason}"
        if triage.reason == decision.reason:
            reason = decision.reason
        return GateDecision(
            decision.outcome,
            decision.gate,
            reason,
            decision.failure,
            decision.measured_ul,
            decision.expected_ul,
        )

    def _learn(self, stream: _Stream, case: Case, seen: _Open, decision: GateDecision) -> None:
        normal = decision.outcome is Outcome.PASS
        collecting = stream.cascade.state is CalibrationState.COLLECTING
        whole = len(case.sample.frames) == len(KeyframeKind) and not case.missing
        if collecting and normal and whole and not stream.scorer.ready:
            # The run's own model: its first wells are scored once they are all there.
            for scores, volume in stream.scorer.learn(case.sample):
                stream.cascade.learn(scores, normal=True, volume_ul=volume)
        elif case.scores or not normal:
            volume = case.sample.volume_ul
            stream.cascade.learn(case.scores, normal=normal, volume_ul=volume)
        if normal and KeyframeKind.TRANSIT in seen.looks:
            stream.reader.learn(seen.looks, case.sample.expected_ul)
            stream.learned += 1

    def _sample(self, trajectory: int, seen: _Open) -> TrajectorySample:
        last = seen.keyframes[max(seen.keyframes, key=lambda kind: seen.keyframes[kind].sequence)]
        well = last.destinations[0].name if last.destinations else ""
        return TrajectorySample(
            id=f"{self.run}-{trajectory}",
            plate=self.run,
            well=well,
            pipette=pipette_class(last.pipette),
            volume_ul=last.commanded_ul,
            frames=seen.frames,
            detections=seen.detections,
            expected_ul={kind: frame.expected_ul for kind, frame in seen.keyframes.items()},
            reagent=last.reagent or "",
        )

    def _evidence(
        self, stream: _Stream, case: Case, seen: _Open, triage: Triage, decision: GateDecision
    ) -> dict[str, Any]:
        channels = max(keyframe.channels for keyframe in seen.keyframes.values())
        band = stream.cascade.calibrations[stream.scorer.name].band
        return {
            "boxes": {
                kind.value: [found.x, found.y, found.w, found.h]
                for kind, found in seen.detections.items()
                if found is not None
            },
            "confidence": {
                kind.value: found.confidence
                for kind, found in seen.detections.items()
                if found is not None
            },
            "scores": dict(case.scores),
            "band": None if band is None else list(band),
            "triage": triage.reason,
            "measured_ul": dict(_readings(case.readings)),
            "expected_ul": {kind.value: v for kind, v in case.sample.expected_ul.items()},
            "unusable_frames": [kind.value for kind in seen.unusable],
            "channels": channels,
            "tips_judged": 1,
            "calibration": {
                "stream": next(list(k) for k, s in self._streams.items() if s is stream),
                "volume_ul": case.sample.volume_ul,
                "scores": dict(case.scores),
                "normal": decision.outcome is Outcome.PASS,
            },
        }


def _readings(
    readings: Mapping[KeyframeKind, ColumnReading],
) -> Iterator[tuple[str, dict[str, float]]]:
    for kind, reading in readings.items():
        if reading.vague:
            continue
        yield (
            kind.value,
            {
                "volume": round(reading.volume_ul, 2),
                "uncertainty": round(reading.sigma_ul, 2),
                "air": round(reading.gap_ul, 2),
            },
        )


def _is_image(image: object) -> bool:
    return (
        isinstance(image, np.ndarray)
        and image.dtype == np.uint8
        and image.ndim == 3
        and image.shape[2] == 3
        and min(image.shape[:2]) >= 16
    )
